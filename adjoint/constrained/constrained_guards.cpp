// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_guards.hpp"

namespace carom::adjoint_detail {
namespace {

bool isLength(const ConstrainedGuard& guard) {
  return guard.cause == TransitionCause::leaves && !guard.border.point_weight.isZero(0);
}

double forceUnit(const ConstrainedScene& scene) { return scene.model->mass * scene.speed * scene.speed / scene.length; }

}  // namespace

double borderValue(const FeatureLimit& limit, const Pose& pose, const Vec3& point, const Vec3& n) {
  const Vec3 at = pose.R.transpose() * (point - pose.x);
  double value = 0;
  if (limit.radius > 0) {
    const Vec3 to = at - (limit.border + limit.radius * limit.point_weight);
    value = limit.radius - (to - limit.axis.dot(to) * limit.axis).norm();
  } else if (!limit.point_weight.isZero(0)) {
    value = limit.point_weight.dot(at - limit.border);
  }
  return value + limit.normal_weight.dot(pose.R.transpose() * n);
}

void addGuards(int contact, ContactMode mode, double friction, std::vector<FeatureLimit> limits, std::vector<ConstrainedGuard>& guards) {
  guards.push_back({TransitionCause::lifts, contact, -1, {}});
  if (mode == ContactMode::sticks) guards.push_back({TransitionCause::slips, contact, -1, {}});
  if (mode == ContactMode::slides && friction > 0) guards.push_back({TransitionCause::sticks, contact, -1, {}});
  for (std::size_t i = 0; i < limits.size(); ++i)
    if (!limits[i].point_weight.isZero(0) || limits[i].rolls_over)
      guards.push_back({TransitionCause::leaves, contact, static_cast<int>(i), std::move(limits[i])});
}

std::vector<ConstrainedGuard> guardsOf(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& start,
                                       double t) {
  std::vector<ConstrainedGuard> guards;
  const auto* bodies = dynamic_cast<const BodyGeometry*>(scene.geometry.get());
  const Pose own{start.x, scene.model->shapeToWorld(start.q.toRotationMatrix())};
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PersistentContact& c = contacts[k];
    std::vector<FeatureLimit> limits;
    if (bodies)
      limits = c.is_first ? bodies->limits(scene.body, c.with, c.features, own, scene.with[k].poseAt(t))
                          : bodies->limits(c.with, scene.body, c.features, scene.with[k].poseAt(t), own);
    addGuards(static_cast<int>(k), c.mode, c.friction, std::move(limits), guards);
  }
  return guards;
}

double guardValue(const ConstrainedGuard& guard, const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts,
                  const Pose& own, double t, const ConstrainedInstant& now, const ConstrainedForces& forces) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const ContactInstant<double>& c = now.contacts[k];
  switch (guard.cause) {
    case TransitionCause::lifts:
      return forces.pressing(k) / forceUnit(scene);
    case TransitionCause::slips: {
      const double pressing = forces.pressing(k);
      return (c.friction * pressing - (forces.force(k) - pressing * c.n).norm()) / forceUnit(scene);
    }
    case TransitionCause::sticks:
      return c.slip.dot(now.velocityAt(k)) / scene.speed;
    case TransitionCause::leaves:
    {
      const PersistentContact& of = contacts[k];
      const Pose pose = guard.border.body == of.with ? scene.with[k].poseAt(t) : own;
      return borderValue(guard.border, pose, own.x + c.r, of.is_first ? c.n : Vec3(-c.n));
    }
    default:
      return 1;
  }
}

double guardRounding(const ConstrainedGuard& guard, double size_of_positions) {
  switch (guard.cause) {
    case TransitionCause::lifts:
    case TransitionCause::slips:
      return 1e-11;
    case TransitionCause::sticks:
      return 1e-13;
    default:
      return 1e-14 * (isLength(guard) ? size_of_positions : 1);
  }
}

double shareOfMargin(const ConstrainedGuard& guard, double length) { return isLength(guard) ? 1 / length : 1; }

}  // namespace carom::adjoint_detail
