// SPDX-License-Identifier: MIT
#include "editing/strategy/missing_impacts.hpp"

#include <algorithm>
#include <string>

namespace carom::editing_detail {
namespace {

/// Of each body, whether a control has a part in its motion from the start on.
std::vector<char> movedAtOnce(const ControlSet& controls) {
  const std::vector<Body>& bodies = controls.startScene().bodies;
  std::vector<char> moved(bodies.size(), 0);
  for (const BoundControl& control : controls.controls()) {
    const ControlOwner& owner = control.owner;
    if (owner.body >= 0) {
      moved[static_cast<std::size_t>(owner.body)] = 1;
    } else if (owner.material >= 0) {
      const std::string& name = controls.startScene().materials[static_cast<std::size_t>(owner.material)].name;
      for (std::size_t b = 0; b < bodies.size(); ++b) moved[b] |= bodies[b].material == name;
    } else {
      moved.assign(bodies.size(), 1);
    }
  }
  return moved;
}

/// The same by a time, s: what they strike is moved too.
std::vector<char> movedBy(const ControlSet& controls, const Motion& motion, double time) {
  std::vector<char> moved = movedAtOnce(controls);
  const std::vector<Body>& bodies = controls.startScene().bodies;
  for (const Event& event : motion.events) {
    if (event.time > time) break;
    for (const Contact& contact : event.contacts) {
      const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
      const char either = moved[a] | moved[b];
      if (!bodies[a].immovable()) moved[a] |= either;
      if (!bodies[b].immovable()) moved[b] |= either;
    }
  }
  return moved;
}

/// Bodies of constraints with a row that is not met, in increasing order.
std::vector<int> unmetBodies(const ConstraintSet& constraints, const Scene& scene, const EditPoint& point) {
  std::vector<int> bodies;
  for (int i = 0; i < constraints.size(); ++i) {
    if (point.rows.scaled[i] == 0) continue;
    const int constraint = constraints.rows()[static_cast<std::size_t>(i)].constraint;
    if (constraint < 0) continue;  // of one's own
    const std::string& name = constraints.constraints()[static_cast<std::size_t>(constraint)].body;
    const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) { return b.name == name; });
    if (found != scene.bodies.end()) bodies.push_back(static_cast<int>(found - scene.bodies.begin()));
  }
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

}  // namespace

std::vector<LackingImpact> missingImpacts(const EditProblem& problem, const EditPoint& point) {
  if (!point.rows.available || !point.rows.lacking.empty()) return point.rows.lacking;
  const Scene& scene = problem.controls.startScene();
  const double until = problem.constraints.extentIn(point.motion, point.rows.times).time;
  const std::vector<char> moved = movedBy(problem.controls, point.motion, until);
  std::vector<LackingImpact> missing;
  for (const int body : unmetBodies(problem.constraints, scene, point)) {
    if (moved[static_cast<std::size_t>(body)] || scene.bodies[static_cast<std::size_t>(body)].immovable()) continue;
    LackingImpact impact;
    impact.to = until;
    for (std::size_t b = 0; b < moved.size(); ++b)
      if (moved[b]) impact.pairs.emplace_back(body, static_cast<int>(b));
    if (!impact.pairs.empty()) missing.push_back(std::move(impact));
  }
  return missing;
}

}  // namespace carom::editing_detail
