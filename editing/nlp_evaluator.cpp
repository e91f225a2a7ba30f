// SPDX-License-Identifier: MIT
#include "editing/nlp_evaluator.h"

#include <algorithm>
#include <mutex>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "editing/detail/messages.hpp"
#include "editing/detail/parallel.hpp"
#include "editing/detail/thrown_by_user.hpp"
#include "editing/problem/hessian.hpp"
#include "editing/problem/jacobian.hpp"

namespace carom {
using namespace adjoint_detail;
using namespace editing_detail;

namespace editing_detail {

/// The program itself: what it varies and reads, and contact sources for whoever simulates.
struct NlpState {
  NlpState(const EditProblem& of, std::size_t step_limit)
      : own_source(of.contacts->another()), problem(of), pool(own_source ? *own_source : *of.contacts) {
    problem.contacts = own_source ? own_source.get() : of.contacts;
    problem.step_limit = step_limit;
    endWhereNothingCounts(problem);
  }

  Motion simulate(const Eigen::VectorXd& values, Simulating how = {}) {
    std::unique_lock<std::mutex> lock(alone, std::defer_lock);
    if (!own_source) lock.lock();  // there is no second one
    const ContactPool::Loan loan(pool);
    how.contacts = &loan.source();
    return simulateAt(problem, values, problem.horizon, how);
  }

  std::unique_ptr<ContactSource> own_source;  // null: the caller's
  EditProblem problem;
  ContactPool pool;
  std::mutex alone;
  std::vector<NlpVariable> variables;
  std::vector<NlpRow> rows;
};

/// A point, evaluated.
struct NlpReading {
  std::shared_ptr<NlpState> state;
  Eigen::VectorXd x, values;  // values: of the rows, then of validity
  std::optional<Motion> motion;
  RowValues rows;
  std::string message;

  const EditProblem& problem() const { return state->problem; }
  Eigen::VectorXd controls() const { return x.head(problem().controls.size()); }
  void require() const {
    if (!message.empty()) throw NotComputable(message);
  }
};

}  // namespace editing_detail

namespace {

NlpVariable controlVariable(const ControlSet& controls, int index) {
  const Variable& v = controls.variables()[static_cast<std::size_t>(index)];
  NlpVariable out;
  out.name = controls.describeVariable(index);
  out.component = v.component;
  out.control = v.control;
  out.start = v.start, out.lower = v.lower, out.upper = v.upper;
  out.scale = v.logarithmic ? v.scale * v.start : v.scale;
  out.logarithmic = v.logarithmic;
  return out;
}

NlpVariable timeVariable(const ConstraintSet& constraints, const FreeTime& free, double start) {
  NlpVariable out;
  out.name = "time of " + constraints.describeConstraint(free.constraint);
  out.component = "time";
  out.constraint = free.constraint;
  out.start = start, out.lower = free.from, out.upper = free.to;
  out.scale = free.scale;
  return out;
}

std::vector<NlpVariable> variablesOf(NlpState& state) {
  const EditProblem& problem = state.problem;
  std::vector<NlpVariable> variables;
  for (int i = 0; i < problem.controls.size(); ++i) variables.push_back(controlVariable(problem.controls, i));
  if (problem.times() == 0) return variables;
  const Eigen::VectorXd nearest = problem.constraints.nearestTimes(state.simulate(problem.controls.startValues()));
  for (int k = 0; k < problem.times(); ++k)
    variables.push_back(timeVariable(problem.constraints, problem.constraints.freeTimes()[static_cast<std::size_t>(k)],
                                     nearest[k]));
  return variables;
}

Eigen::VectorXd ofVariables(const std::vector<NlpVariable>& variables, double NlpVariable::* member) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(variables.size()));
  std::ranges::transform(variables, x.begin(), member);
  return x;
}

std::vector<NlpRow> rowsOf(const EditProblem& problem) {
  std::vector<NlpRow> rows;
  for (int i = 0; i < problem.constraints.size(); ++i) {
    const Row& row = problem.constraints.rows()[static_cast<std::size_t>(i)];
    rows.push_back({problem.constraints.describeRow(i), row.constraint, -1, row.lower, row.upper, row.scale});
  }
  for (int i = 0; i < problem.validity.size(); ++i)
    rows.push_back({problem.validity.describe(problem.controls, i), -1, problem.validity.control(i), kValidityMargin,
                    kInfinity, 1});
  return rows;
}

void checkPoint(const char* call, const NlpState& state, const Eigen::VectorXd& x) {
  checkCount(call, "numbers", static_cast<std::size_t>(x.size()), state.variables.size());
  checkEntries(call, "a value of", x);
}

