// SPDX-License-Identifier: MIT
#include "ode_bridge/collision_classes.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace carom::ode_bridge_detail {

CollisionClasses::CollisionClasses(const Scene& scene) {
  const bool plain = std::none_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) {
    return body.kinematic || !body.collision_filter.empty();
  });
  if (plain) return;
  using Names = std::vector<std::string>;
  std::map<std::tuple<bool, Names, Names, Names>, std::size_t> known;
  std::vector<const Body*> first;  // of each class
  for (const Body& body : scene.bodies) {
    const CollisionFilter& f = body.collision_filter;
    const auto [at, made] =
        known.try_emplace({body.immovable(), f.systems, f.collide_with, f.not_collide_with}, first.size());
    if (made) first.push_back(&body);
    class_.push_back(at->second);
  }
  count_ = first.size();
  table_.reserve(count_ * count_);
  for (const Body* a : first)
    for (const Body* b : first) table_.push_back(mayCollide(*a, *b));
}

}  // namespace carom::ode_bridge_detail
