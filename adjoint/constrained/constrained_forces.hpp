// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>

#include "adjoint/constrained/constrained_instant.hpp"

namespace carom::adjoint_detail {

/// Contact forces of constrained motion in doubles, without allocation, for every node of every step of a path
/// (ConstrainedDynamics computes the same for dual numbers). However many forces there are, they act on six velocities: with C the
/// Jacobian of the constraints with respect to (v, omega) and W the wrenches of the unknown forces, C M^-1 W y = -b.
class ConstrainedForces {
 public:
  using Vec6 = Eigen::Matrix<double, 6, 1>;

  /// `now` is looked at until the next call. `redundant`: of contacts whose constraints are not independent the forces of
  /// least norm.
  void solve(const ConstrainedInstant& now, bool redundant);

  /// Contacts that stick share what they push against each other so that most room is left (ConstrainedShare).
  void share();

  /// On the body.
  const Vec3& force(std::size_t k) const { return force_[k]; }
  double pressing(std::size_t k) const { return now_->contacts[k].n.dot(force_[k]); }
  Vec3 acceleration() const { return now_->body.gravity + wrench_.head<3>() * now_->body.inverse_mass; }
  Vec3 moment() const { return wrench_.tail<3>(); }
  /// d/dt of the velocity of the body against what it touches there.
  Vec3 slipRate(std::size_t k) const { return free_[k] + responseAt(wrench_, k); }

  /// How the wrench of all forces answers as the direction of slip at contact k turns about its normal, by 1 rad.
  Vec6 answerToTurn(std::size_t k) const;
  /// How the velocity at contact k answers to a wrench.
  Vec3 responseAt(const Vec6& wrench, std::size_t k) const {
    const Vec6 a = moved(wrench);
    return a.head<3>() + a.tail<3>().cross(now_->contacts[k].r);
  }

 private:
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;

  Vec6 moved(const Vec6& wrench) const {
    Vec6 a;
    a << wrench.head<3>() * now_->body.inverse_mass, now_->body.A * wrench.tail<3>();
    return a;
  }
  void assemble();
  bool solveSquare();
  void factorSquare();
  void factorReduced();
  void findBasis();
  Vec6 wrenchOfSolution(const Column& x) const;
  Column solveReduced(Column z) const;

  const ConstrainedInstant* now_ = nullptr;
  bool redundant_ = false;
  std::vector<Vec3> free_, force_;      // of each contact; free_: its slip rate without forces
  std::vector<std::size_t> first_;      // of each contact its first unknown
  // Of each unknown: its constraint by (v, omega), its wrench, what that does to (v, omega), and the right-hand side.
  std::vector<Vec6> row_, wrenches_, moved_;
  std::vector<double> b_, y_;
  Vec6 wrench_ = Vec6::Zero();
  Eigen::PartialPivLU<Square> square_;  // of C M^-1 W
  // Redundant: an orthonormal basis of the rows C, in which they are U T and M^-1 W is S^T V^T.
  double length_ = 1;                   // m, that makes turns and moves alike
  int rank_ = 0;
  Eigen::Matrix<double, 6, 6> basis_, T_, S_, wrench_by_x_;
  std::vector<Vec6> U_, V_;
};

}  // namespace carom::adjoint_detail
