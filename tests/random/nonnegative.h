// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace carom::test {

/// What columns with weights >= 0 leave of b at the least, as a share, by Lawson and Hanson.
double leastLeft(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace carom::test
