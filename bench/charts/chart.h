// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace carom::charts {

/// One cell of a CSV file: a number with six digits, a whole number, or a word without commas.
struct Cell {
  Cell(double number);            // NOLINT: a cell is what it holds
  Cell(int number);               // NOLINT
  Cell(std::size_t number);       // NOLINT
  Cell(const char* word);         // NOLINT
  Cell(const std::string& word);  // NOLINT
  std::string text;
};

/// A chart's CSV file. Its first lines, which begin with '#', say what it was made on and with: processor, cores,
/// compiler, versions of carom and of the libraries, date. Numbers that do not exist are written "nan".
class Csv {
 public:
  explicit Csv(const std::string& path);
  Csv(const Csv&) = delete;

  /// The line of column names; to be called once, before the first row.
  void columns(const std::vector<std::string>& names);
  void row(const std::vector<Cell>& cells);
  /// A sentence for readers of the file, as a line that begins with '#'.
  void note(const std::string& sentence);
  /// Writes the file; rows of a run that fails half-way are never seen.
  void close();

 private:
  std::string path_, text_;
  std::size_t columns_ = 0;
};

/// One line that is written over as a chart goes on: "12 of 80, 3.1 s: ball, ODE at 0.001".
class Progress {
 public:
  explicit Progress(int total);
  ~Progress();
  void next(const std::string& what);

 private:
  int total_, done_ = 0;
  double start_, shown_;
};

/// Seconds of a steady clock.
double now();

/// Least wall time of one call of `run`, in seconds: at least one call, then more until `budget` seconds are used up or
/// `most` calls were made. The least is what other work on the machine disturbs least.
double bestSeconds(const std::function<void()>& run, double budget = 0.1, int most = 1000);

/// `count` numbers from `first` to `last` with equal ratios, or with equal differences.
std::vector<double> logSpaced(double first, double last, int count);
std::vector<double> evenlySpaced(double first, double last, int count);

/// What every chart defines, in a file of its own: measures, and writes the rows.
void measure(Csv& csv);

}  // namespace carom::charts
