// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/group/group_instant.hpp"

namespace carom::adjoint_detail {

/// The states at time t with all gaps 0, no speed along the normals, and none at contacts without slip: moved as little as possible, as
/// measured by the masses (11.13, 11.24).
std::vector<State> groupStart(const GroupScene& scene, const std::vector<GroupContact>& contacts, std::vector<State> states, double t,
                              int rounds = 2);

}  // namespace carom::adjoint_detail
