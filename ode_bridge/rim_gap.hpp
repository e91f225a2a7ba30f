// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom::ode_bridge_detail {

/// How far the lowest point of a rim is below its middle: radius |across|, across = axis x n, whose second derivative is no
/// larger than `bend`.
struct RimGap {
  double radius = 0, bend = 0;
  Vec3 across = Vec3::Zero(), rate = Vec3::Zero();

  double below(double h) const { return radius * (across + h * rate).norm(); }
  /// Where the rim is flat: as it will be.
  double belowRate() const {
    const double sine = across.norm();
    return radius * (sine > 0 ? across.dot(rate) / sine : rate.norm());
  }
  /// No later, and up to `limit`, than a gap falls to 0 that is c > 0 now, and of which what belongs to the middle grows at
  /// `rate_of_middle` with a second derivative of no more than `bend_of_middle`: the root of a concave function, from
  /// below by chords.
  double timeTo(double c, double rate_of_middle, double bend_of_middle, double limit) const {
    const double half = 0.5 * (bend_of_middle + radius * bend), start = below(0);
    const auto left = [&](double h) { return c + h * (rate_of_middle - half * h) - (below(h) - start); };
    double low = 0, high = limit, at_low = c, at_high = left(high);
    if (at_high >= 0) return limit;
    for (int round = 0; round < 100 && high - low > 1e-3 * high; ++round) {
      const double middle = 0.5 * (low + high), at_middle = left(middle);
      if (at_middle < 0) {
        high = middle, at_high = at_middle;
      } else {
        low = middle, at_low = at_middle;
      }
    }
    return low + (high - low) * (at_low / (at_low - at_high));
  }
};

}  // namespace carom::ode_bridge_detail
