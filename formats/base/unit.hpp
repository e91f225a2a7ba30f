// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// A norm that differs from 1 by no more than this is left alone, so that reading what was written changes nothing.
inline constexpr double kUnitRounding = 1e-15;

/// A unit quaternion is kept as it is, to the last bits; another is normalized.
inline Quat unitQuaternion(const Quat& q) {
  // Twice: once is not always exact to the last bit but one.
  return std::abs(q.squaredNorm() - 1) > kUnitRounding ? q.normalized().normalized() : q;
}

}  // namespace carom::formats_detail
