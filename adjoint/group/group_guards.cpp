// SPDX-License-Identifier: MIT
#include "adjoint/group/group_guards.hpp"

#include "adjoint/group/group_shares.hpp"

namespace carom::adjoint_detail {
std::vector<ConstrainedGuard> guardsOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t) {
  std::vector<ConstrainedGuard> guards;
  const auto* bodies = dynamic_cast<const BodyGeometry*>(scene.geometry.get());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContact& c = contacts[k];
    std::vector<FeatureLimit> limits;
    if (bodies)
      limits = bodies->limits(c.a, c.b, c.features, poseOf(scene, contacts, states, k, true, t), poseOf(scene, contacts, states, k, false, t));
    addGuards(static_cast<int>(k), c.mode, c.friction, std::move(limits), guards);
  }
  return guards;
}

std::vector<double> guardValues(const std::vector<ConstrainedGuard>& guards, const GroupScene& scene, const std::vector<GroupContact>& contacts,
                                const std::vector<State>& states, double t, const GroupInstant& now, const GroupForces& forces, bool redundant) {
  std::vector<double> values;
  bool outside = false;
  for (const ConstrainedGuard& guard : guards) {
    const auto k = static_cast<std::size_t>(guard.contact);
    const GroupContactInstant& c = now.contacts[k];
    const double pressing = forces.pressing(k), unit = scene.forceUnit(contacts[k]);
    switch (guard.cause) {
      case TransitionCause::lifts:
        values.push_back(pressing / unit);
        outside = outside || values.back() < 0;
        break;
      case TransitionCause::slips:
        values.push_back(roomOfFriction(c, forces.force(k)) / unit);
        outside = outside || values.back() < 0;
        break;
      case TransitionCause::sticks:
        values.push_back(c.slip.dot(c.u) / scene.speed);
        break;
      default:
        values.push_back(borderValue(guard.border, poseOf(scene, contacts, states, k, guard.border.body == contacts[k].a, t), c.point, c.n));
    }
  }
  if (!redundant || !outside) return values;
  const SharedForces shared = sharedForces(scene, contacts, now, forces);
  if (!shared.within) return values;
  for (std::size_t g = 0; g < guards.size(); ++g) {
    const auto k = static_cast<std::size_t>(guards[g].contact);
    const double pressing = now.contacts[k].n.dot(shared.force[k]), unit = scene.forceUnit(contacts[k]);
    if (guards[g].cause == TransitionCause::lifts) values[g] = std::max(0.0, pressing / unit);
    if (guards[g].cause == TransitionCause::slips)
      values[g] = std::max(0.0, roomOfFriction(now.contacts[k], shared.force[k]) / unit);
  }
  return values;
}

}  // namespace carom::adjoint_detail
