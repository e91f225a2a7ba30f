// SPDX-License-Identifier: MIT
#include "editing/report/explain.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/QR>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/report/extended_controls.hpp"
#include "editing/report/linear_model.hpp"
#include "editing/strategy/nail_in_solid.hpp"
#include "editing/solve/dependence.hpp"

namespace carom::editing_detail {
namespace {

constexpr std::size_t kMostConflicts = 4, kMostHelp = 8;
/// Rows that can be brought this near, relative to where they are, count as reachable to first order.
constexpr double kReachable = 1e-5;
/// What removes less of the error than this is no help.
constexpr double kSomeHelp = 0.02;
/// Candidates of more bodies than this are looked at only where their derivative points along the error.
constexpr std::size_t kMostCandidates = 60;

int rankOf(const Eigen::MatrixXd& J) { return J.cols() == 0 ? 0 : static_cast<int>(splitRows(J).independent.size()); }

double share(double before, double after) { return before > 0 ? std::clamp(1 - after / before, 0.0, 1.0) : 0; }

struct Explanation {
  EditEvaluator& evaluator;
  const EditProblem& problem;
  EditPoint& point;
  LinearModel linear;
  LinearModel::Nearest nearest;
  double met = 0;
  WhyNot why;

  Explanation(EditEvaluator& s, EditPoint& p)
      : evaluator(s), problem(s.problem()), point(p), linear(s, p), nearest(linear.nearest(linear.allRows())) {
    met = std::max(10 * evaluator.options().tolerance, kReachable * point.rows.scaled.norm());
    why.rows = problem.constraints.size();
    why.rank = rankOf(linear.J);
  }
  bool outOfReach() const { return nearest.off > met; }

  void findConflicts() {
    for (std::vector<int>& rows : conflictsIn(linear, met, kMostConflicts)) {
      WhyNot::Conflict conflict;
      for (int row : rows) conflict.names.push_back(problem.constraints.describeRow(row));
      conflict.rows = std::move(rows);
      why.conflicts.push_back(std::move(conflict));
    }
  }

  void findBounds() {
    for (int j = 0; j < problem.controls.size(); ++j) {
      const Variable& v = problem.controls.variables()[static_cast<std::size_t>(j)];
      const double y = point.changes[j];
      for (const bool upper : {false, true}) {
        const double bound = upper ? evaluator.upper()[j] : evaluator.lower()[j];
        if (!std::isfinite(bound) || !(std::abs(y - bound) <= 1e-7 * (1 + std::abs(bound)))) continue;
        WhyNot::AtBound at{v.control, problem.controls.describeVariable(j), v.component, upper ? v.upper : v.lower, upper, 0, 0};
        LinearModel freed = linear;
        (upper ? freed.upper : freed.lower)[j] = upper ? kLargestStep : -kLargestStep;
        const LinearModel::Nearest now = freed.nearest(freed.allRows());
        at.removes = outOfReach() ? share(nearest.off, now.off) : 0;
        at.change = now.step[j] * problem.rates(point.changes)[j];
        why.at_bounds.push_back(std::move(at));
      }
    }
    std::stable_sort(why.at_bounds.begin(), why.at_bounds.end(),
                     [](const auto& a, const auto& b) { return a.removes > b.removes; });
  }

  // The rows of all conflicts: what has to become independent.
  std::vector<int> conflictingRows() const {
    std::vector<int> rows;
    for (const WhyNot::Conflict& conflict : why.conflicts)
      rows.insert(rows.end(), conflict.rows.begin(), conflict.rows.end());
    return rows;
  }

  void findHelp() {
    std::vector<Candidate> candidates = candidatesFor(problem, point);
    LinearModel all = linear;
    for (const Candidate& c : candidates) all.extend(c.columns, c.lower, c.upper);
    why.extended_rank = rankOf(all.J);
    keepSteepest(candidates);
    const std::vector<int> rows = conflictingRows();
    const Eigen::MatrixXd J = linear.J(rows, Eigen::all);
    const int rank = rankOf(J);
    const Eigen::Index n = linear.J.cols();
    for (const Candidate& c : candidates) {
      LinearModel extended = linear;
      const Eigen::VectorXd far = Eigen::VectorXd::Constant(c.lower.size(), kLargestStep);
      extended.extend(c.columns, c.lower.cwiseMax(-far).cwiseMin(0), c.upper.cwiseMin(far).cwiseMax(0));
      const LinearModel::Nearest now = extended.nearest(extended.allRows());
      WhyNot::Help help{c.control, c.name, share(nearest.off, now.off), 0, false, false, false};
      if (help.removes < kSomeHelp) continue;
      help.change = now.step.tail(now.step.size() - n).norm();
      help.restores_rank = rankOf(extended.J(rows, Eigen::all)) > rank;
      why.would_help.push_back(std::move(help));
    }
    // First what meets most of the error, then what lies nearest to what varies already, then the smaller change.
    const auto order = [&](const WhyNot::Help& help) {
      return std::tuple(-std::lround(20 * help.removes), remoteness(help.control), help.change);
    };
    std::stable_sort(why.would_help.begin(), why.would_help.end(),
                     [&](const auto& a, const auto& b) { return order(a) < order(b); });
    if (why.would_help.size() > kMostHelp) why.would_help.resize(kMostHelp);
  }

