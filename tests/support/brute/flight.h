// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/scene/scene.h"
#include "tests/support/brute/numbers.h"

namespace carom::brute {

/// Mass, centre of mass and principal moments, from a body as written; zero inverses when it is fixed.
struct MassProperties {
  bool moving = false;
  bool ball = false;  ///< looks and turns the same about all axes: its orientation has no effect
  Real mass = 0, inverse_mass = 0;
  Vector inertia = Vector::Zero(), inverse_inertia = Vector::Zero();
  Vector center = Vector::Zero();    ///< in the shape's axes
  Matrix axes = Matrix::Identity();  ///< principal to shape axes
};
MassProperties massOf(const Body& body);

struct Kinematic {
  Vector x = Vector::Zero(), v = Vector::Zero(), w = Vector::Zero();
  Matrix R = Matrix::Identity();
};

/// World inverse inertia.
inline Matrix inverseInertia(const MassProperties& m, const Matrix& R) {
  return R * m.inverse_inertia.asDiagonal() * R.transpose();
}

/// Free flight in long double, by a way of its own: the rotation q' = 1/2 omega(q) q with constant angular momentum is
/// solved on short stretches by Picard iteration on Chebyshev nodes, whose polynomial is the answer in between; with
/// equal moments the spin is constant.
class Flight {
 public:
  Flight() = default;  ///< fixed at the origin
  /// From the centre of mass, the orientation of the principal axes and velocities at `start`.
  Flight(const MassProperties& mass, const Vector& gravity, Real start, const Vector& x, const Rotation& q,
         const Vector& v, const Vector& L);
  static Flight fixedAt(const Vector& x, const Rotation& q);

  Vector positionAt(Real t) const { return x_ + (t - start_) * v_ + (t - start_) * (t - start_) / 2 * gravity_; }
  Vector velocityAt(Real t) const { return v_ + (t - start_) * gravity_; }
  Kinematic at(Real t);

  const Vector& acceleration() const { return gravity_; }
  /// Bounds on |omega| and |d omega/dt|; 0 for a ball, which looks the same from all sides.
  Real spinBound() const { return spin_bound_; }
  Real spinRateBound() const { return spin_rate_bound_; }

 private:
  static constexpr int kNodes = 15;
  using Stretch = Eigen::Matrix<Real, kNodes, 4>;

  Vector spin(const Matrix& R) const { return inverseInertia(mass_, R) * L_; }
  Stretch solve(const Eigen::Matrix<Real, 1, 4>& from) const;
  Rotation rotationAt(Real t);

  MassProperties mass_;
  Vector gravity_ = Vector::Zero(), x_ = Vector::Zero(), v_ = Vector::Zero(), L_ = Vector::Zero();
  Rotation q_ = Rotation::Identity();
  Real start_ = 0, length_ = 1;
  Real spin_bound_ = 0, spin_rate_bound_ = 0;
  std::vector<Stretch> stretches_;
};

}  // namespace carom::brute
