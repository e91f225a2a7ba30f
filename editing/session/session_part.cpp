// SPDX-License-Identifier: MIT
#include "editing/session/session_part.hpp"

#include <algorithm>

namespace carom::editing_detail {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

bool sameUnknown(const Variable& a, const Variable& b) {
  return a.slot == b.slot && a.start == b.start && a.lower == b.lower && a.upper == b.upper && a.scale == b.scale &&
         a.logarithmic == b.logarithmic;
}

}  // namespace

std::vector<bool> bodiesThatCount(const EditProblem& problem, const EditPoint& point) {
  const Scene& scene = *point.motion.scene;
  std::vector<bool> counts(scene.bodies.size(), false);
  const auto add = [&](const std::string& name) {
    if (!name.empty()) counts[at(bodyIndex(scene, name))] = true;
  };
  for (const Constraint& c : problem.constraints.constraints()) {
    add(c.body), add(c.relative_to), add(c.at.with);
  }
  // what was changed has to be drawn back
  for (Eigen::Index j = 0; j < problem.controls.size(); ++j)
    if (point.changes[j] != 0) {
      const Variable& variable = problem.controls.variables()[static_cast<std::size_t>(j)];
      add(problem.controls.controls()[at(variable.control)].control.body);
    }
  for (std::size_t e = problem.constraints.extentIn(point.motion, point.rows.times).events; e-- > 0;) {
    const std::vector<Participant>& met = point.motion.events[e].participants;
    if (std::any_of(met.begin(), met.end(), [&](const Participant& p) { return counts[at(p.body)]; }))
      for (const Participant& p : met) counts[at(p.body)] = true;
  }
  for (std::size_t b = 0; b < counts.size(); ++b) counts[b] = counts[b] && !scene.bodies[b].fixed;
  return counts;
}

ScenePart scenePart(const EditProblem& problem, const std::vector<bool>& moving) {
  const Scene& whole = problem.controls.writtenScene();
  ScenePart part{.scene = whole, .controls = {}, .bodies = moving};
  part.scene.bodies.clear();
  part.scene.tilts.clear();
  for (std::size_t b = 0; b < whole.bodies.size(); ++b) {
    const bool fixed = whole.bodies[b].fixed;
    part.all_moving += !fixed, part.moving += moving[b];
    part.bodies[b] = fixed || moving[b];
    if (part.bodies[b]) part.scene.bodies.push_back(whole.bodies[b]);
  }
  const auto has = [&](const std::string& body) { return body.empty() || part.bodies[at(bodyIndex(whole, body))]; };
  for (const Tilt& tilt : whole.tilts)
    if (has(tilt.body)) part.scene.tilts.push_back(tilt);
  for (const BoundControl& bound : problem.controls.controls())
    if (has(bound.control.body)) part.controls.push_back(bound.control);
  return part;
}

bool matchUnknowns(const EditProblem& whole, const EditProblem& problem, ScenePart& part) {
  const Scene& scene = whole.controls.writtenScene();
  part.unknowns.clear();
  const std::vector<Variable>& own = problem.controls.variables();
  for (Eigen::Index j = 0; j < whole.controls.size(); ++j) {
    const Variable& variable = whole.controls.variables()[static_cast<std::size_t>(j)];
    const std::string& body = whole.controls.controls()[at(variable.control)].control.body;
    if (!body.empty() && !part.bodies[at(bodyIndex(scene, body))]) continue;
    if (part.unknowns.size() >= own.size() || !sameUnknown(own[part.unknowns.size()], variable)) return false;
    part.unknowns.push_back(j);
  }
  if (part.unknowns.size() != own.size() || problem.times() != whole.times()) return false;
  for (int k = 0; k < whole.times(); ++k) {
    if (problem.constraints.freeTimes()[at(k)].scale != whole.constraints.freeTimes()[at(k)].scale) return false;
    part.unknowns.push_back(whole.controls.size() + k);
  }
  return true;
}

Eigen::VectorXd ScenePart::restrict(const Eigen::VectorXd& whole) const { return whole(unknowns); }

void ScenePart::extend(const Eigen::VectorXd& part, Eigen::VectorXd& whole) const { whole(unknowns) = part; }

}  // namespace carom::editing_detail
