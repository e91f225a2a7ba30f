// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/path_limits.hpp"

namespace carom::adjoint_detail {

/// How a step in contact is to treat a slip that it starts with.
struct SlipAhead {
  bool frozen = false;         ///< it is about to end, and keeps its direction
  double longest = kInfinity;  ///< s, a step may be, as the slip comes to an end or turns
};

/// A slip of some m/s along `direction`, which changes at a rate, m/s^2, along the plane of the normal n; `unit`: of speed.
inline SlipAhead slipAhead(double slip, const Vec3& direction, Vec3 rate, const Vec3& n, double unit) {
  rate -= n.dot(rate) * n;
  const double share = slip / unit, along = direction.dot(rate), across = (rate - along * direction).norm();
  SlipAhead ahead;
  if (share < PathLimits::kStraightAnyway ||
      (share < PathLimits::kStraight && share * across < PathLimits::kLeftOutOfSlip * rate.norm())) {
    ahead.frozen = along < 0;
  } else if (across > PathLimits::kTurns * rate.norm()) {
    ahead.longest = slip / rate.norm() * PathLimits::lengthBeforeEnd(share);
  }
  return ahead;
}

}  // namespace carom::adjoint_detail
