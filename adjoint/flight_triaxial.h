#pragma once

#include <vector>

#include "adjoint/body_model.h"

namespace carom {

struct RotationSensitivity;

/// Torque-free rotation with three different moments, as Taylor segments of the quadratic system
///   M' = M x (D M),  q' = 1/2 q o (0, D M),   M = R(q)^T L,  D = diag(1/I),
/// in principal axes. Coefficients come from the recurrences of Cauchy products; the step is chosen from the last
/// coefficients (Jorba and Zou, Experimental Mathematics 14(1), 2005) and rounded to a short binary number, so that
/// segment times add without error. Every segment starts again from M = R(q)^T L, so |M| = |L| never drifts.
class TriaxialRotation {
 public:
  static constexpr int kOrder = 20;

  void begin(const Vec3& inverse_inertia, const Quat& q, const Vec3& L);
  void extendTo(double elapsed);
  Quat orientationAt(double elapsed) const;
  /// Sensitivity over [0, elapsed] by the variational equations of the same system.
  RotationSensitivity sensitivityAt(double elapsed) const;

 private:
  struct Segment {
    double start, length;
    Eigen::Matrix<double, 3, kOrder + 1> M;
    Eigen::Matrix<double, 4, kOrder + 1> q;  // x y z w
  };
  Segment makeSegment(double start, const Quat& q) const;
  const Segment& segmentAt(double elapsed) const;

  Vec3 D_ = Vec3::Zero(), L_ = Vec3::Zero();
  std::vector<Segment> segments_;
};

}  // namespace carom
