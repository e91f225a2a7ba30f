// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/group/group_instant.hpp"

namespace carom::adjoint_detail {

/// The states at time t with all gaps 0, no speed along the normals, and none at contacts without slip: moved as little as possible, as
/// measured by the masses (11.13, 11.24).
std::vector<State> groupStart(const GroupScene& scene, const std::vector<GroupContact>& contacts, std::vector<State> states, double t,
                              int rounds = 2);


/// Rows of the gaps by (x, theta) of all members, 6 columns each.
Eigen::MatrixXd gapRows(const GroupInstant& now, const std::vector<GroupContact>& contacts);
/// Rows of n.u of each contact, or of u where there is no slip at the start, by (v, w) of all members.
Eigen::MatrixXd speedRows(const GroupInstant& now, const std::vector<GroupContact>& contacts);
/// The same of u at some contacts, 3 rows each.
Eigen::MatrixXd velocityRows(const GroupInstant& now, const std::vector<GroupContact>& contacts, const std::vector<std::size_t>& at);
/// M^-1 C^T (C M^-1 C^T)^+, by which a change of (v, w), or of poses, undoes that of rows C.
Eigen::MatrixXd undoing(const GroupInstant& now, const Eigen::MatrixXd& C);

}  // namespace carom::adjoint_detail
