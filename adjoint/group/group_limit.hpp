// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/constrained/constrained_guards.hpp"
#include "adjoint/group/group_force_rates.hpp"

namespace carom::adjoint_detail {

/// Where contacts that stick could share their loads otherwise and the best share is at the limit of friction, (11.37) of docs/equations.md:
/// the least room t = max min_k (mu n.f - |f_t|)_k over shares z, P z = 0. By z it is stationary, sum_k l_k d(room_k)/dz = 0, so that its
/// rates are those of sum_k l_k room_k along any shares that stay some.
class GroupLimit {
 public:
  /// At an instant at which a guard falls to 0. Throws NotComputable where the weights l are not unique: there is no derivative.
  GroupLimit(const GroupScene& scene, const std::vector<GroupContact>& contacts, const GroupInstant& now, const GroupForces& forces);
  /// Of the least room, up to a factor.
  GroupLanes::Number rate(const GroupLanes& lanes, const GroupForceLanes& forces) const;

 private:
  struct Weighted {
    std::size_t contact;
    double weight;
    bool lifts;  // no force at all: n.f in place of the room
  };

  const std::vector<GroupContact>& contacts_;
  std::vector<Weighted> weighted_;
  std::vector<Vec3> share_;        // of each contact, beyond the forces
  Eigen::MatrixXd wrenches_;       // of the forces at contacts that stick, 3 each
  std::vector<std::size_t> stick_;
};

/// The value of a guard up to a factor, with its rates (see guardValues). `limit`: where the guard is that of all shares.
GroupLanes::Number guardRateOf(const ConstrainedGuard& guard, const std::vector<GroupContact>& contacts, const GroupInputs& inputs,
                               const GroupForceRates& force_rates, const std::optional<GroupLimit>& limit, const GroupRates& rates,
                               const GroupLanes& lanes, int first, int count);

}  // namespace carom::adjoint_detail
