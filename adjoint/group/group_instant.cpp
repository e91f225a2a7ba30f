// SPDX-License-Identifier: MIT
#include "adjoint/group/group_instant.hpp"

namespace carom::adjoint_detail {

Pose poseOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, std::size_t k, bool of_a, double t) {
  const int member = of_a ? contacts[k].member_a : contacts[k].member_b;
  if (member < 0) return scene.with[k].poseAt(t);
  const State& s = states[static_cast<std::size_t>(member)];
  return {s.x, scene.members[static_cast<std::size_t>(member)].model->shapeToWorld(s.q.toRotationMatrix())};
}

void placeInstant(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t,
                  GroupInstant& now) {
  now.members.resize(states.size());
  std::vector<Pose> poses(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const GroupMember& of = scene.members[i];
    const State& s = states[i];
    MemberInstant& m = now.members[i];
    const Mat3 R = s.q.toRotationMatrix();
    m.x = s.x, m.v = s.v, m.L = s.L, m.gravity = of.gravity;
    m.A = of.model->inverseInertiaWorld(R);
    m.w = m.A * s.L;
    m.inverse_mass = of.model->inverse_mass;
    poses[i] = {s.x, of.model->shapeToWorld(R)};
  }
  now.contacts.resize(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContact& of = contacts[k];
    GroupContactInstant& c = now.contacts[k];
    Pose pose[2];
    PoseRate rate[2];
    SupportInstant<double> support[2];
    const int member[2] = {of.member_a, of.member_b};
    for (int side = 0; side < 2; ++side) {
      if (member[side] >= 0) {
        const auto i = static_cast<std::size_t>(member[side]);
        pose[side] = poses[i];
        rate[side] = {now.members[i].v, now.members[i].w};
      } else {
        support[side] = scene.with[k].at(t);
        pose[side] = {support[side].x, support[side].R};
        rate[side] = {support[side].v, support[side].w};
      }
    }
    const ContactMotion m = scene.geometry->motion(of.a, of.b, of.features, pose[0], pose[1], rate[0], rate[1]);
    c.mode = of.mode, c.friction = of.friction;
    c.n = m.at.normal, c.point = m.at.point, c.gap = m.at.gap;
    c.normal_rate = m.normal_rate, c.point_rate = m.point_rate;
    c.u.setZero(), c.driven_a.setZero(), c.driven_b.setZero();
    for (int side = 0; side < 2; ++side) {
      const double sign = side == 0 ? 1 : -1;
      if (member[side] >= 0) {
        const MemberInstant& body = now.members[static_cast<std::size_t>(member[side])];
        c.u += sign * (body.v + body.w.cross(Vec3(c.point - body.x)));
      } else if (scene.with[k].drives()) {
        c.u += sign * support[side].velocityAt(c.point, c.n);
        (side == 0 ? c.driven_a : c.driven_b) = support[side].accelerationAt(c.point, c.n, c.point_rate, c.normal_rate);
      }
    }
  }
}

GroupInstant instantOf(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t,
                       const std::vector<Vec3>& slip) {
  GroupInstant now;
  placeInstant(scene, contacts, states, t, now);
  for (std::size_t k = 0; k < contacts.size(); ++k) now.contacts[k].slip = slip[k];
  return now;
}

}  // namespace carom::adjoint_detail