/// Times are read where they are only within their interval.
std::string timeOutside(const NlpState& state, const Eigen::VectorXd& x) {
  for (Eigen::Index i = state.problem.controls.size(); i < x.size(); ++i) {
    const NlpVariable& time = state.variables[static_cast<std::size_t>(i)];
    if (!(x[i] >= time.lower && x[i] <= time.upper))
      return "The " + time.name + " is " + number(x[i]) + " s, outside of it.";
  }
  return "";
}

/// Of what functions of the caller throw the caller gets that itself.
template <class Call>
auto passingOn(Call&& call) {
  try {
    return call();
  } catch (const ThrownByUser& by_user) {
    std::rethrow_exception(by_user.thrown);
  }
}

void evaluate(NlpReading& reading, const Simulating& how) {
  const EditProblem& problem = reading.problem();
  reading.message = timeOutside(*reading.state, reading.x);
  if (!reading.message.empty()) return;
  try {
    reading.motion = reading.state->simulate(reading.controls(), how);
    if (reading.motion->status == MotionStatus::stopped) {
      reading.message = "The simulation was stopped.";
      return;
    }
    reading.rows = problem.constraints.evaluate(*reading.motion, reading.x.tail(problem.times()));
  } catch (const InputError& error) {
    reading.message = error.what();
    return;
  }
  reading.values.resize(problem.constraints.size() + problem.validity.size());
  reading.values << reading.rows.values, problem.validity.evaluate(problem.controls, reading.controls());
  if (!reading.rows.available) {
    reading.message = reading.rows.message;
  } else if (!reading.values.allFinite()) {
    reading.message = "The value of a row is beyond the range of doubles.";
  }
}

/// Changes of the controls, and their first and second derivatives by the values.
struct Changes {
  Eigen::VectorXd z, slope, bend;
};

Changes changesAt(const ControlSet& controls, const Eigen::VectorXd& values) {
  Changes out;
  out.z = controls.changesOf(values);
  out.slope = controls.valueRates(out.z).cwiseInverse();
  out.bend = -controls.valueBends(out.z).cwiseProduct(out.slope.cwiseProduct(out.slope).cwiseProduct(out.slope));
  return out;
}

void requireFinite(const std::string& what, const Eigen::MatrixXd& derivative) {
  if (!derivative.allFinite()) throw NotComputable(what + " beyond the range of doubles");
}

}  // namespace

NlpEvaluator::NlpEvaluator(const EditProblem& problem, std::size_t step_limit)
    : state_(std::make_shared<NlpState>(problem, step_limit)) {
  state_->variables = variablesOf(*state_);
  state_->rows = rowsOf(state_->problem);
}

const std::vector<NlpVariable>& NlpEvaluator::variables() const { return state_->variables; }
const std::vector<NlpRow>& NlpEvaluator::rows() const { return state_->rows; }

Eigen::VectorXd NlpEvaluator::start() const { return ofVariables(variables(), &NlpVariable::start); }
Eigen::VectorXd NlpEvaluator::lower() const { return ofVariables(variables(), &NlpVariable::lower); }
Eigen::VectorXd NlpEvaluator::upper() const { return ofVariables(variables(), &NlpVariable::upper); }

NlpPoint NlpEvaluator::at(const Eigen::VectorXd& x, std::stop_token stop,
                          const std::function<void(const SimulateProgress&)>& progress) const {
  checkPoint("NlpEvaluator::at", *state_, x);
  auto reading = std::make_shared<NlpReading>();
  reading->state = state_;
  reading->x = x;
  passingOn([&] { evaluate(*reading, {.stop = std::move(stop), .progress = progress}); });
  return NlpPoint(std::move(reading));
}

Scene NlpEvaluator::sceneAt(const Eigen::VectorXd& x) const {
  checkPoint("NlpEvaluator::sceneAt", *state_, x);
  return state_->problem.controls.sceneAt(x.head(state_->problem.controls.size()));
}

const Eigen::VectorXd& NlpPoint::x() const { return reading_->x; }
bool NlpPoint::available() const { return reading_->message.empty(); }
const std::string& NlpPoint::message() const { return reading_->message; }

const Motion& NlpPoint::motion() const {
  if (!reading_->motion) throw NotComputable(reading_->message);
  return *reading_->motion;
}

std::string NlpPoint::signature() const {
  reading_->require();
  return motion().signature(reading_->problem().constraints.extentIn(motion(), reading_->rows.times).events);
}

const Eigen::VectorXd& NlpPoint::values() const {
  reading_->require();
  return reading_->values;
}

double NlpPoint::objective() const {
  reading_->require();
  const EditProblem& problem = reading_->problem();
  return problem.objective(problem.controls.changesOf(reading_->controls()), reading_->rows);
}

