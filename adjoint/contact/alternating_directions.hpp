// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>

#include "adjoint/contact/cone.hpp"

namespace carom::adjoint_detail {

/// The cone program by alternating directions (Boyd et al. 2011): f minimises the function with the equations and a
/// pull towards z, z is what it is in the cones, in turn. All contacts take part at once, so their order does not matter.
/// It converges from anywhere, slowly; where it comes close, the active set is known.
class AlternatingDirections {
 public:
  explicit AlternatingDirections(ConeProgramOf<double> program);
  void iterate(int times);

  const Eigen::VectorXd& forces() const { return z_; }
  Eigen::VectorXd velocities() const { return -pull_ * y_; }  ///< V of ConeTerms
  Eigen::VectorXd multipliers() const;

 private:
  void prepare();
  void intoCones(Eigen::VectorXd& f) const;

  ConeProgramOf<double> q_;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen_;
  double pull_ = 1;
  Eigen::MatrixXd rows_;              // of the equations: N^T K
  Eigen::MatrixXd inverse_, onto_;    // (K + pull)^-1; multipliers from what the equations lack
  Eigen::VectorXd f_, z_, y_, rise_;
};

}  // namespace carom::adjoint_detail
