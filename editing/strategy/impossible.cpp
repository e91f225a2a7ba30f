// SPDX-License-Identifier: MIT
#include "editing/strategy/impossible.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "editing/detail/messages.hpp"
#include "editing/strategy/energy_bounds.hpp"
#include "editing/strategy/kept_coordinates.hpp"
#include "editing/strategy/nail_in_solid.hpp"
#include "editing/strategy/past_walls.hpp"
#include "editing/strategy/proven_bounds.hpp"
#include "editing/strategy/rest_balance.hpp"

namespace carom::editing_detail {
namespace {

bool nothingVaries(const EditEvaluator& evaluator) {
  return evaluator.lower().size() == 0 || (evaluator.lower().array() == evaluator.upper().array()).all();
}

bool sameMoment(const Constraint& a, const Constraint& b) {
  if (a.body != b.body || a.relative_to != b.relative_to || a.hits || b.hits) return false;
  return !a.at.span && !b.at.span && a.at.time == b.at.time && a.at.impact == b.at.impact &&
         a.at.with == b.at.with && a.at.rest == b.at.rest;
}

/// Whether two rows read the same number of every motion.
bool readTheSame(const ConstraintSet& set, const Row& a, const Row& b) {
  if (!a.kind || a.kind != b.kind || a.kind->read || a.kind->from_target || a.component != b.component) return false;
  if (a.target_index < 0 || b.target_index < 0) return false;
  const Constraint& of_a = set.constraints()[static_cast<std::size_t>(a.constraint)];
  const Constraint& of_b = set.constraints()[static_cast<std::size_t>(b.constraint)];
  const Target& target_a = of_a.targets[static_cast<std::size_t>(a.target_index)];
  const Target& target_b = of_b.targets[static_cast<std::size_t>(b.target_index)];
  return sameMoment(of_a, of_b) && target_a.body_point == target_b.body_point;
}

std::string withWanted(const ConstraintSet& set, int row) {
  const Row& r = set.rows()[static_cast<std::size_t>(row)];
  const std::string name = set.describeRow(row);
  if (!r.isRange()) return name + " = " + number(r.target) + unitOf(r);
  return name + " in [" + number(r.lower) + ", " + number(r.upper) + "]" + unitOf(r);
}

std::string twoValues(const EditEvaluator& evaluator) {
  const ConstraintSet& set = evaluator.problem().constraints;
  for (int i = 0; i < set.size(); ++i)
    for (int j = i + 1; j < set.size(); ++j) {
      const Row &a = set.rows()[static_cast<std::size_t>(i)], &b = set.rows()[static_cast<std::size_t>(j)];
      const double between = std::max(a.lower, b.lower) - std::min(a.upper, b.upper);
      if (readTheSame(set, a, b) && between > 2 * evaluator.options().tolerance * a.scale)
        return sentence(withWanted(set, i) + " cannot be met together with " + withWanted(set, j) + ": they constrain the same quantity");
    }
  return "";
}

/// The time of the first impact in which something that varies acts; infinite where there is none. Null where
/// something acts from the start.
std::optional<double> firstEffect(const EditProblem& problem, const Motion& motion) {
  std::vector<bool> concerned(motion.world_lines.size(), false);
  for (const BoundControl& control : problem.controls.controls()) {
    if (control.kind->owner == OwnerKind::impact) {
      concerned[static_cast<std::size_t>(control.owner.body)] = true;
      continue;
    }
    if (control.kind->owner != OwnerKind::material) return std::nullopt;
    const Scene& scene = problem.controls.startScene();
    const std::string& name = scene.materials[static_cast<std::size_t>(control.owner.material)].name;
    for (std::size_t b = 0; b < concerned.size(); ++b)
      if (motion.scene->bodies[b].material == name) concerned[b] = true;
  }
  for (const Event& event : motion.events)
    for (const Contact& c : event.contacts)
      if (concerned[static_cast<std::size_t>(c.a)] || concerned[static_cast<std::size_t>(c.b)]) return event.time;
  return motion.status == MotionStatus::complete ? motion.end : std::nextafter(motion.end, 0);
}

std::string readTooEarly(const EditEvaluator& evaluator, const EditPoint& start) {
  const EditProblem& problem = evaluator.problem();
  const std::optional<double> first = firstEffect(problem, start.motion);
  if (!first || !start.rows.available) return "";
  for (int i = 0; i < problem.constraints.size(); ++i) {
    const Row& row = problem.constraints.rows()[static_cast<std::size_t>(i)];
    const bool is_met = std::abs(start.rows.scaled[i]) <= evaluator.options().tolerance;
    if (row.constraint < 0 || row.region >= 0 || is_met) continue;
    const When& at = problem.constraints.constraints()[static_cast<std::size_t>(row.constraint)].at;
    if (!at.isTime() || !(at.time <= *first)) continue;
    return "In this impact sequence no control can influence " + problem.constraints.describeRow(i) + " (off by " +
           brief(start.rows.residuals[i]) + unitOf(row) +
           "), nor in any other: the controls act in impacts only, and none happens before.";
  }
  return "";
}

}  // namespace

Impossible whyImpossible(const EditEvaluator& evaluator, const EditPoint& start) {
  if (nothingVaries(evaluator)) return {"Nothing varies."};
  const EditProblem& problem = evaluator.problem();
  const double tolerance = evaluator.options().tolerance;
  if (const std::string why = twoValues(evaluator); !why.empty()) return {why};
  for (const std::string& why : {whyTheyNeverMeet(problem), whyItCannotRest(problem, tolerance), whyItStaysAway(problem, tolerance)})
    if (!why.empty()) return {why, true};
  if (start.motion.overlaps.empty())  // bodies that overlap at the start may fall through what would hold them
    for (const std::string& why :
         {whyItIsTooHigh(problem, tolerance), whyItIsTooFast(problem, tolerance), whyItIsTooFar(problem, tolerance),
          whyItStaysBefore(problem, tolerance), whyItCannotBalance(problem, tolerance)})
      if (!why.empty()) return {why, true};
  if (start.motion.overlaps.empty()) {
    const std::vector<WhyNot::Inside> inside = nailsInSolids(problem, problem.controls.startScene());
    if (!inside.empty()) return {sentence(describeInside(inside[0])), true, inside};
  }
  return {readTooEarly(evaluator, start)};
}

}  // namespace carom::editing_detail
