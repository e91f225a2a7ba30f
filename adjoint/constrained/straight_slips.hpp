// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

/// Slower than this share of the unit of speed a slip has no direction of its own.
inline constexpr double kNoDirectionLeft = 1e-11;

/// Of a slip at the end of its path, m/s: what is left of it, and what of an earlier slip is across its direction there.
struct StopOfSlip {
  double left = kInfinity, across = 0;
};

/// How derivatives go over a slip: along a direction that it keeps, or for a time over which it does not change by much of itself.
struct SlipStretch {
  bool straight = false;
  bool stops = false;  ///< its direction is that at the end
  double reach = 0;    ///< s, where it is not straight
};

/// Of a slip that changes at a rate, m/s^2. `unit`: of speed.
inline SlipStretch slipStretch(const Vec3& slip, const Vec3& rate, const StopOfSlip& end, double unit) {
  // Stretches end where a slip has changed by so much of itself. Slower than kNoSlip of the unit of speed it is straight, if its
  // acceleration has no more than kStillTurns of itself across it, and slower than kNoDirectionLeft in any case.
  constexpr double kReachOfStretch = 0.7, kNoSlip = 1e-8, kStillTurns = 1e-6;
  // Of what a slip has left at its end, which is rounding: what is no larger across its way there is rounding, too.
  constexpr double kLeftAcross = 4;
  const double speed = slip.norm();
  SlipStretch out;
  out.stops = end.left <= kNoDirectionLeft * unit;
  // it goes straight to its end, as far as rounding lets anybody tell
  const bool straight_to_end = out.stops && end.left < kLeftAcross * speed && std::abs(end.across) <= kLeftAcross * end.left;
  const bool turns = rate.cross(slip).norm() > kStillTurns * rate.norm() * speed && !straight_to_end;
  out.straight = !(speed > (turns ? kNoDirectionLeft : kNoSlip) * unit);
  if (!out.straight) out.reach = kReachOfStretch * speed / rate.norm();
  return out;
}

/// The stretches of the steps of a path from its start to a time, in order; `stretch_from(step, from, until)` gives one that may be shorter.
template <class Stretch, class Steps, class StretchFrom>
std::vector<Stretch> stretchesOf(const Steps& steps, double t, const StretchFrom& stretch_from) {
  std::vector<Stretch> out;
  for (const auto& step : steps) {
    if (!(step.length > 0) || !(step.start < t)) break;
    const bool last = &step == &steps.back();
    const double until = last ? t : std::min(t, step.start + step.length);
    for (double from = step.start; from < until; from = out.back().until) out.push_back(stretch_from(step, from, until));
  }
  return out;
}

}  // namespace carom::adjoint_detail
