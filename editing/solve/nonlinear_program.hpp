// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace carom::editing_detail {

/// minimise f(x) subject to x_lower <= x <= x_upper, g_lower <= g(x) <= g_upper. Infinite bounds are allowed; equal
/// ones make an equation. Functions that evaluate return false where x cannot be evaluated or is not wanted: the solver
/// then tries a point nearer to the last good one.
class NonlinearProgram {
 public:
  struct Bounds {
    Eigen::VectorXd x_lower, x_upper, g_lower, g_upper;
  };
  /// What the solver reports after each of its iterations.
  struct Iteration {
    int number = 0;
    double objective = 0;
    double violation = 0;  ///< largest violation of a constraint
  };

  virtual ~NonlinearProgram() = default;

  virtual int variables() const = 0;
  virtual int constraints() const = 0;
  virtual Bounds bounds() const = 0;
  virtual Eigen::VectorXd start() const = 0;

  virtual bool objective(const Eigen::VectorXd& x, double& f) = 0;
  virtual bool gradient(const Eigen::VectorXd& x, Eigen::VectorXd& df_dx) = 0;
  virtual bool constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) = 0;
  /// dg_dx is constraints() x variables().
  virtual bool jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& dg_dx) = 0;

  /// Second derivatives of factor * f + multipliers . g, a full symmetric matrix. Where hasHessian() is false the
  /// solver approximates them from gradients.
  virtual bool hasHessian() const { return false; }
  virtual bool hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                       Eigen::MatrixXd& h) {
    (void)x, (void)factor, (void)multipliers, (void)h;
    return false;
  }

  /// Called after each iteration; false stops the solver.
  virtual bool iteration(const Iteration&) { return true; }
};

}  // namespace carom::editing_detail
