// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_guards.hpp"
#include "adjoint/group/group_forces.hpp"

namespace carom::adjoint_detail {

/// All guards of a group with these states at time t.
std::vector<ConstrainedGuard> guardsOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t);

/// Their values, in the units of ConstrainedGuard's. Where redundant contacts that stick could share their loads otherwise, lifting and
/// slipping have the room of the best share (11.36).
std::vector<double> guardValues(const std::vector<ConstrainedGuard>& guards, const GroupScene& scene, const std::vector<GroupContact>& contacts,
                                const std::vector<State>& states, double t, const GroupInstant& now, const GroupForces& forces, bool redundant);

}  // namespace carom::adjoint_detail
