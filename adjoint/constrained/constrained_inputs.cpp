// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_inputs.hpp"

namespace carom::adjoint_detail {

ConstrainedInputs::ConstrainedInputs(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& start) {
  const Pose own{start.x, scene.model->shapeToWorld(start.q.toRotationMatrix())};
  std::vector<int> sizes;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PersistentContact& c = contacts[k];
    const ContactJacobian J = c.is_first ? scene.geometry->jacobian(scene.body, c.with, c.features, own, scene.with[k])
                                         : scene.geometry->jacobian(c.with, scene.body, c.features, scene.with[k], own);
    size_count = static_cast<int>((c.is_first ? J.size_a : J.size_b).cols());
    std::size_t p = 0;
    while (p < partners.size() && partners[p].body != c.with) ++p;
    if (p == partners.size())
      partners.push_back({c.with, 0, 0, static_cast<int>((c.is_first ? J.size_b : J.size_a).cols())});
    partner_of.push_back(p);
  }
  count = kSizes + size_count;
  for (Partner& p : partners) {
    p.pose = count;
    p.sizes = count + 6;
    count += 6 + p.size_count;
  }
  friction = count;
  count += static_cast<int>(contacts.size());
}

std::optional<Eigen::Matrix<double, 7, 1>> ConstrainedInputs::columnOf(const ContactJacobian& J, const PersistentContact& contact,
                                                                std::size_t k, int column) const {
  const Partner& p = partners[partner_of[k]];
  const int own = contact.is_first ? 0 : 6, other = 6 - own;
  const auto &own_sizes = contact.is_first ? J.size_a : J.size_b, &other_sizes = contact.is_first ? J.size_b : J.size_a;
  if (column < 6) return J.pose.col(own + column);
  if (column >= kSizes && column < kSizes + size_count) return own_sizes.col(column - kSizes);
  if (column >= p.pose && column < p.sizes) return J.pose.col(other + column - p.pose);
  if (column >= p.sizes && column < p.sizes + p.size_count) return other_sizes.col(column - p.sizes);
  return std::nullopt;
}

}  // namespace carom::adjoint_detail
