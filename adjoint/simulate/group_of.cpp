// SPDX-License-Identifier: MIT
#include "adjoint/simulate/group_of.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/group/group_modes.hpp"
#include "adjoint/group/group_start.hpp"
#include "adjoint/motion/pair_rules.hpp"

namespace carom::adjoint_detail {
namespace {

bool has(const std::vector<int>& members, int body) { return std::ranges::find(members, body) != members.end(); }

}  // namespace

GroupScene groupOf(const Motion& motion, const std::vector<int>& members, const std::vector<State>& states, const std::vector<Contact>& closed,
                   double time) {
  GroupScene scene;
  scene.geometry = motion.geometry;
  scene.time = time;
  scene.length = kInfinity;
  double speed = 0;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const State& state = states[m];
    const std::shared_ptr<const BodyModel> model = motion.modelOf(members[m]);
    double reach = 0;
    for (const Contact& c : closed)
      if (c.a == members[m] || c.b == members[m]) reach = std::max(reach, (c.at.point - state.x).norm());
    const Vec3 gravity = model->gravity_factor * motion.scene->gravity, spin = model->inverseInertiaWorld(state.q.toRotationMatrix()) * state.L;
    scene.members.push_back({members[m], model, gravity});
    scene.length = std::min(scene.length, reach);
    scene.size = std::max(scene.size, reach + state.x.lpNorm<Eigen::Infinity>());
    speed = std::max(speed, std::sqrt(gravity.norm() * reach + state.v.squaredNorm()) + spin.norm() * reach);
  }
  scene.speed = speed;
  for (const Contact& c : closed) {
    const bool inside = has(members, c.a) && has(members, c.b);
    scene.with.push_back(inside ? Support() : supportOf(motion, has(members, c.a) ? c.b : c.a, time));
  }
  return scene;
}

namespace {

// Of members from these states, in the modes of `like`.
std::shared_ptr<GroupPath> groupAlong(const Motion& motion, const GroupPath& like, std::vector<State> states, double time) {
  std::vector<int> members;
  for (const GroupMember& m : like.scene().members) members.push_back(m.body);
  const auto poseOf = [&](int body) -> Pose {
    const auto m = std::ranges::find(members, body);
    if (m == members.end()) return supportOf(motion, body, time).poseAt(time);
    const State& s = states[static_cast<std::size_t>(m - members.begin())];
    return {s.x, motion.modelOf(body)->shapeToWorld(s.q.toRotationMatrix())};
  };
  std::vector<Contact> closed;
  std::vector<GroupContact> contacts = like.contacts();
  const Scene& scene = *motion.scene;
  const auto material = [&](int body) -> const Material& { return materialOf(scene, scene.bodies[static_cast<std::size_t>(body)]); };
  for (GroupContact& c : contacts) {
    Contact& at = closed.emplace_back();
    at.a = c.a, at.b = c.b, at.features = c.features;
    at.at = motion.geometry->contact(c.a, c.b, c.features, poseOf(c.a), poseOf(c.b));
    c.friction = rulesOf(material(c.a), material(c.b)).friction.value;
  }
  GroupScene of = groupOf(motion, members, states, closed, time);
  contacts = inSameModes(of, contacts, states, time);
  std::vector<State> start = groupStart(of, contacts, std::move(states), time);
  return std::make_shared<GroupPath>(std::move(of), std::move(contacts), like.redundant(), std::move(start), motion.duration);
}

}  // namespace

const GroupPath* groupAfter(const Motion& motion, const Participant& p) {
  if (p.stays) return nullptr;
  return motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())].trajectory().group();
}

std::vector<std::optional<Arc>> groupsAlong(const Motion& like, const Event& was, const Motion& motion, const std::vector<State>& after, double time) {
  std::vector<std::optional<Arc>> arcs(after.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    const GroupPath* group = groupAfter(like, was.participants[i]);
    if (!group || arcs[i]) continue;
    std::vector<std::size_t> members;
    std::vector<State> states;
    for (const GroupMember& m : group->scene().members) {
      members.push_back(static_cast<std::size_t>(was.find(m.body) - was.participants.data()));
      states.push_back(after[members.back()]);
    }
    const std::shared_ptr<GroupPath> path = groupAlong(motion, *group, std::move(states), time);
    for (std::size_t slot = 0; slot < members.size(); ++slot) {
      const int body = was.participants[members[slot]].body;
      arcs[members[slot]].emplace(motion.modelOf(body), motion.plan.bodies[static_cast<std::size_t>(body)].tier, path, time, path->startStates()[slot],
                                  static_cast<int>(slot));
    }
  }
  return arcs;
}

}  // namespace carom::adjoint_detail
