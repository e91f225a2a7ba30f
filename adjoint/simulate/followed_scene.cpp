// SPDX-License-Identifier: MIT
#include "adjoint/simulate/followed_scene.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/flight/trajectory.hpp"

namespace carom::adjoint_detail {

void requireSameParts(const Scene& was, const Scene& scene) {
  const auto same = [](std::size_t found, std::size_t expected, const char* what) {
    if (found != expected)
      throw InputError("found a scene with " + std::to_string(found) + " " + what + ", expected the " +
                       std::to_string(expected) + " of the motion that is followed");
  };
  same(scene.bodies.size(), was.bodies.size(), "bodies");
  same(scene.materials.size(), was.materials.size(), "materials");
  same(scene.tilts.size(), was.tilts.size(), "tilts");
}

Plan planFor(const Motion& like, const Scene& scene, const std::vector<BodyModel>& models) {
  Plan plan = like.plan, everything;
  for (std::size_t b = 0; b < models.size(); ++b) {
    const BodyModel& was = (*like.models)[b];
    if (!models[b].moving) continue;
    const bool same = symmetryAxis(models[b].inertia) == symmetryAxis(was.inertia) &&
                      models[b].center.isZero(0) == was.center.isZero(0);
    if (same) continue;
    if (everything.bodies.empty()) everything = makePlan(scene);
    plan.bodies[b] = everything.bodies[b];
  }
  return plan;
}

bool orderByTime(Motion& motion) {
  const auto earlier = [](const Event& a, const Event& b) { return a.time < b.time; };
  if (std::ranges::is_sorted(motion.events, earlier)) return false;
  std::vector<int> order(motion.events.size()), place_of(motion.events.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::ranges::stable_sort(order, {}, [&](int e) { return motion.events[at(e)].time; });
  std::vector<Event> sorted;
  sorted.reserve(order.size());
  for (int e : order) {
    place_of[at(e)] = static_cast<int>(sorted.size());
    sorted.push_back(std::move(motion.events[at(e)]));
  }
  motion.events = std::move(sorted);
  for (WorldLine& line : motion.world_lines)
    for (int& e : line.events) e = place_of[at(e)];
  return true;
}

}  // namespace carom::adjoint_detail
