// SPDX-License-Identifier: MIT
#include "adjoint/simulate/followed_scene.hpp"

#include <algorithm>
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

bool joinsGroup(const Motion& motion, const Event& event) {
  return std::ranges::any_of(event.participants, [&](const Participant& p) {
    return motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())].trajectory().group() != nullptr;
  });
}

}  // namespace carom::adjoint_detail
