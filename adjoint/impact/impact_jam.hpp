// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

/// Whether friction at these contacts may grow at will, as bodies are wedged between ones that impulses do not move: there are impulses X
/// within the cones that move nothing, K X = 0, and that the velocities b oppose, b.X < 0. X.K X/2 + b.X has no least value then
/// (equation 4.4). K, b: 3 rows for each of all contacts; normal, friction: of those in `contacts`.
bool frictionGrows(const Eigen::MatrixXd& K, const Eigen::VectorXd& b, const std::vector<int>& contacts, const std::vector<Vec3>& normal,
                   const std::vector<double>& friction);

}  // namespace carom::adjoint_detail
