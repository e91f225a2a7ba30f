// SPDX-License-Identifier: MIT
#include "cli/components.h"

#include <algorithm>
#include <string>

#include "adjoint/contact/contact_path.hpp"
#include "adjoint/simulate/simulate.h"

namespace carom::cli {
namespace {

using Component = formats_detail::ScenePlan::Component;

// Of a motion of this length, s, what it begins with alone is asked.
constexpr double kAtOnce = 1e-9;

std::string whyItRests(const Motion& motion, const Event& event) {
  bool opposed = true;
  for (const Participant& p : event.participants) {
    const Arc& arc = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())];
    opposed = opposed && arc.closedForm() && !arc.closedForm()->loose;
  }
  const auto contacts = std::ranges::count_if(event.contacts, &Contact::lasts);
  return "forces within the cones of friction at " + std::to_string(contacts) + " contacts hold all of them" +
                  (opposed ? "" : "; some motion of them is not opposed");
}

}  // namespace

std::vector<Component> componentsAtStart(const Scene& scene, OdeContacts& contacts) {
  std::vector<Component> found;
  SimulateOptions options;
  options.impact_limit = scene.bodies.size();
  const Motion motion = simulate(scene, contacts, kAtOnce, options);
  for (const Event& event : motion.events) {
    if (event.kind != EventKind::placed || event.participants.size() < 2) continue;
    Component& component = found.emplace_back();
    for (const Participant& p : event.participants) component.bodies.push_back(p.body);
    component.rests = !(&event == &motion.events.back() && motion.status == MotionStatus::unresolved_contact && motion.end == 0);
    component.why = component.rests ? whyItRests(motion, event) : motion.message;
  }
  return found;
}

}  // namespace carom::cli
