// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

/// The directions of slips at the instant at which they come to 0, u' = -|u'| d, by Newton's method on (n x d).u' = 0.
namespace carom::adjoint_detail {

/// The direction of a slip slower than this share of the unit of speed is better known by the nodes of the step.
inline constexpr double kNoDirection = 1e-7;
/// Rounds of the method.
inline constexpr int kAlignRounds = 3;

/// Turns, rad, of directions with residuals r and derivatives J of these; nothing where turns decide nothing, or the directions are further
/// off than those at nodes are. `pull`: m/s^2, a large acceleration.
std::optional<Eigen::VectorXd> turnsAtStop(const Eigen::MatrixXd& J, const Eigen::VectorXd& r, double pull);

}  // namespace carom::adjoint_detail
