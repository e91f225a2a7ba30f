// SPDX-License-Identifier: MIT
#include "bench/charts/chart.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "bench/charts/engines/engine.h"
#include "bench/machine.h"

namespace carom::charts {
namespace {

std::string numberText(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return std::isnan(number) ? "nan" : text;
}

}  // namespace

Cell::Cell(double number) : text(numberText(number)) {}
Cell::Cell(int number) : text(std::to_string(number)) {}
Cell::Cell(std::size_t number) : text(std::to_string(number)) {}
Cell::Cell(const char* word) : text(word) {}
Cell::Cell(const std::string& word) : text(word) {}

Csv::Csv(const std::string& path) : path_(path) {
  note(machineLine());
  for (const EngineKind& kind : engines()) note(kind.name + ": " + kind.version);
  for (const std::string& name : missingEngines()) note(name + ": left out, it was not there when this was built");
}

void Csv::note(const std::string& sentence) { text_ += "# " + sentence + "\n"; }

void Csv::columns(const std::vector<std::string>& names) {
  columns_ = names.size();
  for (const std::string& name : names) text_ += (&name == names.data() ? "" : ",") + name;
  text_ += "\n";
}

void Csv::row(const std::vector<Cell>& cells) {
  if (cells.size() != columns_)
    throw std::logic_error("a row of " + path_ + " has " + std::to_string(cells.size()) + " cells, expected " +
                           std::to_string(columns_));
  for (const Cell& cell : cells) text_ += (&cell == cells.data() ? "" : ",") + cell.text;
  text_ += "\n";
}

void Csv::close() {
  std::ofstream out(path_, std::ios::binary);
  out << text_;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path_);
}

Progress::Progress(int total) : total_(total), start_(now()), shown_(start_) {}

Progress::~Progress() {
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\033[K");
}

void Progress::next(const std::string& what) {
  ++done_;
  const bool terminal = isatty(STDERR_FILENO);
  constexpr double kQuiet = 10;  // s between two lines in a log
  if (!terminal && now() - shown_ < kQuiet) return;
  shown_ = now();
  std::fprintf(stderr, terminal ? "\r\033[K  %d of %d, %.1f s: %s" : "  %d of %d, %.1f s: %s\n", done_, total_,
               shown_ - start_, what.c_str());
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double bestSeconds(const std::function<void()>& run, double budget, int most) {
  const double start = now();
  double best = INFINITY;
  for (int i = 0; i < most && (i == 0 || now() - start < budget); ++i) {
    const double from = now();
    run();
    best = std::min(best, now() - from);
  }
  return best;
}

std::vector<double> logSpaced(double first, double last, int count) {
  std::vector<double> values = evenlySpaced(std::log10(first), std::log10(last), count);
  for (double& v : values) v = std::pow(10, v);
  return values;
}

std::vector<double> evenlySpaced(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first + (last - first) * i / std::max(1, count - 1));
  return values;
}

}  // namespace carom::charts

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FILE.csv\n", argv[0]);
    return 2;
  }
  try {
    carom::charts::Csv csv(argv[1]);
    carom::charts::measure(csv);
    csv.close();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}
