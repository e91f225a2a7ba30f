// SPDX-License-Identifier: MIT
#include "adjoint/group/group_guards.hpp"

#include "adjoint/group/group_shares.hpp"

namespace carom::adjoint_detail {
namespace {

Pose poseOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, std::size_t k, bool of_a, double t) {
  const int member = of_a ? contacts[k].member_a : contacts[k].member_b;
  if (member < 0) return scene.with[k].poseAt(t);
  const State& s = states[static_cast<std::size_t>(member)];
  return {s.x, scene.members[static_cast<std::size_t>(member)].model->shapeToWorld(s.q.toRotationMatrix())};
}

double borderValue(const FeatureLimit& limit, const Pose& pose, const GroupContactInstant& c) {
  const Vec3 at = pose.R.transpose() * (c.point - pose.x);
  double value = 0;
  if (limit.radius > 0) {
    const Vec3 to = at - (limit.border + limit.radius * limit.point_weight);
    value = limit.radius - (to - limit.axis.dot(to) * limit.axis).norm();
  } else if (!limit.point_weight.isZero(0)) {
    value = limit.point_weight.dot(at - limit.border);
  }
  return value + limit.normal_weight.dot(pose.R.transpose() * c.n);
}

}  // namespace

std::vector<ConstrainedGuard> guardsOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t) {
  std::vector<ConstrainedGuard> guards;
  const auto* bodies = dynamic_cast<const BodyGeometry*>(scene.geometry.get());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContact& c = contacts[k];
    const int contact = static_cast<int>(k);
    guards.push_back({TransitionCause::lifts, contact, -1, {}});
    if (c.mode == ContactMode::sticks) guards.push_back({TransitionCause::slips, contact, -1, {}});
    if (c.turns()) guards.push_back({TransitionCause::sticks, contact, -1, {}});
    if (!bodies) continue;
    std::vector<FeatureLimit> limits =
        bodies->limits(c.a, c.b, c.features, poseOf(scene, contacts, states, k, true, t), poseOf(scene, contacts, states, k, false, t));
    for (std::size_t i = 0; i < limits.size(); ++i)
      if (!limits[i].point_weight.isZero(0) || limits[i].rolls_over)
        guards.push_back({TransitionCause::leaves, contact, static_cast<int>(i), std::move(limits[i])});
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
        values.push_back((c.friction * pressing - (forces.force(k) - pressing * c.n).norm()) / unit);
        outside = outside || values.back() < 0;
        break;
      case TransitionCause::sticks:
        values.push_back(c.slip.dot(c.u) / scene.speed);
        break;
      default:
        values.push_back(borderValue(guard.border, poseOf(scene, contacts, states, k, guard.border.body == contacts[k].a, t), c));
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
      values[g] = std::max(0.0, (now.contacts[k].friction * pressing - (shared.force[k] - pressing * now.contacts[k].n).norm()) / unit);
  }
  return values;
}

double guardRounding(const ConstrainedGuard& guard, const GroupScene& scene) {
  switch (guard.cause) {
    case TransitionCause::lifts:
    case TransitionCause::slips:
      return 1e-11;
    case TransitionCause::sticks:
      return 1e-13;
    default:
      return 1e-14 * (guard.border.point_weight.isZero(0) ? 1 : scene.size);
  }
}

}  // namespace carom::adjoint_detail
