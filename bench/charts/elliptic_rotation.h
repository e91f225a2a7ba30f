#pragma once

#include "adjoint/types.h"

namespace carom::charts {

/// Free rotation with three different moments in closed form, as by van Zon and Schofield (J. Comput. Phys. 225, 2007):
/// with I3 the end of the moments that the body goes around and M = R^T L,
///   M = (I1 a cn u, I2 b sn u, I3 c dn u),  u = p t + e,
///   R = R(0) B(0)^T exp([psi e_z]x) B,  B M = |L| e_z,  psi = A1 + A2 t + arg H(u + i eta),
/// H Jacobi's eta function. Constant cost, however long the flight. Modulus 1 (exactly on the separatrix) has none.
class EllipticRotation {
 public:
  EllipticRotation(const Vec3& inverse_inertia, const Quat& q, const Vec3& L);
  Quat orientationAt(double t) const;

 private:
  Vec3 momentumAt(double u) const;
  double thetaArgument(double u) const;

  Mat3 P_ = Mat3::Identity();  // from principal axes to those of the formulae
  Vec3 I_ = Vec3::Ones(), amplitude_ = Vec3::Zero();
  double l_ = 0, m_ = 0, m1_ = 1, K_ = 1, eta_ = 0, nome_ = 0;
  double p_ = 0, e_ = 0, A1_ = 0, A2_ = 0;
  Mat3 before_ = Mat3::Identity();  // R(0) B(0)^T
};

}  // namespace carom::charts