  // 0: a locked component of a control; 1: of a body that is thrown or held, or of its material; 2: gravity, tilts, and
  // what belongs to other bodies.
  int remoteness(const Control& control) const {
    const auto& controls = problem.controls.controls();
    const auto varies = [&](const auto& test) {
      return std::any_of(controls.begin(), controls.end(), [&](const BoundControl& b) { return test(b.control); });
    };
    if (varies([&](const Control& c) { return varyTheSame(c, control); })) return 0;
    if (findControlKind(control.vary)->owner == OwnerKind::impact) return 2;
    const Scene& scene = problem.controls.startScene();
    const auto belongs = [&](const std::string& body) {
      return control.body.empty()
                 ? scene.bodies[static_cast<std::size_t>(bodyIndex(scene, body))].material == control.material &&
                       !control.material.empty()
                 : control.body == body;
    };
    const auto& held = problem.constraints.constraints();
    const bool near = std::any_of(held.begin(), held.end(), [&](const Constraint& c) { return belongs(c.body); }) ||
                      varies([&](const Control& c) { return !c.body.empty() && belongs(c.body); });
    return near ? 1 : 2;
  }

  void keepSteepest(std::vector<Candidate>& candidates) const {
    if (candidates.size() <= kMostCandidates) return;
    const Eigen::VectorXd off = point.rows.scaled + linear.J * nearest.step;
    std::stable_sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
      return (a.columns.transpose() * off).norm() > (b.columns.transpose() * off).norm();
    });
    candidates.resize(kMostCandidates);
  }

  // What a step towards the constraints meets: rows that are no longer there, or a scene that makes no sense.
  std::string refusal() const {
    for (const double length : {1.0, 0.3, 0.1, 0.03}) {
      const Eigen::VectorXd step = length * nearest.step.cwiseMax(-1).cwiseMin(1);
      const Eigen::VectorXd there = (point.changes + step).cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper());
      try {
        const Motion motion = simulateAt(problem, problem.valuesOf(there), problem.horizon);
        const RowValues rows = problem.constraints.evaluate(motion, problem.timesOf(there));
        if (!rows.available) return rows.message;
      } catch (const InputError& error) {
        return std::string("The scene that a step leads to was refused: ") + error.what() + ".";
      }
    }
    return "";
  }
};

void tryHelp(const Scene& written, const EditEvaluator& evaluator, WhyNot& why) {
  if (evaluator.iterationsLeft() <= 0) return;  // what is asked for first then is more of them
  const EditProblem& problem = evaluator.problem();
  std::vector<Control> controls;
  for (const BoundControl& bound : problem.controls.controls()) controls.push_back(bound.control);
  for (std::size_t k = 0; k < why.would_help.size() && k < kTries; ++k) {
    WhyNot::Help& help = why.would_help[k];
    std::vector<Control> more = controls;
    more.push_back(help.control);
    EditOptions options;
    options.max_iterations = kTryIterations;
    options.tolerance = evaluator.options().tolerance;
    options.sequence = SequencePolicy::stay;
    options.time_budget_seconds = evaluator.secondsLeft();
    if (!(options.time_budget_seconds > 0)) return;
    EditProblem extended(written, *problem.contacts, problem.duration, more, problem.constraints.constraints());
    extended.step_limit = problem.step_limit;
    extended.stop = options.stop = problem.stop;
    extended.abandon = problem.abandon;
    EditEvaluator again(extended, options);
    const EditSolution solution = findSolution(again);
    help.tried = true;
    help.solves = solution.status == EditStatus::solved && again.reached(*solution.point);
  }
}

std::string solvable(const WhyNot::Help& help) {
  return "The edit can be solved when the " + help.name + " varies too.";
}

