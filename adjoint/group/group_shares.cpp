// SPDX-License-Identifier: MIT
#include "adjoint/group/group_shares.hpp"

#include <algorithm>

#include "adjoint/contact/rest_program.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// What of a force or an acceleration is rounding, as a share of the unit.
constexpr double kShareRounding = 1e-9;

}  // namespace

double roomOfFriction(const GroupContactInstant& c, const Vec3& f) {
  const double pressing = c.n.dot(f);
  return c.friction * pressing - (f - pressing * c.n).norm();
}

SharedForces sharedForces(const GroupScene& scene, const std::vector<GroupContact>& contacts, const GroupInstant& now, const GroupForces& forces) {
  SharedForces shared;
  shared.within = true;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContactInstant& c = now.contacts[k];
    shared.force.push_back(forces.force(k));
    const bool pushes = c.n.dot(forces.force(k)) >= 0;
    shared.within = shared.within && pushes && (c.mode != ContactMode::sticks || roomOfFriction(c, forces.force(k)) >= 0);
  }
  if (shared.within) return shared;
  RestProgram program;
  std::vector<double> reach(now.members.size(), 0);
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const int m : {contacts[k].member_a, contacts[k].member_b})
      if (m >= 0) {
        const auto i = static_cast<std::size_t>(m);
        reach[i] = std::max(reach[i], (now.contacts[k].point - now.members[i].x).norm());
      }
  program.load = -forces.wrench();
  for (std::size_t m = 0; m < now.members.size(); ++m) {
    program.mass.push_back(1 / now.members[m].inverse_mass);
    if (reach[m] > 0) program.load.segment<3>(6 * static_cast<Index>(m) + 3) /= reach[m];
  }
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContactInstant& c = now.contacts[k];
    RestProgram::Contact& at = program.contacts.emplace_back();
    at.a = contacts[k].member_a, at.b = contacts[k].member_b;
    const Vec3 push = c.mode == ContactMode::sticks ? c.n : c.push();
    at.normal = push / push.norm();
    at.friction = c.mode == ContactMode::sticks ? c.friction : 0;
    at.unit = scene.forceUnit(contacts[k]);
    const auto arm = [&](int m) -> Vec3 {
      const auto i = static_cast<std::size_t>(m);
      return (c.point - now.members[i].x) / reach[i];
    };
    if (at.a >= 0) at.arm_a = arm(at.a);
    if (at.b >= 0) at.arm_b = arm(at.b);
  }
  const RestForces found = restForces(program);
  if (!(found.unbalanced <= kShareRounding * scene.pull())) return shared;
  shared.within = found.room >= -kShareRounding;
  if (shared.within) shared.force = found.force;
  return shared;
}

}  // namespace carom::adjoint_detail
