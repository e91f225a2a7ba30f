// SPDX-License-Identifier: MIT
#include "editing/shooting/cut.h"

#include <algorithm>
#include <limits>

#include "editing/controls/natural_scales.h"

namespace carom {
namespace {

/// Shorter flights are not cut, in units of the natural time of the body.
constexpr double kShortestFlight = 0.02;

struct Relevance {
  std::vector<int> events;                // that matter, in increasing order
  std::vector<std::vector<bool>> bodies;  // [k]: that matter just before events[k]; one more: after all of them
};

std::vector<bool> constrainedBodies(const EditProblem& problem) {
  const Scene& scene = problem.controls.startScene();
  std::vector<bool> matters(scene.bodies.size(), false);
  const auto add = [&](const std::string& name) {
    if (name.empty()) return;
    const auto body = static_cast<std::size_t>(bodyIndex(scene, name));
    if (!scene.bodies[body].fixed) matters[body] = true;
  };
  for (const Constraint& constraint : problem.constraints.constraints())
    add(constraint.body), add(constraint.relative_to), add(constraint.at.with);
  return matters;
}

bool involves(const Event& event, const std::vector<bool>& bodies) {
  return std::any_of(event.participants.begin(), event.participants.end(),
                     [&](const Participant& p) { return bodies[static_cast<std::size_t>(p.body)]; });
}

Relevance relevanceIn(const EditProblem& problem, const Motion& motion, const Eigen::VectorXd& free_times) {
  Relevance relevance;
  std::vector<bool> matters = constrainedBodies(problem);
  relevance.bodies.push_back(matters);
  for (std::size_t e = problem.constraints.extentIn(motion, free_times).events; e-- > 0;) {
    if (!involves(motion.events[e], matters)) continue;
    for (const Participant& p : motion.events[e].participants) matters[static_cast<std::size_t>(p.body)] = true;
    relevance.events.push_back(static_cast<int>(e));
    relevance.bodies.push_back(matters);
  }
  std::reverse(relevance.events.begin(), relevance.events.end());
  std::reverse(relevance.bodies.begin(), relevance.bodies.end());
  return relevance;
}

std::vector<int> indicesOf(const std::vector<bool>& flags) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (flags[i]) indices.push_back(static_cast<int>(i));
  return indices;
}

int firstOf(const Event& event, const std::vector<bool>& bodies) {
  for (const Participant& p : event.participants)
    if (bodies[static_cast<std::size_t>(p.body)]) return p.body;
  return -1;
}

/// Times at which constraints are read, but for those at impacts.
std::vector<double> readingTimes(const EditProblem& problem, const Eigen::VectorXd& free_times) {
  std::vector<double> times(free_times.begin(), free_times.end());
  for (const Constraint& constraint : problem.constraints.constraints())
    if (!constraint.targets.empty() && constraint.at.impact == 0 && !constraint.at.span)
      times.push_back(constraint.at.time);
  return times;
}

}  // namespace

int impactsThatMatter(const EditProblem& problem, const Motion& motion, const Eigen::VectorXd& free_times) {
  return static_cast<int>(relevanceIn(problem, motion, free_times).events.size());
}

Cut cutMotion(const EditProblem& problem, const Motion& motion, const Eigen::VectorXd& free_times,
              int impacts_per_segment) {
  const Relevance relevance = relevanceIn(problem, motion, free_times);
  const std::vector<double> readings = readingTimes(problem, free_times);
  Cut cut;
  cut.bodies = indicesOf(relevance.bodies.front());
  int since = 0;
  for (std::size_t k = 0; k + 1 < relevance.events.size(); ++k) {
    const Event &before = motion.events[static_cast<std::size_t>(relevance.events[k])],
                &after = motion.events[static_cast<std::size_t>(relevance.events[k + 1])];
    if (++since < impacts_per_segment) continue;
    const std::vector<bool>& bodies = relevance.bodies[k + 1];
    Node node{0.5 * (before.time + after.time), relevance.events[k],    relevance.events[k + 1],
              firstOf(before, bodies),          firstOf(after, bodies), indicesOf(bodies)};
    const double natural = naturalScales(problem.controls.startScene(), node.body_after).time;
    const bool too_short = after.time - before.time < kShortestFlight * natural;
    const bool is_read =
        std::any_of(readings.begin(), readings.end(), [&](double t) { return t >= before.time && t <= after.time; });
    if (too_short || is_read) continue;
    cut.nodes.push_back(std::move(node));
    since = 0;
  }
  return cut;
}

}  // namespace carom
