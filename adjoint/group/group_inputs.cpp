// SPDX-License-Identifier: MIT
#include "adjoint/group/group_inputs.hpp"

#include <algorithm>

#include "adjoint/group/group_instant.hpp"

namespace carom::adjoint_detail {

GroupInputs::GroupInputs(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& start) {
  for (const GroupMember& m : scene.members) members.push_back({m.body, 0, 0, 0});
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContact& c = contacts[k];
    const ContactJacobian J = scene.geometry->jacobian(c.a, c.b, c.features, poseOf(scene, contacts, start, k, true, scene.time),
                                                       poseOf(scene, contacts, start, k, false, scene.time));
    int partner = -1;
    for (const bool of_a : {true, false}) {
      const int member = of_a ? c.member_a : c.member_b, body = of_a ? c.a : c.b;
      const int size_count = static_cast<int>((of_a ? J.size_a : J.size_b).cols());
      if (member >= 0) {
        members[static_cast<std::size_t>(member)].size_count = size_count;
        continue;
      }
      const auto found = std::ranges::find(partners, body, &SupportColumns::body);
      partner = static_cast<int>(found - partners.begin());
      if (found != partners.end()) continue;
      partners.push_back({body, 0, 0, size_count});
      if (scene.with[k].moves()) partners.back().velocity = 0;
      if (scene.with[k].has_belt) partners.back().surface = 0;
    }
    partner_of.push_back(partner);
  }
  gravity = states();
  count = gravity + 3;
  for (Member& m : members) {
    m.mass = count, m.sizes = count + 7;
    count += 7 + m.size_count;
  }
  for (SupportColumns& p : partners) count = p.place(count);
  friction = count;
  count += static_cast<int>(contacts.size());
}

Eigen::VectorXd timeShift(const GroupScene& scene, const GroupInputs& inputs, double t) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(inputs.count);
  for (std::size_t k = 0; k < inputs.partner_of.size(); ++k)
    if (inputs.partner_of[k] >= 0) shiftSupport(scene.with[k], inputs.partners[static_cast<std::size_t>(inputs.partner_of[k])], t, shift);
  return shift;
}

}  // namespace carom::adjoint_detail
