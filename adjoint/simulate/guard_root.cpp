// SPDX-License-Identifier: MIT
#include "adjoint/simulate/guard_root.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/names.hpp"
#include "adjoint/base/types.h"

namespace carom::adjoint_detail {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr int kSteps = 200;
/// Where the gap rises the search goes on by this share of the stride, and twice as far each time.
constexpr double kFirstStride = 1.0 / 16;

double roundingOf(const GuardValue& g, double t) { return 4 * kEps * (g.size + g.speed * t); }

}  // namespace

const char* GuardRoot::why() const {
  return nameIn({"", "", "it would come before the impact that precedes it", "the bodies pass without touching",
                 "the gap of its features is not defined", "its time was not found"},
                outcome);
}

namespace {

/// What is known of the gap: it is above zero at `above` and not at `below`, later; or, with no `below` yet, it falls
/// at `above` and rises at `past`, above zero at both.
struct Bracket {
  double above = -kInfinity, below = kInfinity, past = kInfinity;

  void take(double t, bool is_above, const GuardValue& g) {
    if (!is_above) {
      below = t;
    } else if (g.rate < 0 || std::isfinite(below)) {
      above = t;
    } else if (std::isfinite(above)) {
      past = t;
    }
  }
  double end() const { return std::min(below, past); }
  bool closed() const { return std::isfinite(above) && std::isfinite(end()); }
  bool isNarrow(double t) const { return closed() && end() - above <= 2 * kEps * t; }
};

}  // namespace

GuardRoot descendingRoot(const RootSearch& search, const std::function<GuardValue(double)>& gapAt) {
  using Outcome = GuardRoot::Outcome;
  const double until = std::max(search.until, search.from);
  Bracket bracket;
  double t = std::clamp(search.guess, search.from, until), stride = kFirstStride * search.stride;
  double nearest = kInfinity, nearest_time = t;
  for (int step = 0; step < kSteps; ++step) {
    const GuardValue g = gapAt(t);
    if (!std::isfinite(g.gap) || !std::isfinite(g.rate)) return {Outcome::undefined, t};
    const double rounding = roundingOf(g, t), gap = std::abs(g.gap);
    if (step == 0 && gap <= rounding && g.rate < 0) return {Outcome::found, t};
    if (g.gap > 0 && t == until) return {g.rate < 0 || search.guess >= until ? Outcome::late : Outcome::none, t};
    if (g.gap < -rounding && t == search.from) return {Outcome::early, t};
    // within rounding of zero only what comes nearer counts
    if (gap <= 4 * rounding && nearest <= 4 * rounding && !(gap < nearest)) return {Outcome::found, nearest_time};
    if (g.rate < 0 && gap < nearest) nearest = gap, nearest_time = t;
    // bodies that part within rounding of contact have just bounced
    const bool is_above = g.gap > 0 || (gap <= rounding && !(g.rate < 0));
    bracket.take(t, is_above, g);
    if (bracket.isNarrow(t)) return {std::isfinite(bracket.below) ? Outcome::found : Outcome::none, t};

    double next;
    if (g.rate < 0) {
      next = std::clamp(t - g.gap / g.rate, t - search.stride, t + search.stride);
      if (std::abs(next - t) <= 2 * kEps * t) return {Outcome::found, std::max(next, search.from)};
    } else {
      next = is_above ? t + stride : t - stride;
      stride *= 2;
    }
    if (bracket.closed() && !(next > bracket.above && next < bracket.end()))
      next = 0.5 * (bracket.above + bracket.end());
    t = std::clamp(next, search.from, until);
  }
  return {Outcome::unresolved, t};
}

}  // namespace carom::adjoint_detail
