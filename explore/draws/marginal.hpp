// SPDX-License-Identifier: MIT
#pragma once

#include "editing/problem/controls/control_binding.hpp"

/// The distribution of one number, cut off at its bounds. Internal to explore/.
namespace carom::explore_detail {

/// What a standard number u in (0, 1), or z = quantile(u), becomes.
class Marginal {
 public:
  enum class Kind { normal, log_normal, uniform };

  /// mean + deviation z, median exp(deviation z), or between `a` and `b`; cut off at the bounds.
  Marginal(Kind kind, double a, double b, editing_detail::Interval bounds);

  /// The part of the distribution within the bounds; 0: nothing of it.
  double kept() const { return kept_; }
  double at(double u) const;
  /// Of a normal one that is not cut off, from what takes the place of deviation z.
  double atOffset(double offset) const;
  bool allows(double value) const { return value >= bounds_.lower && value <= bounds_.upper; }

 private:
  void cutNormal();
  double zOf(double value) const;

  Kind kind_;
  double a_, b_;
  editing_detail::Interval bounds_;
  double kept_ = 1;
  bool cut_ = false, mirrored_ = false;
  double from_ = 0, to_ = 1;  // probabilities of the ends; of a uniform one the ends
};

}  // namespace carom::explore_detail
