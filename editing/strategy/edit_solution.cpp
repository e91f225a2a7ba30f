// SPDX-License-Identifier: MIT
#include "editing/strategy/edit_solution.hpp"

#include <algorithm>
#include <cmath>

#include "editing/detail/messages.hpp"
#include "editing/problem/growth.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/solve/minimise.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/approach.hpp"
#include "editing/strategy/impossible.hpp"
#include "editing/strategy/inside_margin.hpp"
#include "editing/strategy/last_digits.hpp"
#include "editing/strategy/local_solve.hpp"
#include "editing/strategy/row_choice.hpp"
#include "editing/strategy/samples.hpp"
#include "editing/strategy/sequence_search.hpp"

namespace carom::editing_detail {
namespace {

/// What counts as a smaller change, as a share of the objective.
constexpr double kClearlyLess = 0.98;
/// Points beside one on a boundary, and how far they are from it, as a share of the change.
constexpr int kDirectionsBeside = 16;
constexpr double kBeside = 1e-4;
/// Iterations of the solver along the sequence of the start: where it leads anywhere, it is there by then.
constexpr int kFollowingIterations = 20, kInsideIterations = 40;
/// Iterations of the solver at most, where the start's impacts are to be kept.
constexpr int kKeepingIterations = 1000;
/// An objective, a third of a natural scale, from which on the solver looks within the sequence of the start once more.
constexpr double kLargeChange = 0.05;
/// Events of a solution in other impacts than those of the start from which on its neighbours are many: so much more work
/// is done for it.
constexpr int kManyImpacts = 4;
constexpr double kLongerForMany = 2.5;
/// Of the objective, a change by one natural scale: one that is larger is worth the usual work, however soon it was found.
constexpr double kNoticedChange = 0.5;
/// Rounds without a clearly smaller change that end an edit, however little work they are, once the work is unusual.
constexpr int kMostRoundsWithout = 30;
/// So often solutions are looked for, while none of those that were found is confirmed.
constexpr int kTries = 3;

/// A point once more brought as near to the constraints as rounding allows, within its own impact sequence.
EditPointPtr polished(EditEvaluator& evaluator, const EditPointPtr& point) {
  if (evaluator.halt() != Halt::none) return point;
  return projectOntoConstraints(evaluator, point, kOntoSteps, &point->signature);
}

/// Whether a point meets the constraints in a motion that is simulated to its end too. On the boundary of two impact
/// sequences, to the last bit, one motion has an impact that the other lacks.
bool isConfirmed(const EditEvaluator& evaluator, const EditPoint& point) {
  const EditProblem& problem = evaluator.problem();
  const Motion motion = simulateScene(problem, problem.controls.sceneAt(point.values), problem.duration);
  const RowValues rows = problem.constraints.evaluate(motion, problem.timesOf(point.changes));
  return rows.available && rows.scaled.lpNorm<Eigen::Infinity>() <= evaluator.options().tolerance;
}

/// A confirmed point a little beside one that is not; null where there is none.
EditPointPtr confirmedBeside(EditEvaluator& evaluator, EditPoint& point) {
  if (!evaluator.differentiate(point)) return nullptr;
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  const EvenPoints directions(free.cols());
  for (int k = 0; k < kDirectionsBeside && free.cols() > 0; ++k) {
    const Eigen::VectorXd beside = point.changes + kBeside * point.changes.norm() * (free * directions.onSphere(k));
    const EditPointPtr trial = evaluator.evaluate(beside.cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper()));
    const EditPointPtr met = trial ? projectOntoConstraints(evaluator, trial, kOntoSteps) : nullptr;
    if (met && evaluator.reached(*met) && isConfirmed(evaluator, *met)) return met;
  }
  return nullptr;
}

/// The smallest change that is confirmed; null where none is.
EditPointPtr smallestConfirmed(EditEvaluator& evaluator, SequenceSearch& across) {
  while (!across.solutions().empty()) {
    const EditPointPtr smallest = across.solutions().front();
    const EditPointPtr point = polished(evaluator, smallest);
    if (evaluator.reached(*point) && isConfirmed(evaluator, *point)) return point;
    if (const EditPointPtr beside = confirmedBeside(evaluator, *point)) return beside;
    across.drop(smallest);
  }
  return nullptr;
}

/// "position.x of 'hat' at 1.4 s by 0.02 m (it is 1.38 m), and 2 others": the worst, as all are in EditResult::residuals.
std::string unmetRows(const EditEvaluator& evaluator, const EditPoint& point) {
  const auto size = [&](int i) { return std::abs(point.rows.scaled[i]); };
  int worst = -1, others = -1;
  for (int i = 0; i < evaluator.problem().constraints.size(); ++i) {
    if (size(i) <= evaluator.options().tolerance) continue;
    ++others;
    if (worst < 0 || size(i) > size(worst)) worst = i;
  }
  if (worst < 0) return "";
  const ConstraintSet& set = evaluator.problem().constraints;
  const Row& row = set.rows()[static_cast<std::size_t>(worst)];
  std::string text = set.describeRow(worst) + " by " + brief(std::abs(point.rows.residuals[worst])) + unitOf(row);
  if (row.kind && !row.kind->from_target) text += " (it is " + brief(point.rows.values[worst]) + unitOf(row) + ")";
  return others > 0 ? text + ", and " + std::to_string(others) + (others > 1 ? " others" : " other") : text;
}

EditSolution unsolved(EditEvaluator& evaluator, EditSolution solution) {
  const std::string nearest = solution.point->rows.available
                                  ? "The nearest point found misses " + unmetRows(evaluator, *solution.point) + "." +
                                        lastDigits(evaluator, *solution.point)
                                  : solution.point->rows.message;
  const bool stays = evaluator.options().sequence == SequencePolicy::stay;
  const std::string where = stays ? " within the initial impact sequence" : "";
  if (evaluator.halt() == Halt::out_of_time) {
    solution.status = EditStatus::out_of_time;
    solution.message = "The time budget ran out before the constraints were met. " + nearest;
  } else if (evaluator.halt() == Halt::cancelled) {
    solution.status = EditStatus::cancelled;
    solution.message = "The edit was cancelled before the constraints were met. " + nearest;
  } else if (evaluator.iterationsLeft() > 0) {
    solution.status = EditStatus::not_converged;
    solution.message = "No way was found to meet all constraints" + where + " with these controls. " + nearest;
  } else {
    solution.status = EditStatus::not_converged;
    solution.message = "The search ended after " + std::to_string(evaluator.iterations()) +
                       " iterations, its limit, without meeting the constraints" + where + ". " + nearest;
  }
  return solution;
}

/// A point that is a solution within the initial impact sequence; null otherwise.
EditPointPtr insideOrNone(const EditEvaluator& evaluator, const EditPoint& start, const EditPointPtr& point) {
  return point && evaluator.reached(*point) && point->signature == start.signature ? point : nullptr;
}

/// The smallest change within the initial impact sequence where any impacts will do; null where none was found. Steps that
/// stay within it come first, as the solver takes several times as long; it needs them only where an objective of one's own
/// leads elsewhere.
EditPointPtr stepsInSequence(EditEvaluator& evaluator, const RowChoice& choice, const EditPointPtr& start) {
  const auto solved = [&] {
    return insideOrNone(evaluator, *start, solveLocally(evaluator, choice.from, {.signature = &start->signature}));
  };
  const bool steps_first = !evaluator.problem().constraints.objective();
  if (steps_first)
    if (const EditPointPtr inside = solved(); inside || !evaluator.goesOn()) return inside;
  const int following = std::min(kFollowingIterations, evaluator.iterationsLeft() / 4);
  const EditPointPtr followed = insideOrNone(evaluator, *start, followSequence(evaluator, choice.from, choice.rows, following));
  return followed || steps_first || !evaluator.goesOn() ? followed : solved();
}

/// The same where the start's impacts are to be kept, or preferred: by the solver, as if features had no edges, and then with
/// every point simulated. Trials may leave the sequence on the way, and where they end outside of it they show where to look.
EditPointPtr solveInSequence(EditEvaluator& evaluator, const RowChoice& choice, const EditPointPtr& start) {
  const bool may_leave = evaluator.options().sequence != SequencePolicy::stay;
  const int most = std::min(kKeepingIterations, evaluator.iterationsLeft());
  const int iterations = may_leave ? most / 2 : most;
  const EditPointPtr followed = insideOrNone(evaluator, *start, followSequence(evaluator, choice.from, choice.rows, iterations / 2));
  if (followed || !evaluator.goesOn()) return followed;
  return insideOrNone(evaluator, *start, minimiseChange(evaluator, choice.from, choice.rows, &start->signature, iterations));
}

/// The solver's own way within the sequence of the start, which takes long and seldom leads to a smaller change: where
/// only large ones are known.
void solveInSequenceAgain(EditEvaluator& evaluator, const RowChoice& choice, const EditPointPtr& start,
                          SequenceSearch& across) {
  if (!(across.solutions().front()->objective > kLargeChange) || !evaluator.goesOn()) return;
  const int iterations = std::min(kInsideIterations, evaluator.iterationsLeft());
  const EditPointPtr inside = minimiseChange(evaluator, choice.from, choice.rows, &start->signature, iterations);
  if (evaluator.reached(*inside) && inside->signature == start->signature) across.add(inside);
}

/// Whether rows that the motion of the start lacks may be there in others: not those of times after its duration.
bool mayBecomeAvailable(const EditEvaluator& evaluator) {
  const EditProblem& problem = evaluator.problem();
  if (evaluator.options().sequence == SequencePolicy::stay || problem.unknowns() == 0) return false;
  if (evaluator.best()->motion.status == MotionStatus::step_limit) return false;
  const std::vector<Constraint>& held = problem.constraints.constraints();
  return std::none_of(held.begin(), held.end(), [&](const Constraint& c) {
    return !c.targets.empty() && c.at.isTime() && c.at.time > problem.duration;
  });
}

/// The factor of the allowance, by what the local solves were expected to bring since the best was found.
double factorBy(const ExpectedImprovement& expected, const StoppingRule& stopping) {
  return std::clamp(expected.mean() / ExpectedImprovement::kUsual, stopping.least_expected, stopping.most_expected);
}

/// A first solution, and then smaller changes, until none was found for too long.
void searchAcross(const EditEvaluator& evaluator, SequenceSearch& across) {
  const SearchPlan& plan = planOf(evaluator.options().effort);
  const StoppingRule& stopping = plan.stopping;
  for (int rounds = plan.first_rounds; across.solutions().empty() && rounds > 0 && across.round(); --rounds) {
  }
  if (across.solutions().empty()) return;
  double found = evaluator.work();
  for (int rounds_without = 0; rounds_without < kMostRoundsWithout || evaluator.work() < stopping.unusual;) {
    const bool many = !across.isBestInside() && across.impactsOfBest() > kManyImpacts;
    const double multiple = many ? kLongerForMany : 1;
    const double allowance = stopping.allowance(found, multiple * factorBy(across.expected(), stopping));
    const double before = across.solutions().front()->objective;
    const bool may_end = before <= kNoticedChange || evaluator.work() >= stopping.usual;
    if (may_end && rounds_without >= multiple * stopping.rounds && evaluator.work() - found >= allowance) return;
    if (rounds_without >= plan.small_rounds && across.hasSmallChangeInside()) return;
    if (rounds_without > 0 && across.isLong()) return;
    if (evaluator.work() >= stopping.in_all) return;
    if (!across.round()) return;
    ++rounds_without;
    if (across.solutions().front()->objective < kClearlyLess * before)
      rounds_without = 0, found = evaluator.work(), across.expectAnew();
  }
}

/// Distinct solutions until there are as many as the options ask for, the smallest change first. One that turns out smaller
/// than the solution takes its place, where any impacts will do.
void takeMoreSolutions(EditEvaluator& evaluator, SequenceSearch& across, EditSolution& solution) {
  across.add(solution.point);
  const auto enough = static_cast<std::size_t>(evaluator.options().alternatives);
  while (across.solutions().size() < enough && across.round(SequenceSearch::Seek::others)) continue;
  across.polish(enough);
  solution.others = across.solutions();
  if (evaluator.options().sequence != SequencePolicy::smallest) return;
  for (const EditPointPtr& other : solution.others) {
    if (!(other->objective < solution.point->objective)) return;
    const EditPointPtr point = polished(evaluator, other);
    if (!evaluator.reached(*point) || !isConfirmed(evaluator, *point)) continue;
    solution.point = point;
    return;
  }
}

/// Inside of where an impact that is needed would be lost, if that costs little and the whole motion confirms it.
void leaveTheEdge(EditEvaluator& evaluator, EditSolution& solution) {
  MovedInside moved = movedInside(evaluator, solution.point);
  if (moved.point && !isConfirmed(evaluator, *moved.point)) return;
  if (moved.point) solution.point = moved.point;
  solution.message = std::move(moved.message);
}

EditSolution impossible(EditSolution solution, const Impossible& proof) {
  solution.status = EditStatus::infeasible;
  solution.message = proof.why;
  solution.tells_all = proof.tells_all;
  solution.inside = proof.inside;
  return solution;
}

}  // namespace

