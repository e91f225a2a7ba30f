// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "adjoint/detail/dual.hpp"
#include "adjoint/types.h"

/// The tilted normal of tilt.h for any number.
namespace carom::detail {

template <class S>
struct TiltFrame {
  explicit TiltFrame(const V3<S>& normal) : n(normal) {
    const Vec3 now = valuesOf(n);
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(now[i]) < std::abs(now[k])) k = i;
    e = Vec3(Vec3::Unit(k)).template cast<S>();
    length = n.cross(e).norm();
    t1 = n.cross(e) / length;
    t2 = n.cross(t1);
  }
  V3<S> offset(const V2<S>& tilt) const { return tilt.x() * t1 + tilt.y() * t2; }

  // d offset by n (3x3); its derivative by the tilt is (t1, t2).
  M3<S> offsetByNormal(const V2<S>& tilt) const {
    const M3<S> dt1 = -(M3<S>::Identity() - t1 * t1.transpose()) * skewOf<S>(e) / length;  // d(n x e) = -[e]x dn
    const M3<S> dt2 = -skewOf<S>(t1) + skewOf<S>(n) * dt1;
    return tilt.x() * dt1 + tilt.y() * dt2;
  }

  V3<S> n, e, t1, t2;
  S length;
};

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

}  // namespace carom::detail
