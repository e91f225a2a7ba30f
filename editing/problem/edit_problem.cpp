// SPDX-License-Identifier: MIT
#include "editing/problem/edit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/detail/thrown_by_user.hpp"
#include "editing/edit_options.h"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

double checkedDuration(double duration) {
  if (!(duration > 0) || !std::isfinite(duration)) {
    throw InputError("/duration", "found " + number(duration) + ", expected a time greater than 0 s");
  }
  return duration;
}

double checkedChangeWeight(double weight) {
  if (!(weight >= 0 && std::isfinite(weight)))
    throw InputError("minimise", "found the weight " + number(weight) + " of the change, expected a number >= 0");
  return weight;
}

const Scene& checkedScene(const Scene& scene) {
  validate(scene);
  return scene;
}

// Without gravity up is z; which way it would turn is not defined.
void checkUp(const ControlSet& controls, const ConstraintSet& constraints, const ConstraintSet& soft) {
  if (!controls.startScene().gravity.isZero(0)) return;
  for (const BoundControl& bound : controls.controls()) {
    if (bound.kind->owner != OwnerKind::scene) continue;
    for (const ConstraintSet* set : {&constraints, &soft})
      for (const Row& row : set->rows())
        if (row.kind && row.kind->of_shape)
          throw InputError("/constraints/" + std::to_string(row.constraint) + "/" + row.kind->word,
                           "found a varying gravity of 0, expected another one: it defines the direction up");
  }
}

std::vector<Asked> askedOf(const ControlSet& controls, const ConstraintSet& constraints) {
  const std::vector<bool> orientation = constraints.asksOrientation();
  std::vector<Asked> asked(orientation.size());
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i] = {orientation[i], false};
  for (const BoundControl& bound : controls.controls()) {
    if (bound.kind->asks_inertia) asked[static_cast<std::size_t>(bound.owner.body)].inertia = true;
  }
  return asked;
}

}  // namespace

EditProblem::EditProblem(const Scene& scene, ContactSource& contact_source, double length,
                         const std::vector<Control>& varied, const std::vector<Constraint>& held,
                         const OwnFunctions& own)
    : contacts(&contact_source),
      controls(checkedScene(scene), varied),
      soft(controls.startScene(), held, checkedDuration(length)),
      constraints(controls.startScene(), held, checkedDuration(length),
                  soft.beside(controls.startScene(), own, checkedDuration(length))),
      validity(controls),
      own_objective(own.objective.has_value()),
      change_weight(!soft.empty() && !own.objective ? 1 : checkedChangeWeight(own.change_weight)),
      duration(checkedDuration(length)),
      horizon(constraints.horizon(duration)),
      asked(askedOf(controls, constraints)) {
  checkUp(controls, constraints, soft.set());
}

Eigen::VectorXd EditProblem::valuesOf(const Eigen::VectorXd& unknowns) const {
  return controls.valuesOf(unknowns.head(controls.size()));
}

Eigen::VectorXd EditProblem::timesOf(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd t(times());
  for (int k = 0; k < times(); ++k) {
    const FreeTime& free = constraints.freeTimes()[k];
    t[k] = std::clamp(free.from + free.scale * unknowns[controls.size() + k], free.from, free.to);
  }
  return t;
}

Eigen::VectorXd EditProblem::unknownTimes(const Eigen::VectorXd& t) const {
  Eigen::VectorXd y(times());
  for (int k = 0; k < times(); ++k) {
    const FreeTime& free = constraints.freeTimes()[k];
    y[k] = (t[k] - free.from) / free.scale;
  }
  return y;
}

Eigen::VectorXd EditProblem::byChanges(const SceneGradient& gradient, const Eigen::VectorXd& unknowns) const {
  leaveIfAbandoned();
  const Eigen::VectorXd changes = unknowns.head(controls.size());
  return controls.gather(gradient, controls.valuesOf(changes)).cwiseProduct(controls.valueRates(changes));
}

Eigen::VectorXd EditProblem::rates(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd d(this->unknowns());
  d.head(controls.size()) = controls.valueRates(unknowns.head(controls.size()));
  for (int k = 0; k < times(); ++k) d[controls.size() + k] = constraints.freeTimes()[k].scale;
  return d;
}

Eigen::VectorXd EditProblem::lower() const {
  Eigen::VectorXd bounds(unknowns());
  bounds << controls.lowerChanges(), Eigen::VectorXd::Zero(times());
  return bounds;
}

Eigen::VectorXd EditProblem::upper() const {
  Eigen::VectorXd ends(times());
  for (int k = 0; k < times(); ++k) ends[k] = constraints.freeTimes()[k].to;
  Eigen::VectorXd bounds(unknowns());
  bounds << controls.upperChanges(), unknownTimes(ends);
  return bounds;
}

double EditProblem::change(const Eigen::VectorXd& unknowns) const {
  return 0.5 * unknowns.head(controls.size()).squaredNorm();
}

double EditProblem::objective(const Eigen::VectorXd& unknowns, const RowValues& rows) const {
  const BoundFunction* own = constraints.objective();
  if (!own) return change(unknowns);
  if (!rows.objective) return std::numeric_limits<double>::quiet_NaN();
  return rows.objective->value / own->function.scale + (change_weight > 0 ? change_weight * change(unknowns) : 0);
}

void EditProblem::leaveIfAbandoned() const {
  if (abandon.stop_requested()) throw ThrownByUser{std::make_exception_ptr(EditAbandoned())};
}

std::function<void()> EditProblem::leaver() const {
  if (!abandon.stop_possible()) return {};
  return [this] { leaveIfAbandoned(); };
}

void endWhereNothingCounts(EditProblem& problem) {
  if (problem.constraints.waits())
    problem.stop_when = [&](const Motion& motion) { return problem.constraints.hasWhatItWaitsFor(motion); };
  problem.least_duration = problem.constraints.leastDuration();
}

Motion simulateScene(const EditProblem& problem, const Scene& scene, double until) {
  SimulateOptions options;
  options.step_limit = problem.step_limit;
  options.stop = problem.abandon;
  Motion motion = simulate(scene, *problem.contacts, until, options);
  problem.leaveIfAbandoned();
  return motion;
}

Motion simulateAt(const EditProblem& problem, const Eigen::VectorXd& values, double until, const Simulating& how) {
  SimulateOptions options;
  options.asked = problem.asked;
  options.step_limit = std::min(problem.step_limit, how.step_limit);
  options.baseline = how.baseline;
  options.stop_when = problem.stop_when;
  options.least_duration = problem.least_duration;
  options.progress = how.progress;
  options.stop = how.even_if_stopped ? problem.abandon : how.stop.stop_possible() ? how.stop : problem.stop;
  ContactSource& contacts = how.contacts ? *how.contacts : *problem.contacts;
  problem.leaveIfAbandoned();
  Motion motion = simulate(problem.controls.sceneAt(values), contacts, until, options);
  problem.leaveIfAbandoned();
  return motion;
}

MotionAlong simulateAlong(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& like, double until,
                          ContactSource* contacts) {
  problem.leaveIfAbandoned();
  const Scene scene = problem.controls.sceneAt(values);
  const std::vector<BoundControl>& controls = problem.controls.controls();
  const bool resized =
      std::any_of(controls.begin(), controls.end(), [](const BoundControl& c) { return c.kind->changes_shape; });
  if (!resized) return simulateAlong(like, scene, like.geometry, until);
  ContactSource& source = contacts ? *contacts : *problem.contacts;
  source.begin(scene);
  return simulateAlong(like, scene, source.geometry(), until);
}

}  // namespace carom::editing_detail
