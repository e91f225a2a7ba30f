// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "adjoint/base/types.h"

namespace carom::ode_bridge_detail {

/// The first s > 0 with v s + a s^2/2 = c, for c > 0; infinite where there is none.
inline double timeTo(double c, double v, double a) {
  const double discriminant = v * v + 2 * a * c;
  if (discriminant < 0) return kInfinity;
  const double root = std::sqrt(discriminant);
  if (v > 0) return 2 * c / (v + root);
  return a > 0 ? (root - v) / a : kInfinity;
}

}  // namespace carom::ode_bridge_detail
