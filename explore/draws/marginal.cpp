// SPDX-License-Identifier: MIT
#include "explore/draws/marginal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "adjoint/numeric/elementary.hpp"
#include "explore/numbers/normal_quantile.hpp"

namespace carom::explore_detail {

Marginal::Marginal(Kind kind, double a, double b, editing_detail::Interval bounds)
    : kind_(kind), a_(a), b_(b), bounds_(bounds) {
  if (kind != Kind::uniform) {
    cutNormal();
    return;
  }
  from_ = std::max(a, bounds.lower), to_ = std::min(b, bounds.upper);
  if (!(from_ <= to_))
    kept_ = 0;
  else if (a < b)
    kept_ = (to_ - from_) / (b - a);
}

double Marginal::zOf(double value) const {
  if (kind_ == Kind::normal) return (value - a_) / b_;
  return value > 0 ? elementary::log(value / a_) / b_ : -std::numeric_limits<double>::infinity();
}

void Marginal::cutNormal() {
  double lower = zOf(bounds_.lower), upper = zOf(bounds_.upper);
  // The upper tail as the lower one of -z: there probabilities are known relative to themselves.
  mirrored_ = lower > 0;
  if (mirrored_) {
    std::swap(lower, upper);
    lower = -lower, upper = -upper;
  }
  from_ = normalProbability(lower), to_ = normalProbability(upper);
  cut_ = from_ > 0 || to_ < 1;
  kept_ = to_ - from_;
}

double Marginal::at(double u) const {
  if (kind_ == Kind::uniform) return std::clamp(from_ + u * (to_ - from_), from_, to_);
  double z = normalQuantile(cut_ ? from_ + u * (to_ - from_) : u);
  if (mirrored_) z = -z;
  return std::clamp(atOffset(b_ * z), bounds_.lower, bounds_.upper);  // which takes away what rounding adds
}

double Marginal::atOffset(double offset) const {
  return kind_ == Kind::normal ? a_ + offset : a_ * elementary::exp(offset);
}

}  // namespace carom::explore_detail
