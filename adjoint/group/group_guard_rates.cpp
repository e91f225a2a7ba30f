// SPDX-License-Identifier: MIT
#include "adjoint/base/errors.h"
#include "adjoint/constrained/border_rate.hpp"
#include "adjoint/group/group_force_rates.hpp"
#include "adjoint/group/group_limit.hpp"

namespace carom::adjoint_detail {
namespace {

using Number = GroupLanes::Number;

Number borderRate(const FeatureLimit& limit, const GroupContact& c, std::size_t k, const GroupInputs& inputs, const GroupRates& rates,
                  const GroupLanes& lanes, int first, int count) {
  const GroupLanes::Contact& at = lanes.contacts[k];
  const int member = limit.body == c.a ? c.member_a : c.member_b;
  if (member >= 0) {
    const auto m = static_cast<std::size_t>(member);
    return borderRateOf(limit, lanes.members[m].x, lanes.members[m].R, {inputs.members[m].sizes - first, inputs.members[m].size_count}, at.point, at.n);
  }
  const SupportInstant<Number> support = rates.support(k, first, count);
  const SupportColumns& partner = inputs.partners[static_cast<std::size_t>(inputs.partner_of[k])];
  return borderRateOf(limit, support.x, support.R, {partner.sizes - first, partner.size_count}, at.point, at.n);
}

}  // namespace

GroupLanes::Number guardRateOf(const ConstrainedGuard& guard, const std::vector<GroupContact>& contacts, const GroupInputs& inputs,
                               const GroupForceRates& force_rates, const std::optional<GroupLimit>& limit, const GroupRates& rates,
                               const GroupLanes& lanes, int first, int count) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const GroupLanes::Contact& c = lanes.contacts[k];
  if (guard.cause == TransitionCause::leaves) return borderRate(guard.border, contacts[k], k, inputs, rates, lanes, first, count);
  if (guard.cause == TransitionCause::sticks) return c.slip.dot(c.u);
  const GroupForceLanes forces = force_rates.in(lanes);
  if (limit) return limit->rate(lanes, forces);
  const Number pressing = c.n.dot(forces.forces[k]);
  if (guard.cause == TransitionCause::lifts) return pressing;
  return c.friction * pressing - sqrt(V3<Number>(forces.forces[k] - c.n * pressing).squaredNorm());
}

}  // namespace carom::adjoint_detail