std::string percent(double share) { return number(std::round(100 * share)) + " %"; }

void tell(WhyNot& why, bool out_of_reach, const std::string& refusal) {
  std::vector<std::string>& say = why.sentences;
  for (const WhyNot::Inside& inside : why.inside)
    say.push_back(sentence(describeInside(inside)));
  for (const WhyNot::Conflict& conflict : why.conflicts) {
    if (conflict.names.size() == 1) {
      say.push_back("To first order no change of the controls meets " + conflict.names[0] + " from the nearest point.");
    } else {
      say.push_back("To first order " + listOf(conflict.names) + " cannot be met together from the nearest point: drop " +
                    (conflict.names.size() == 2 ? "either one." : "any one of them (an irreducible infeasible subset)."));
    }
  }
  if (!out_of_reach)
    say.push_back(
        "To first order the constraints can be met from the nearest point: the obstacle is the curvature of the "
        "motion, or a boundary of the impact sequence.");
  if (!refusal.empty()) say.push_back("On the way: " + refusal);
  std::vector<std::string> held, useless;
  for (const WhyNot::AtBound& at : why.at_bounds) {
    const std::string name = at.name + " at its " + (at.upper ? "upper" : "lower") + " bound " + number(at.bound);
    if (at.removes >= kSomeHelp) {
      held.push_back(name + " (without it " + percent(at.removes) + " of the error vanishes)");
    } else {
      useless.push_back(name);
    }
  }
  if (!held.empty()) say.push_back("Active bounds that hold it back: " + listOf(held) + ".");
  if (!useless.empty()) say.push_back("Other active bounds: " + listOf(useless) + ".");
  for (const WhyNot::Help& help : why.would_help) {
    if (help.solves) say.push_back(solvable(help));
  }
  std::vector<std::string> hopeful;
  for (const WhyNot::Help& help : why.would_help)
    if (!help.solves)
      hopeful.push_back(help.name + " (" + percent(help.removes) + (help.tried ? "; tried, not enough)" : ")"));
  if (!hopeful.empty())
    say.push_back("Would remove that much of the error if they varied, to first order: " + listOf(hopeful) + ".");
  if (out_of_reach && why.would_help.empty()) say.push_back("No other scene parameter would help, to first order.");
  for (std::string& sentence : say)
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
}

/// Beside a proof that names what would have to be otherwise: bounds and parameters that would help, none of which is tried.
WhyNot besideProof(EditEvaluator& evaluator, const EditSolution& solution) {
  WhyNot why;
  if (solution.inside.empty() && solution.point->rows.available && evaluator.differentiate(*solution.point)) {
    Explanation explanation(evaluator, *solution.point);
    explanation.findConflicts();
    explanation.findBounds();
    if (explanation.outOfReach()) explanation.findHelp();
    why = std::move(explanation.why);
  }
  why.inside = solution.inside;
  why.sentences = {solution.message};
  return why;
}

}  // namespace

WhyNot explain(const Scene& written, EditEvaluator& evaluator, const EditSolution& solution) {
  Explanation explanation(evaluator, *solution.point);
  WhyNot& why = explanation.why;
  why.inside = nailsInSolids(evaluator.problem(), written);
  std::string refusal;
  explanation.findConflicts();
  explanation.findBounds();
  if (explanation.outOfReach()) explanation.findHelp();
  // Nothing helps a nail in a wall.
  if (why.inside.empty()) tryHelp(written, evaluator, why);
  if (solution.point->rows.scaled.norm() > 0) refusal = explanation.refusal();
  tell(why, explanation.outOfReach(), refusal);
  return std::move(why);
}

void explainInto(EditResult& result, const Scene& written, EditEvaluator& evaluator, const EditSolution& solution) {
  if (result.status != EditStatus::infeasible && result.status != EditStatus::not_converged) return;
  if (solution.tells_all) {
    result.why_not = besideProof(evaluator, solution);
    return;
  }
  if (!solution.point->rows.available || !evaluator.differentiate(*solution.point)) return;
  result.why_not = explain(written, evaluator, solution);
  if (!result.why_not.inside.empty()) result.status = EditStatus::infeasible;
  const WhyNot& why = result.why_not;
  if (!why.inside.empty() && !why.sentences.empty()) result.message = why.sentences[0] + " " + result.message;
  for (const WhyNot::Help& help : why.would_help) {
    if (!help.solves) continue;
    result.message += " " + solvable(help);
    break;
  }
}

}  // namespace carom::editing_detail
