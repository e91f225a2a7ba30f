// SPDX-License-Identifier: MIT
#include "editing/problem/jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/derivative/tangent.h"
#include "editing/detail/messages.hpp"

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
void checkUp(const ControlSet& controls, const ConstraintSet& constraints) {
  if (!controls.startScene().gravity.isZero(0)) return;
  for (const BoundControl& bound : controls.controls()) {
    if (bound.kind->owner != OwnerKind::scene) continue;
    for (const Row& row : constraints.rows())
      if (row.kind && row.kind->of_shape)
        throw InputError("/constraints/" + std::to_string(row.constraint) + "/" + row.kind->word,
                         "found a gravity of 0 that may vary, expected another one: up is against it");
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

Eigen::MatrixXd unknown(const EditProblem& problem) {
  return Eigen::MatrixXd::Constant(problem.constraints.size(), problem.controls.size(),
                                   std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

EditProblem::EditProblem(const Scene& scene, ContactSource& contact_source, double length,
                         const std::vector<Control>& varied, const std::vector<Constraint>& held,
                         const OwnFunctions& own)
    : contacts(&contact_source),
      controls(checkedScene(scene), varied),
      constraints(controls.startScene(), held, checkedDuration(length), own),
      validity(controls),
      change_weight(checkedChangeWeight(own.change_weight)),
      duration(checkedDuration(length)),
      horizon(constraints.horizon(duration)),
      asked(askedOf(controls, constraints)) {
  checkUp(controls, constraints);
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

Motion simulateScene(const EditProblem& problem, const Scene& scene, double until) {
  SimulateOptions options;
  options.step_limit = problem.step_limit;
  return simulate(scene, *problem.contacts, until, options);
}

Motion simulateAt(const EditProblem& problem, const Eigen::VectorXd& values, double until, const Simulating& how) {
  SimulateOptions options;
  options.asked = problem.asked;
  options.step_limit = std::min(problem.step_limit, how.step_limit);
  options.known = how.known;
  options.enough = problem.enough;
  options.least_duration = problem.least_duration;
  if (!how.even_if_stopped) options.stop = problem.stop;
  ContactSource& contacts = how.contacts ? *how.contacts : *problem.contacts;
  return simulate(problem.controls.sceneAt(values), contacts, until, options);
}

MotionAlong simulateAlong(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& like, double until,
                          ContactSource* contacts) {
  const Scene scene = problem.controls.sceneAt(values);
  const std::vector<BoundControl>& controls = problem.controls.controls();
  const bool resized =
      std::any_of(controls.begin(), controls.end(), [](const BoundControl& c) { return c.kind->changes_shape; });
  if (!resized) return simulateAlong(like, scene, like.geometry, until);
  ContactSource& source = contacts ? *contacts : *problem.contacts;
  source.begin(scene);
  return simulateAlong(like, scene, source.geometry(), until);
}

void askControls(const ControlSet& controls, Reliability& reliability) {
  for (const BoundControl& c : controls.controls()) {
    if (c.kind->is_friction) reliability.askFriction(static_cast<int>(c.owner.material));
    if (c.kind->is_velocity) reliability.askVelocity(c.owner.body);
    if (c.owner.body >= 0) reliability.askPlace(c.owner.body);
  }
}

void doubt(const std::string& why, Reliability& reliability) {
  if (why.empty()) return;
  reliability.smallest_margin = 0;
  if (!reliability.reliable) return;
  reliability.reliable = false;
  reliability.message = why;
}

Eigen::MatrixXd jacobianByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows, std::vector<Reliability>* reliability) {
  Eigen::MatrixXd J = unknown(problem);
  if (reliability) reliability->assign(static_cast<std::size_t>(J.rows()), {});
  DerivativeTape tape(motion);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    if (rows.seeds[i].empty()) continue;
    const SceneGradient gradient = adjoint(tape, rows.seeds[i], reliability ? &(*reliability)[i] : nullptr);
    J.row(i) = problem.controls.gather(gradient, values).transpose();
    if (reliability) askControls(problem.controls, (*reliability)[i]);
    if (reliability) doubt(rows.notes[i].doubt, (*reliability)[i]);
    if (!reliability || J.row(i).allFinite()) continue;
    (*reliability)[i].reliable = false;
    (*reliability)[i].message =
        "the derivative of " + problem.constraints.describeRow(static_cast<int>(i)) + " is beyond the range of doubles";
  }
  return J;
}

Eigen::MatrixXd jacobianByTangent(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows) {
  Eigen::MatrixXd J = unknown(problem);
  DerivativeTape tape(motion);
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    const SceneTangent direction = problem.controls.scatter(Eigen::VectorXd::Unit(J.cols(), j), values);
    const MotionTangent moved = tangent(tape, direction);
    for (Eigen::Index i = 0; i < J.rows(); ++i) {
      if (rows.seeds[i].empty()) continue;
      J(i, j) = 0;
      for (const StateSeed& seed : rows.seeds[i]) J(i, j) += moved.at(seed.body, seed.at).dot(seed);
    }
  }
  return J;
}

Eigen::MatrixXd jacobianByTimes(const EditProblem& problem, const Motion& motion, const RowValues& rows) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(problem.constraints.size(), problem.times());
  for (int k = 0; k < problem.times(); ++k) {
    for (int i = 0; i < problem.constraints.size(); ++i) {
      const Row& row = problem.constraints.rows()[i];
      if (row.constraint != problem.constraints.freeTimes()[k].constraint || row.overSpan()) continue;
      for (const StateSeed& seed : rows.seeds[i]) J(i, k) += timeDerivative(motion, seed);
    }
  }
  return J;
}

RowsAndJacobian evaluateByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values) {
  RowsAndJacobian out;
  out.motion = simulateAt(problem, values, problem.horizon);
  out.rows = problem.constraints.evaluate(out.motion);
  out.jacobian = jacobianByAdjoint(problem, values, out.motion, out.rows, &out.reliability);
  return out;
}

RowsAndJacobian evaluateByTangent(const EditProblem& problem, const Eigen::VectorXd& values) {
  RowsAndJacobian out;
  out.motion = simulateAt(problem, values, problem.horizon);
  out.rows = problem.constraints.evaluate(out.motion);
  out.jacobian = jacobianByTangent(problem, values, out.motion, out.rows);
  return out;
}

}  // namespace carom::editing_detail
