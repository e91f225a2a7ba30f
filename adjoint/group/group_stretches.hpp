// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/group/group_inputs.hpp"
#include "adjoint/group/group_path.hpp"

/// The pieces of the path of a group over which derivatives are taken in one go, and how its slopes vary at their nodes: as those of one body
/// (ConstrainedStretch).
namespace carom::adjoint_detail {

struct GroupStretch {
  const GroupStep* step;
  double from, until;
  std::vector<Vec3> straight;
};

/// Those from the start of a path to a time, in order.
std::vector<GroupStretch> stretchesUntil(const GroupPath& path, double t);

/// Derivatives of the slopes (x, theta, v, L) of the tangent at these states at time t, by the tangent of the states there and the other
/// inputs: 12 rows a member. `slip`: of each contact the direction that its slip keeps.
Eigen::MatrixXd slopeRates(const GroupPath& path, const GroupInputs& inputs, const std::vector<State>& states, double t, const std::vector<Vec3>& slip);

/// Across the slip of a contact, along its face.
inline Vec3 acrossSlip(const GroupInstant& now, std::size_t k) { return now.contacts[k].n.cross(now.contacts[k].slip); }

}  // namespace carom::adjoint_detail
