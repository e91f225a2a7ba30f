// SPDX-License-Identifier: MIT
#include "adjoint/impact/tilt.h"

#include "adjoint/detail/tilt_frame.hpp"

namespace carom {

using Frame = detail::TiltFrame<double>;

Vec3 tiltedNormal(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b) {
  return (n + Frame(n).offset(tilt_a) - Frame(-n).offset(tilt_b)).normalized();
}

Eigen::Matrix<double, 3, 7> tiltedNormalJacobian(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b) {
  return detail::tiltJacobian<double>(n, tilt_a, tilt_b);
}

}  // namespace carom
