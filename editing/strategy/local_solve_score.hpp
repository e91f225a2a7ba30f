// SPDX-License-Identifier: MIT
#pragma once

/// Whether it is worth going from a point onto the constraints. Internal to editing/.
namespace carom::editing_detail {

/// What is known of a point before any step is made: how far it is from the constraints, and, where the rows are linear, how
/// long the step onto them and how large the smallest change is.
struct LocalSolveEstimate {
  double violation, step, change;
};

/// The smaller, the likelier that a local solve from there brings a change smaller than `below`: (v s)^(1/4) e^max(0, c - 1),
/// with v the violation, s and c the step and the change as shares of `below`, and v, s >= 1e-3. The search adds the score once
/// more for each local solve that began in the same impact sequence. Fitted to 142,000 local solves: at a score of 1 one of a
/// hundred brought a smaller change, at 4 one of a thousand (docs/charts.md).
double localSolveScore(const LocalSolveEstimate& estimate, double below);
/// Points up to this score are likely ones.
inline constexpr double kLikelyScore = 1;

/// The improvement that local solves from likely points were expected to bring, whether they did or not: the larger it is, the
/// likelier that others will bring it.
class ExpectedImprovement {
 public:
  /// Counts where it is likely.
  void add(const LocalSolveEstimate& estimate, double below);
  /// Mean of e^-score log(1 / c) over those that count, c as in localSolveScore, and over one more of a usual improvement, as
  /// there may be none.
  double mean() const { return (sum_ + kUsual) / (count_ + 1); }
  static constexpr double kUsual = 0.2;

 private:
  double sum_ = 0;
  int count_ = 0;
};

}  // namespace carom::editing_detail
