// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// Internal to editing/.
namespace carom::editing_detail {

/// x that minimises |A x + b|^2 + (kSmallness |x|)^2 subject to lower <= x <= upper (which may be infinite), by the
/// active set of Stark and Parker (Computational Statistics 10, 1995). The second term makes it unique.
Eigen::VectorXd boundedLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
                                    const Eigen::VectorXd& upper);
inline constexpr double kSmallness = 1e-7;

}  // namespace carom::editing_detail
