// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_instant.hpp"

namespace carom::adjoint_detail {

void placeInstant(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& state, const Mat3& R,
                  double t, ConstrainedInstant& now) {
  const BodyModel& model = *scene.model;
  BodyInstant<double>& body = now.body;
  body.v = state.v, body.L = state.L, body.gravity = scene.gravity;
  body.A = model.inverseInertiaWorld(R);
  body.omega = body.A * state.L;
  body.inverse_mass = model.inverse_mass;
  const Pose pose{state.x, model.shapeToWorld(R)};
  now.contacts.resize(contacts.size());
  now.gap_rate.resize(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PersistentContact& held = contacts[k];
    const SupportInstant<double> support = scene.with[k].at(t);
    const ContactMotion m = scene.contact(held, pose, {state.v, body.omega}, {support.x, support.R}, {support.v, support.w});
    const double sign = held.is_first ? 1 : -1;
    ContactInstant<double>& c = now.contacts[k];
    c.mode = held.mode;
    c.n = sign * m.at.normal, c.normal_rate = sign * m.normal_rate;
    c.r = m.at.point - state.x, c.point_rate = m.point_rate;
    c.friction = held.friction;
    now.gap_rate[k] = m.gap_rate;
    if (!scene.with[k].drives()) continue;
    c.support_velocity = support.velocityAt(m.at.point, c.n);
    c.support_acceleration = support.accelerationAt(m.at.point, c.n, m.point_rate, c.normal_rate);
  }
}

ConstrainedInstant instantOf(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& state,
                      double t, const std::vector<Vec3>& slip) {
  ConstrainedInstant now;
  placeInstant(scene, contacts, state, state.q.toRotationMatrix(), t, now);
  for (std::size_t k = 0; k < contacts.size(); ++k) now.contacts[k].slip = slip[k];
  return now;
}

}  // namespace carom::adjoint_detail
