// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/group/group_forces.hpp"

namespace carom::adjoint_detail {

/// mu n.f - |f_t|, N
double roomOfFriction(const GroupContactInstant& c, const Vec3& f);

/// Forces within the cones that make the same accelerations as these do, where there are any: those of most room, or of the given forces
/// where they are within.
struct SharedForces {
  bool within = false;
  std::vector<Vec3> force;
};
SharedForces sharedForces(const GroupScene& scene, const std::vector<GroupContact>& contacts, const GroupInstant& now, const GroupForces& forces);

}  // namespace carom::adjoint_detail