NlpGradient NlpPoint::gradient() const {
  reading_->require();
  const EditProblem& problem = reading_->problem();
  const Changes changes = changesAt(problem.controls, reading_->controls());
  NlpGradient out;
  out.entries = Eigen::VectorXd::Zero(reading_->x.size());
  auto of_controls = out.entries.head(problem.controls.size());
  if (problem.changeWeight() > 0) of_controls = problem.changeWeight() * changes.z.cwiseProduct(changes.slope);
  if (const BoundFunction* own = problem.constraints.objective()) {
    const SceneGradient gradient = adjoint(motion(), reading_->rows.objective->seeds, &out.reliability);
    of_controls += problem.controls.gather(gradient, reading_->controls()) / own->function.scale;
    askControls(problem.controls, out.reliability);
    doubt(reading_->rows.objective->doubt, out.reliability);
  }
  requireFinite("the gradient of the objective is", out.entries);
  return out;
}

NlpJacobian NlpPoint::jacobian() const {
  reading_->require();
  const EditProblem& problem = reading_->problem();
  const Eigen::Index n = problem.controls.size(), rows = problem.constraints.size();
  NlpJacobian out;
  out.entries = Eigen::MatrixXd::Zero(reading_->values.size(), reading_->x.size());
  out.entries.topLeftCorner(rows, n) =
      jacobianByAdjoint(problem, reading_->controls(), motion(), reading_->rows, &out.reliability);
  out.entries.topRightCorner(rows, problem.times()) = jacobianByTimes(problem, motion(), reading_->rows);
  out.entries.bottomLeftCorner(problem.validity.size(), n) =
      problem.validity.jacobian(problem.controls, reading_->controls());
  out.reliability.resize(static_cast<std::size_t>(out.entries.rows()));
  for (Eigen::Index i = 0; i < out.entries.rows(); ++i)
    requireFinite("the derivative of " + reading_->state->rows[static_cast<std::size_t>(i)].name + " is", out.entries.row(i));
  return out;
}

bool NlpPoint::hasHessian() const {
  if (!available() || !hasSecondOrder(motion())) return false;
  for (const RowNote& note : reading_->rows.notes)
    if (!note.second_order) return false;
  return !reading_->rows.objective || reading_->rows.objective->second_order;
}

Eigen::MatrixXd NlpPoint::secondDerivatives(double objective_weight, const Eigen::VectorXd& row_weights,
                                            const Eigen::MatrixXd& directions, RatesWanted wanted) const {
  const EditProblem& problem = reading_->problem();
  const Eigen::Index n = problem.controls.size(), rows = problem.constraints.size();
  const Eigen::VectorXd controls = reading_->controls();
  const BoundFunction* own = problem.constraints.objective();
  Eigen::MatrixXd along = passingOn([&] {
    return rowsCurvature(problem, controls, motion(), reading_->rows, row_weights.head(rows),
                         own ? objective_weight / own->function.scale : 0, directions, wanted)
        .along;
  });
  const Eigen::VectorXd of_validity = row_weights.tail(problem.validity.size());
  along.topRows(n) += problem.validity.hessian(problem.controls, of_validity) * directions.topRows(n);
  const Changes changes = changesAt(problem.controls, controls);
  const Eigen::VectorXd of_change = changes.slope.cwiseAbs2() + changes.z.cwiseProduct(changes.bend);
  along.topRows(n) += objective_weight * problem.changeWeight() * of_change.asDiagonal() * directions.topRows(n);
  requireFinite("second derivatives are", along);
  return along;
}

Eigen::MatrixXd NlpPoint::hessian(double objective_weight, const Eigen::VectorXd& row_weights) const {
  reading_->require();
  checkedNumber("NlpPoint::hessian", "the weight of the objective", objective_weight);
  checkCount("NlpPoint::hessian", "weights", static_cast<std::size_t>(row_weights.size()),
             static_cast<std::size_t>(reading_->values.size()));
  checkEntries("NlpPoint::hessian", "the weight of a row", row_weights);
  const Eigen::Index all = reading_->x.size();
  const Eigen::MatrixXd H =
      secondDerivatives(objective_weight, row_weights, Eigen::MatrixXd::Identity(all, all), RatesWanted::varied);
  return 0.5 * (H + H.transpose());  // symmetric to rounding already
}

Eigen::VectorXd NlpPoint::hessianTimes(double objective_weight, const Eigen::VectorXd& row_weights,
                                       const Eigen::VectorXd& direction) const {
  reading_->require();
  const char* const call = "NlpPoint::hessianTimes";
  checkedNumber(call, "the weight of the objective", objective_weight);
  checkCount(call, "weights", static_cast<std::size_t>(row_weights.size()), static_cast<std::size_t>(reading_->values.size()));
  checkEntries(call, "the weight of a row", row_weights);
  checkPoint(call, *reading_->state, direction);
  return secondDerivatives(objective_weight, row_weights, direction, RatesWanted::all);
}

}  // namespace carom
