// SPDX-License-Identifier: MIT
#include "cli/components.h"

#include <algorithm>
#include <string>

#include "adjoint/constrained/ride_path.hpp"
#include "adjoint/simulate/simulate.h"

namespace carom::cli {
namespace {

using Component = formats_detail::ScenePlan::Component;

// Of a motion of this length, s, what it begins with alone is asked.
constexpr double kAtOnce = 1e-9;

// ", on 'lift', which carries them"; nothing where they stand still.
std::string carriedBy(const Motion& motion, const Event& event, int body) {
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(event.find(body)->next())];
  const adjoint_detail::RidePath* ride = arc.trajectory().ride();
  if (!ride) return {};
  return ", on " + namesOf(motion, ride->carrier()) + (ride->carrier().parts.size() > 1 ? ", which carry them" : ", which carries them");
}

std::string whyItRests(const Motion& motion, const Event& event, const std::vector<int>& bodies) {
  const bool opposed = std::ranges::none_of(bodies, [&](int body) {
    const Participant& p = *event.find(body);
    return motion.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(p.next())].trajectory().isLoose();
  });
  const auto contacts = std::ranges::count_if(event.contacts, &Contact::lasts);
  return "forces within the cones of friction at " + std::to_string(contacts) + " contacts hold all of them" + carriedBy(motion, event, bodies.front()) +
         (opposed ? "" : "; some motion of them is not opposed");
}

}  // namespace

std::vector<Component> componentsAtStart(const Scene& scene, OdeContacts& contacts) {
  std::vector<Component> found;
  SimulateOptions options;
  options.impact_limit = scene.bodies.size();
  const Motion motion = simulate(scene, contacts, kAtOnce, options);
  for (const Event& event : motion.events) {
    std::vector<int> bodies;  // that impulses move
    for (const Participant& p : event.participants)
      if (!scene.bodies[static_cast<std::size_t>(p.body)].immovable()) bodies.push_back(p.body);
    if (event.kind != EventKind::placed || bodies.size() < 2) continue;
    Component& component = found.emplace_back();
    component.bodies = bodies;
    component.ends = &event == &motion.events.back() && motion.status == MotionStatus::unresolved_contact && motion.end == 0;
    component.rests = !component.ends && std::ranges::all_of(event.participants, [&](const Participant& p) {
      const ArcKind kind = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())].kind();
      return scene.bodies[static_cast<std::size_t>(p.body)].immovable() || kind == ArcKind::rest || kind == ArcKind::ride;
    });
    component.why = component.rests  ? whyItRests(motion, event, bodies)
                    : component.ends ? motion.message
                                     : "no forces within the cones of friction hold all of them";
  }
  return found;
}

}  // namespace carom::cli
