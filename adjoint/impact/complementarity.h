// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace carom {

/// y = -A^+ b for symmetric positive semidefinite A with b in its range, and its derivatives at constant rank:
/// dy = -A^+ (db + dA y) + (1 - A A^+) dA A^+ y. Throws NotComputable for numbers that are not finite; of no size it is
/// empty.
struct LeastNormSolve {
  Eigen::MatrixXd inverse, rest;  ///< A^+, 1 - A A^+
  Eigen::VectorXd y, inverse_y;

  LeastNormSolve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
  Eigen::VectorXd tangent(const Eigen::MatrixXd& dA, const Eigen::VectorXd& db) const;
  void pullback(const Eigen::VectorXd& y_bar, Eigen::MatrixXd& A_bar, Eigen::VectorXd& b_bar) const;
};

/// Contacts, in increasing order, that have an impulse in the solution of y >= 0, A y + b >= 0, complementary, with A
/// symmetric positive semidefinite and b in its range unless `in_range` is false (equation 4.3). Where redundant contacts leave a choice, the impulses
/// are spread over all of them. Throws NotComputable for numbers that are not finite, and where a b outside of
/// the range of A leaves no solution.
std::vector<int> activeContacts(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, bool in_range = true);

}  // namespace carom
