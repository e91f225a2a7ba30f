// SPDX-License-Identifier: MIT
#include "adjoint/impact/tilt.hpp"

#include <algorithm>

#include "adjoint/impact/tilt_frame.hpp"

namespace carom::adjoint_detail {

using Frame = TiltFrame<double>;

Vec3 tiltedNormal(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b) {
  Vec3 m = n;
  if (!tilt_a.isZero(0)) m += Frame(n).offset(tilt_a);
  if (!tilt_b.isZero(0)) m -= Frame(-n).offset(tilt_b);
  return m.normalized();
}

Vec2 tiltOf(const Scene& scene, int entry) {
  return entry < 0 ? Vec2(0, 0) : scene.tilts[static_cast<std::size_t>(entry)].value;
}

double tiltMargin(const Vec3& n, bool a, bool b) {
  const double of_a = a ? 0.5 * (n + tiltCentre()).norm() : 1;
  const double of_b = b ? 0.5 * (tiltCentre() - n).norm() : 1;
  return std::min(of_a, of_b);
}

}  // namespace carom::adjoint_detail
