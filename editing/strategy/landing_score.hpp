// SPDX-License-Identifier: MIT
#pragma once

/// Whether it is worth going from a point onto the constraints. Internal to editing/.
namespace carom::editing_detail {

/// What is known of a point before any step is made: how far it is from the constraints, and, where the rows are linear, how
/// long the step onto them and how large the smallest change is.
struct Prospect {
  double violation, step, change;
};

/// The smaller, the likelier that a landing from there brings a change smaller than `below`: (v s)^(1/4) e^max(0, c - 1), with v the
/// violation, s and c the step and the change as shares of `below`, and v, s >= 1e-3.
/// For each landing that began in the same impact sequence it counts once more. Of 142,000 landings, to which it was fitted, one of
/// a hundred brought a smaller change at 1, one of a thousand at 4 (docs/decisions.md, 146).
double landingScore(const Prospect& prospect, double below);
/// Points up to this score are likely ones.
inline constexpr double kLikelyScore = 1;

/// What landings from likely points were expected to bring, whether they did or not: the more it is, the likelier that others
/// will bring it.
class ExpectedImprovement {
 public:
  /// Counts where it is likely.
  void add(const Prospect& prospect, double below);
  /// Mean of e^-score log(1 / c) over those that count, c as in landingScore, and over one more of a usual improvement, as there may
  /// be none.
  double mean() const { return (sum_ + kUsual) / (count_ + 1); }
  static constexpr double kUsual = 0.2;

 private:
  double sum_ = 0;
  int count_ = 0;
};

}  // namespace carom::editing_detail