EditSolution findSolution(EditEvaluator& evaluator) {
  EditSolution solution;
  const EditPointPtr start = solution.start = solution.point = evaluator.evaluateStart();
  if (!start->rows.available && evaluator.options().stop.stop_requested()) {
    solution.status = EditStatus::cancelled;
    solution.message = "The edit was cancelled before its initial motion was simulated.";
    return solution;
  }
  if (!start->rows.available && !mayBecomeAvailable(evaluator)) {
    solution.status = EditStatus::bad_start;
    solution.message = start->rows.message;
    return solution;
  }
  if (evaluator.reached(*start)) {
    solution.status = EditStatus::solved;
    return solution;
  }
  if (const Impossible proof = whyImpossible(evaluator, *start); !proof.why.empty()) return impossible(std::move(solution), proof);
  const bool may_leave = evaluator.options().sequence != SequencePolicy::stay;
  const bool from_start = start->rows.available && evaluator.differentiate(*start);
  const RowChoice choice = from_start ? chooseRows(evaluator, start) : RowChoice{};
  const bool contradicts = !choice.contradiction.empty();  // in this impact sequence at least
  EditPointPtr inside;
  if (from_start && !contradicts) {
    solution.growth = growthOf(start->motion, evaluator.problem(), start->rows);
    const bool any = evaluator.options().sequence == SequencePolicy::smallest;
    inside = any ? stepsInSequence(evaluator, choice, start) : solveInSequence(evaluator, choice, start);
  }
  SequenceSearch across(evaluator, start);
  if (inside) across.add(inside);
  EditPointPtr confirmed;
  const bool first_ends = planOf(evaluator.options().effort).first_ends;
  for (int tries = kTries; !confirmed && tries > 0; --tries) {
    if (may_leave) searchAcross(evaluator, across);
    if (across.solutions().empty()) break;
    const bool unsolved_inside = from_start && !contradicts && !inside;
    if (may_leave && unsolved_inside && tries == kTries && !first_ends) solveInSequenceAgain(evaluator, choice, start, across);
    if (!first_ends) across.polishSmallest();
    confirmed = smallestConfirmed(evaluator, across);
  }
  solution.point = confirmed ? confirmed : polished(evaluator, evaluator.best());
  if (!evaluator.reached(*solution.point)) {
    solution = unsolved(evaluator, std::move(solution));
    const EditPointPtr lacks = across.nearestLacking();
    if (lacks && !lacks->rows.available && !solution.point->rows.available)
      for (const std::string& said : {lacks->rows.message, describeApproach(evaluator.problem(), *lacks)})
        if (solution.message.find(said) == std::string::npos) solution.message += " " + said;
    if (evaluator.halt() == Halt::none) solution.contradiction = choice.contradiction;
    return solution;
  }
  solution.status = EditStatus::solved;
  leaveTheEdge(evaluator, solution);
  if (may_leave && evaluator.options().alternatives > 1) takeMoreSolutions(evaluator, across, solution);
  return solution;
}

}  // namespace carom::editing_detail
