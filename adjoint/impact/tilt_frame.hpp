// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"
#include "adjoint/numeric/dual.hpp"

/// The tilted normal of tilt.hpp for any number.
namespace carom::adjoint_detail {

/// m of tilt.hpp: the frame is smooth but at -m, which is 27 degrees or more from all axes and diagonals of the world,
/// and 16 from the planes of the axes.
inline Vec3 tiltCentre() { return Vec3(0.282, -0.367, 0.886).normalized(); }

/// a of tilt.hpp: at right angles to m, and such that t1 of a level floor is the y axis.
inline Vec3 tiltAxis() {
  const Vec3 s = tiltCentre() + Vec3::UnitZ();
  return Vec3::UnitY() - 2 * s.y() / s.squaredNorm() * s;
}

template <class S>
struct TiltFrame {
  explicit TiltFrame(const V3<S>& normal)
      : n(normal),
        a(tiltAxis().template cast<S>()),
        s(n + tiltCentre().template cast<S>()),
        length2(s.squaredNorm()),
        along(2 * a.dot(s) / length2),
        t1(a - along * s),
        t2(n.cross(t1)) {}
  V3<S> offset(const V2<S>& tilt) const { return tilt.x() * t1 + tilt.y() * t2; }

  // d offset by n (3x3); its derivative with respect to the tilt is (t1, t2).
  M3<S> offsetByNormal(const V2<S>& tilt) const {
    const V3<S> dalong = (2 * a - 2 * along * s) / length2;
    const M3<S> dt1 = -along * M3<S>::Identity() - s * dalong.transpose();
    const M3<S> dt2 = -skew(t1) + skew(n) * dt1;
    return tilt.x() * dt1 + tilt.y() * dt2;
  }

  V3<S> n, a, s;
  S length2, along;
  V3<S> t1, t2;
};

/// d of tiltedNormal by (n, tilt_a, tilt_b).
template <class S>
Eigen::Matrix<S, 3, 7> tiltJacobian(const V3<S>& n, const V2<S>& tilt_a, const V2<S>& tilt_b) {
  const TiltFrame<S> a(n), b(-n);
  const V3<S> m = n + a.offset(tilt_a) - b.offset(tilt_b);
  const S length = m.norm();
  const V3<S> unit = m / length;
  Eigen::Matrix<S, 3, 7> dm;
  dm.template leftCols<3>() = M3<S>::Identity() + a.offsetByNormal(tilt_a) + b.offsetByNormal(tilt_b);
  dm.col(3) = a.t1;
  dm.col(4) = a.t2;
  dm.col(5) = -b.t1;
  dm.col(6) = -b.t2;
  return (M3<S>::Identity() - unit * unit.transpose()) * dm / length;
}

}  // namespace carom::adjoint_detail
