// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "adjoint/base/types.h"
#include "adjoint/numeric/elliptic_functions.hpp"

namespace carom::adjoint_detail {

/// Torque-free rotation with three different moments in closed form (Jacobi; van Zon and Schofield, Journal of
/// Computational Physics 225, 2007), at a cost that does not depend on the time that has passed. With the axes in the
/// order in which the body goes around the third, M = R^T L in them and l = |L|,
///   M = (a1 cn u, a2 sn u, a3 dn u),  u = p t + e,
///   R = R(0) A(0)^T exp([psi(t) e_z]x) A(t),  A M = l e_z,  psi = A2 t + arg theta_1(pi (u + i eta)/2K).
/// theta_1 is Jacobi's; its series is taken in the nome of k or in that of k', whichever is the smaller.
class EllipticRotation {
 public:
  /// None where the formulae are singular: at rest, about a principal axis, with two equal moments, and on the
  /// separatrix, where the period is infinite.
  static std::optional<EllipticRotation> of(const Vec3& inverse_inertia, const Quat& q, const Vec3& L);

  /// Error: of the order of the rounding of the angle turned.
  Quat orientationAt(double t) const { return before_ * relative(t); }
  /// Of R^T L in principal axes.
  Vec3 directionAt(double t) const;
  /// Of M from the real axis to its nearest pole in complex time, s.
  double poleDistance() const { return complement_.completeK() / std::abs(p_); }
  /// A time about which the squares of M are even, s: that of u = 0.
  double evenTime() const { return -e_ / p_; }
  /// Time after which M is the same and R has turned about L, s.
  double period() const { return 4 * modulus_.completeK() / std::abs(p_); }

 private:
  EllipticRotation(double m, double m1) : modulus_(m1), complement_(m) {}
  void prepareTheta(double tan_eta);
  struct Argument {
    double half_periods, reduced;  // u = 2K half_periods + reduced
  };
  Argument argumentAt(double t) const;
  Vec3 momentumAt(const Argument& u) const;
  Quat relative(double t) const;

  static constexpr std::size_t kTerms = 5;

  EllipticModulus modulus_, complement_;  // of k, and of k'
  Quat axes_ = Quat::Identity();          // from principal axes to those of the formulae
  Quat before_ = Quat::Identity();
  Vec3 amplitude_ = Vec3::Zero();
  double p_ = 0, e_ = 0, A2_ = 0;
  // arg theta_1 is that of sum over n of (re_[n] f_n, im_[n] g_n), with f, g the circular or hyperbolic sine and cosine
  // of (2n + 1) scale_ u
  bool circular_ = true;
  double scale_ = 0, turn_per_half_period_ = M_PI;
  std::array<double, kTerms> re_{}, im_{};
};

}  // namespace carom::adjoint_detail
