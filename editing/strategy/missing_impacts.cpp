// SPDX-License-Identifier: MIT
#include "editing/strategy/missing_impacts.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace carom::editing_detail {
namespace {

/// What the controls have a part in: bodies from the start on, and those whose impacts they have a part in.
struct Influence {
  std::vector<char> moved, at_impacts;

  explicit Influence(const ControlSet& controls) {
    const Scene& scene = controls.startScene();
    moved.assign(scene.bodies.size(), 0);
    at_impacts = moved;
    for (const BoundControl& control : controls.controls()) {
      const ControlOwner& owner = control.owner;
      if (owner.body >= 0) {
        moved[static_cast<std::size_t>(owner.body)] = 1;
      } else if (owner.material >= 0) {
        const std::string& name = scene.materials[static_cast<std::size_t>(owner.material)].name;
        for (std::size_t b = 0; b < moved.size(); ++b) at_impacts[b] |= scene.bodies[b].material == name;
      } else {
        moved.assign(moved.size(), 1);
      }
    }
  }

  /// After an event what they have a part in has a part in what it struck.
  void follow(const Event& event, const std::vector<Body>& bodies) {
    for (const Contact& contact : event.contacts) {
      const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
      const bool struck = event.kind == EventKind::impact && contact.counted;
      if (!(moved[a] || moved[b] || (struck && (at_impacts[a] || at_impacts[b])))) continue;
      for (const std::size_t body : {a, b}) moved[body] |= !bodies[body].immovable();
    }
  }
};

/// In increasing order, each once.
std::vector<int> sorted(std::vector<int> bodies) {
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

/// Bodies of constraints with a row that is not met, in increasing order.
std::vector<int> unmetBodies(const ConstraintSet& constraints, const Scene& scene, const EditPoint& point) {
  std::vector<int> bodies;
  for (int i = 0; i < constraints.size(); ++i) {
    if (point.rows.scaled[i] == 0) continue;
    const int constraint = constraints.rows()[static_cast<std::size_t>(i)].constraint;
    if (constraint < 0) continue;  // of one's own
    const std::string& name = constraints.constraints()[static_cast<std::size_t>(constraint)].body;
    const auto found =
        std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) { return b.name == name; });
    if (found != scene.bodies.end()) bodies.push_back(static_cast<int>(found - scene.bodies.begin()));
  }
  return sorted(std::move(bodies));
}

/// What the controls have a part in up to a time.
std::vector<char> movedUntil(const EditProblem& problem, const Motion& motion, double until) {
  Influence influence(problem.controls);
  for (const Event& event : motion.events)
    if (event.time <= until) influence.follow(event, problem.controls.startScene().bodies);
  return influence.moved;
}

/// Of one of these bodies with one that the controls have a part in.
LackingImpact withMoved(const std::vector<int>& bodies, const std::vector<char>& moved, double until) {
  LackingImpact impact;
  impact.to = until;
  for (const int body : bodies)
    for (std::size_t b = 0; b < moved.size(); ++b)
      if (moved[b]) impact.pairs.emplace_back(body, static_cast<int>(b));
  return impact;
}

/// Before an impact of bodies that the controls have no part in, one of them has to be struck by one that they have a
/// part in.
std::vector<LackingImpact> withWhatComesBefore(const EditProblem& problem, const EditPoint& point) {
  const std::vector<Body>& bodies = problem.controls.startScene().bodies;
  std::vector<LackingImpact> missing;
  for (const LackingImpact& lacking : point.rows.lacking) {
    const std::vector<char> moved = movedUntil(problem, point.motion, lacking.to);
    const auto isMoved = [&](int body) { return moved[static_cast<std::size_t>(body)] != 0; };
    std::vector<int> still;
    for (const auto& [a, b] : lacking.pairs)
      for (const int body : {a, b})
        if (!bodies[static_cast<std::size_t>(body)].immovable()) still.push_back(body);
    still = sorted(std::move(still));
    if (std::none_of(still.begin(), still.end(), isMoved)) {
      LackingImpact before = withMoved(still, moved, lacking.to);
      if (!before.pairs.empty()) missing.push_back(std::move(before));
    }
    missing.push_back(lacking);
  }
  return missing;
}

}  // namespace

std::vector<LackingImpact> missingImpacts(const EditProblem& problem, const EditPoint& point) {
  if (!point.rows.available || !point.rows.lacking.empty()) return withWhatComesBefore(problem, point);
  const Scene& scene = problem.controls.startScene();
  const double until = problem.constraints.extentIn(point.motion, point.rows.times).time;
  const std::vector<char> moved = movedUntil(problem, point.motion, until);
  std::vector<LackingImpact> missing;
  for (const int body : unmetBodies(problem.constraints, scene, point)) {
    if (moved[static_cast<std::size_t>(body)] || scene.bodies[static_cast<std::size_t>(body)].immovable()) continue;
    LackingImpact impact = withMoved({body}, moved, until);
    if (!impact.pairs.empty()) missing.push_back(std::move(impact));
  }
  return missing;
}

}  // namespace carom::editing_detail
