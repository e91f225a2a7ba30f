// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/group/group_inputs.hpp"
#include "adjoint/group/group_path.hpp"

namespace carom::adjoint_detail {

/// Where slips end with the path of a group: see SlipTurns of one body.
struct GroupSlipTurns {
  Eigen::MatrixXd across;  ///< slips across their ways, by all inputs at that time: a row each
  Eigen::MatrixXd turned;  ///< the same by the turns of their frictions
  Eigen::MatrixXd change;  ///< of (x, theta, v, L) of all members by these turns
};
/// Nothing where none stops at t, or turns take nothing back.
std::optional<GroupSlipTurns> slipTurns(const GroupPath& path, const GroupInputs& inputs, double t);

}  // namespace carom::adjoint_detail
