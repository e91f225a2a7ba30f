#include "adjoint/impact/tilt.h"

#include <cmath>

namespace carom {
namespace {

struct Frame {
  explicit Frame(const Vec3& normal) : n(normal) {
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(n[i]) < std::abs(n[k])) k = i;
    e = Vec3::Unit(k);
    length = n.cross(e).norm();
    t1 = n.cross(e) / length;
    t2 = n.cross(t1);
  }
  Vec3 offset(const Vec2& tilt) const { return tilt.x() * t1 + tilt.y() * t2; }

  // d offset by n (3x3); its derivative by the tilt is (t1, t2).
  Mat3 offsetByNormal(const Vec2& tilt) const {
    const Mat3 dt1 = -(Mat3::Identity() - t1 * t1.transpose()) * skew(e) / length;  // d(n x e) = -[e]x dn
    const Mat3 dt2 = -skew(t1) + skew(n) * dt1;
    return tilt.x() * dt1 + tilt.y() * dt2;
  }

  Vec3 n, e, t1, t2;
  double length;
};

}  // namespace

Vec3 tiltedNormal(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b) {
  return (n + Frame(n).offset(tilt_a) - Frame(-n).offset(tilt_b)).normalized();
}

Eigen::Matrix<double, 3, 7> tiltedNormalJacobian(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b) {
  const Frame a(n), b(-n);
  const Vec3 m = n + a.offset(tilt_a) - b.offset(tilt_b);
  const Vec3 unit = m.normalized();
  Eigen::Matrix<double, 3, 7> dm;
  dm.leftCols<3>() = Mat3::Identity() + a.offsetByNormal(tilt_a) + b.offsetByNormal(tilt_b);
  dm.col(3) = a.t1;
  dm.col(4) = a.t2;
  dm.col(5) = -b.t1;
  dm.col(6) = -b.t2;
  return (Mat3::Identity() - unit * unit.transpose()) * dm / m.norm();
}

}  // namespace carom
