// SPDX-License-Identifier: MIT
#include "cli/components.h"

#include <algorithm>
#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/simulate/simulate.h"

namespace carom::cli {
namespace {

using Component = formats_detail::ScenePlan::Component;

// Of a motion of this length, s, what it begins with alone is asked.
constexpr double kAtOnce = 1e-9;

Component componentOf(const Motion& motion, const Event& event) {
  Component component;
  bool opposed = true;
  for (const Participant& p : event.participants) {
    component.bodies.push_back(p.body);
    const Arc& arc = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())];
    opposed = opposed && arc.closedForm() && !arc.closedForm()->loose;
  }
  const auto contacts = std::ranges::count_if(event.contacts, &Contact::lasts);
  component.why = "forces within the cones of friction at " + std::to_string(contacts) + " contacts hold all of them" +
                  (opposed ? "" : "; some motion of them is not opposed");
  return component;
}

}  // namespace

std::vector<Component> componentsAtStart(const Scene& scene, OdeContacts& contacts) {
  std::vector<Component> found;
  SimulateOptions options;
  options.impact_limit = scene.bodies.size();
  const Motion motion = simulate(scene, contacts, kAtOnce, options);
  for (const Event& event : motion.events) {
    if (event.kind != EventKind::placed || event.participants.size() < 2) continue;
    if (&event == &motion.events.back() && motion.status == MotionStatus::unresolved_contact && motion.end == 0) {
      Component ends;
      for (const Participant& p : event.participants) ends.bodies.push_back(p.body);
      ends.rests = false;
      ends.why = motion.message;
      found.push_back(std::move(ends));
      continue;
    }
    found.push_back(componentOf(motion, event));
  }
  return found;
}

}  // namespace carom::cli
