// SPDX-License-Identifier: MIT
#include "editing/report/extended_controls.hpp"

#include <algorithm>
#include <optional>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"

namespace carom::editing_detail {
namespace {

/// Component names of a kind of one owner that the edit varies.
std::vector<std::string> varied(const ControlSet& controls, const Control& like) {
  std::vector<std::string> names;
  for (const Variable& v : controls.variables()) {
    if (varyTheSame(controls.controls()[static_cast<std::size_t>(v.control)].control, like))
      names.push_back(v.component);
  }
  return names;
}

/// The controls of one kind for all owners, as a person would write them.
std::vector<Control> controlsOfKind(const ControlKind& kind, const Scene& scene, const Motion& motion,
                                    std::size_t events) {
  std::vector<Control> controls;
  Control control;
  control.vary = kind.word;
  if (kind.owner == OwnerKind::scene) controls.push_back(control);
  if (kind.owner == OwnerKind::material) {
    for (const Material& material : scene.materials)
      controls.push_back(control), controls.back().material = material.name;
  }
  const bool any = kind.owner == OwnerKind::body, moving = kind.owner == OwnerKind::moving_body;
  if (any || moving || kind.owner == OwnerKind::free_body) {
    for (const Body& body : scene.bodies)
      if (any || (moving ? !body.fixed : !body.immovable()))
        controls.push_back(control), controls.back().body = body.name;
  }
  if (kind.owner == OwnerKind::immovable_body) {
    for (const Body& body : scene.bodies)
      if (body.surfaceMoves()) controls.push_back(control), controls.back().body = body.name;
  }
  if (kind.owner == OwnerKind::impact) {
    for (std::size_t e = 0; e < events; ++e)
      for (const Participant& p : motion.events[e].participants) {
        if (p.impact > kTiltedImpacts) continue;
        controls.push_back(control);
        controls.back().body = scene.bodies[static_cast<std::size_t>(p.body)].name;
        controls.back().impact = p.impact;
      }
  }
  return controls;
}

/// With the components that do not vary yet, where it can be bound at all.
std::optional<Control> locked(const EditProblem& problem, const Scene& scene, Control control) {
  try {
    const ControlSet whole(scene, {control});
    const std::vector<std::string> taken = varied(problem.controls, control);
    if (whole.size() == 0) return std::nullopt;
    if (taken.empty()) return control;
    for (const Variable& v : whole.variables())
      if (std::find(taken.begin(), taken.end(), v.component) == taken.end()) control.components.push_back(v.component);
    return control.components.empty() ? std::nullopt : std::optional(control);
  } catch (const InputError&) {
    return std::nullopt;  // such as the moments of a body that has none
  }
}

std::string nameOf(const Control& control) {
  std::string text = describe(control), components;
  if (control.components.empty()) return text;
  for (const std::string& component : control.components) components += (components.empty() ? "." : ",") + component;
  return text.insert(control.vary.size(), components);
}

}  // namespace

bool varyTheSame(const Control& a, const Control& b) {
  const bool one_owner = a.body == b.body && a.material == b.material;
  return a.vary == b.vary && one_owner && (a.impact == b.impact || findControlKind(a.vary)->owner != OwnerKind::impact);
}

std::vector<Candidate> candidatesFor(const EditProblem& problem, const EditPoint& point) {
  const Scene scene = problem.controls.sceneAt(point.values);
  const double until = point.motion.duration;
  const Eigen::VectorXd times = problem.timesOf(point.changes);
  const Motion plain = simulateScene(problem, scene, until);
  const std::size_t events = problem.constraints.extentIn(plain, times).events;
  const std::vector<Row>& rows = problem.constraints.rows();
  std::vector<Candidate> candidates;
  for (const ControlKind* kind : controlKinds()) {
    std::vector<Control> controls;
    for (const Control& control : controlsOfKind(*kind, scene, plain, events))
      if (const auto free = locked(problem, scene, control)) controls.push_back(*free);
    if (controls.empty()) continue;
    const ControlSet set(scene, controls);
    // Kinds that only read what is written share one motion.
    const bool rewrites = kind->prepare || kind->owner == OwnerKind::impact;
    const Motion own = rewrites ? simulateScene(problem, set.startScene(), until) : Motion();
    const Motion& motion = rewrites ? own : plain;
    const RowValues read = problem.constraints.evaluate(motion, times);
    if (!read.available) continue;
    DerivativeTape tape(motion, problem.leaver());
    Eigen::MatrixXd J(problem.constraints.size(), set.size());
    const Eigen::VectorXd values = set.startValues(), rates = set.valueRates(Eigen::VectorXd::Zero(set.size()));
    for (Eigen::Index i = 0; i < J.rows(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      J.row(i) = set.gather(adjoint(tape, read.seeds[k]), values).cwiseProduct(rates).transpose() / rows[k].scale;
    }
    const Eigen::VectorXd lower = set.lowerChanges(), upper = set.upperChanges();
    for (int first = 0, last = 0; first < set.size(); first = last) {
      const int owner = set.variables()[static_cast<std::size_t>(first)].control;
      while (last < set.size() && set.variables()[static_cast<std::size_t>(last)].control == owner) ++last;
      const Control& control = controls[static_cast<std::size_t>(owner)];
      candidates.push_back({control, nameOf(control), J.middleCols(first, last - first),
                            lower.segment(first, last - first), upper.segment(first, last - first)});
    }
  }
  return candidates;
}

}  // namespace carom::editing_detail
