// SPDX-License-Identifier: MIT
#include "adjoint/derivative/influence.hpp"

#include <algorithm>
#include <limits>

namespace carom::adjoint_detail {
namespace {

bool isZero(const BodyDerivative& d) {
  return d.position.isZero(0) && d.orientation.isZero(0) && d.velocity.isZero(0) && d.angular_velocity.isZero(0) &&
         d.mass == 0 && d.density == 0 && d.inertia.isZero(0) && d.size.isZero(0) &&
         d.surface_velocity.isZero(0) && d.surface_angular_velocity.isZero(0);
}

bool isZero(const MaterialDerivative& d) {
  return d.elasticity == 0 && d.friction == 0 && d.tangential_elasticity == 0;
}

}  // namespace

Influence::Influence(const Motion& motion, const std::vector<const SceneTangent*>& directions)
    : first_arc_(motion.world_lines.size(), std::numeric_limits<int>::max()), events_(motion.events.size()) {
  const Scene& scene = *motion.scene;
  const auto changed = [&](auto&& changes) {
    return std::any_of(directions.begin(), directions.end(), [&](const auto& d) { return changes(*d); });
  };
  const bool field = changed([](const SceneTangent& d) { return !d.gravity.isZero(0); });
  std::vector<bool> surface(scene.bodies.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    if (changed([&](const SceneTangent& d) { return !isZero(d.bodies[b]); }) || (field && !body.fixed))
      first_arc_[b] = 0;
    const int m = materialIndexOf(scene, static_cast<int>(b));
    surface[b] =
        m >= 0 && changed([&](const SceneTangent& d) { return !isZero(d.materials[static_cast<std::size_t>(m)]); });
  }
  const auto tilted = [&](int tilt) {
    return tilt >= 0 &&
           changed([&](const SceneTangent& d) { return !d.tilts[static_cast<std::size_t>(tilt)].isZero(0); });
  };
  const auto at = [](const auto& of, int body) { return of[static_cast<std::size_t>(body)]; };
  for (std::size_t e = 0; e < motion.events.size(); ++e) {
    const Event& event = motion.events[e];
    const bool influenced = std::any_of(event.participants.begin(), event.participants.end(),
                                        [&](const Participant& p) { return arc(p.body, p.arc); }) ||
                            std::any_of(event.contacts.begin(), event.contacts.end(), [&](const Contact& c) {
                              // a fixed body takes no part, and has one arc
                              return arc(c.a, 0) || arc(c.b, 0) || at(surface, c.a) || at(surface, c.b) ||
                                     tilted(c.tilt_a) || tilted(c.tilt_b);
                            });
    events_[e] = influenced;
    if (!influenced) continue;
    for (const Participant& p : event.participants) {
      int& first = first_arc_[static_cast<std::size_t>(p.body)];
      if (!p.stays) first = std::min(first, p.arc + 1);
    }
  }
}

}  // namespace carom::adjoint_detail
