// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/charts/chart.h"
#include "bench/charts/error.h"

namespace carom::charts {

/// What a method makes of one scene of a map; the words stand in the CSV files.
enum class Outcome {
  right,     ///< to 1e-9 of what the impacts change
  close,     ///< within 1 % of it
  wrong,     ///< off by more
  missed,    ///< as if there had been no impact, or through a wall
  gains,     ///< ends with 1 % more energy than it began with
  blows_up,  ///< with ten times as much, or without numbers
  says_so    ///< does not answer, and says why
};
const char* nameOf(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::says_so;
  double error = 0;  ///< of velocities (|dv| + reach |d omega|), over what the impacts change of them; NaN: none
};

/// Compares velocities at one time with the exact ones, and with those of flights without impacts.
Verdict judge(const Scene& scene, const States& found, const States& exact, double time);

/// A map over (x, y) in a CSV file: one row a method and cell.
class Map {
 public:
  Map(Csv& csv, const std::string& x, const std::string& y);
  void cell(const std::string& method, double x, double y, const Verdict& verdict);

 private:
  Csv& csv_;
};

/// The step of the engines where a map has no axis for it, s.
inline constexpr double kMapStep = 1e-3;

/// States of all bodies after so many steps of dt that `time` is reached or just passed.
struct EngineKind;
struct Played {
  States states;
  double time = 0;
};
Played play(const EngineKind& kind, const Scene& scene, double time, double dt);

}  // namespace carom::charts
