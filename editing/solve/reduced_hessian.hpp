// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// How the rows bend along themselves. Internal to editing/.
namespace carom::editing_detail {

/// An estimate of the inverse of the reduced Hessian N^T W N, with N an orthonormal basis of the directions that change
/// no row, and W the Hessian of the Lagrangian of |z|^2 / 2: a quasi-Newton method by the BFGS update (Nocedal and
/// Wright, Numerical Optimization, 2006, chapters 6 and 18.7). Where rows bend strongly, steps that take W for the
/// identity, which it is for straight rows, go to and fro. It is kept in full coordinates, as N turns from point to point.
class ReducedHessian {
 public:
  /// The step along the rows that `plain` becomes. `plain` = -N N^T z is the one for straight rows: the reduced gradient
  /// with its sign turned, as far as bounds let it. Learns from the point before, so it wants to be asked once a point.
  Eigen::VectorXd stepAlong(const Eigen::VectorXd& at, const Eigen::MatrixXd& row_jacobian,
                            const Eigen::VectorXd& plain);

 private:
  void learn(const Eigen::VectorXd& moved, const Eigen::VectorXd& more_gradient);

  Eigen::MatrixXd inverse_;
  Eigen::VectorXd at_before_, plain_before_;  ///< empty at first
};

}  // namespace carom::editing_detail
