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
#include "editing/strategy/landing.hpp"
#include "editing/strategy/row_choice.hpp"
#include "editing/strategy/samples.hpp"
#include "editing/strategy/sequence_search.hpp"

namespace carom::editing_detail {
namespace {

/// What counts as a smaller change, as a share of the objective.
constexpr double kClearlyLess = 0.98;
/// Points beside one on a border, and how far they are from it, as a share of the change.
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
constexpr double kPatienceForMany = 2.5;
/// Of the objective, a change by one natural scale: one that is larger is worth the usual work, however soon it was found.
constexpr double kNoticedChange = 0.5;
/// Rounds without a clearly smaller change, however little work they are, once the work is unusual.
constexpr int kIdleRounds = 30;
/// So often solutions are looked for, while none of those that were found is confirmed.
constexpr int kTries = 3;

/// A point once more brought as near to the constraints as rounding allows, within its own impact sequence.
EditPointPtr polished(EditSearch& search, const EditPointPtr& point) {
  if (search.halt() != Halt::none) return point;
  return projectOntoConstraints(search, point, kOntoSteps, &point->signature);
}

/// Whether a point meets the constraints in a motion that is simulated to its end too. On the border of two impact
/// sequences, to the last bit, one motion has an impact that the other lacks.
bool isConfirmed(const EditSearch& search, const EditPoint& point) {
  const EditProblem& problem = search.problem();
  const Motion motion = simulateScene(problem, problem.controls.sceneAt(point.values), problem.duration);
  const RowValues rows = problem.constraints.evaluate(motion, problem.timesOf(point.changes));
  return rows.available && rows.scaled.lpNorm<Eigen::Infinity>() <= search.options().tolerance;
}

/// A confirmed point a little beside one that is not; null where there is none.
EditPointPtr confirmedBeside(EditSearch& search, EditPoint& point) {
  if (!search.differentiate(point)) return nullptr;
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  const EvenPoints directions(free.cols());
  for (int k = 0; k < kDirectionsBeside && free.cols() > 0; ++k) {
    const Eigen::VectorXd beside = point.changes + kBeside * point.changes.norm() * (free * directions.onSphere(k));
    const EditPointPtr trial = search.evaluate(beside.cwiseMax(search.lower()).cwiseMin(search.upper()));
    const EditPointPtr met = trial ? projectOntoConstraints(search, trial, kOntoSteps) : nullptr;
    if (met && search.reached(*met) && isConfirmed(search, *met)) return met;
  }
  return nullptr;
}

/// The smallest change that is confirmed; null where none is.
EditPointPtr smallestConfirmed(EditSearch& search, SequenceSearch& across) {
  while (!across.solutions().empty()) {
    const EditPointPtr smallest = across.solutions().front();
    const EditPointPtr point = polished(search, smallest);
    if (search.reached(*point) && isConfirmed(search, *point)) return point;
    if (const EditPointPtr beside = confirmedBeside(search, *point)) return beside;
    across.drop(smallest);
  }
  return nullptr;
}

/// "position.x of 'hat' at 1.4 s by 0.02, and 2 others": the worst, as all are in EditResult::residuals.
std::string unmetRows(const EditSearch& search, const EditPoint& point) {
  const auto size = [&](int i) { return std::abs(point.rows.scaled[i]); };
  int worst = -1, others = -1;
  for (int i = 0; i < search.problem().constraints.size(); ++i) {
    if (size(i) <= search.options().tolerance) continue;
    ++others;
    if (worst < 0 || size(i) > size(worst)) worst = i;
  }
  if (worst < 0) return "";
  const std::string text =
      search.problem().constraints.describeRow(worst) + " by " + brief(point.rows.residuals[worst]);
  return others > 0 ? text + ", and " + std::to_string(others) + (others > 1 ? " others" : " other") : text;
}

EditSolution unsolved(EditSearch& search, EditSolution solution) {
  const std::string nearest = solution.point->rows.available
                                  ? "The nearest that was found misses " + unmetRows(search, *solution.point) + "."
                                  : solution.point->rows.message;
  const bool stays = search.options().sequence == SequencePolicy::stay;
  const std::string where = stays ? " within the impact sequence of the start" : "";
  if (search.halt() == Halt::out_of_time) {
    solution.status = EditStatus::out_of_time;
    solution.message = "The time budget ran out before the constraints were met. " + nearest;
  } else if (search.halt() == Halt::cancelled) {
    solution.status = EditStatus::cancelled;
    solution.message = "The edit was cancelled before the constraints were met. " + nearest;
  } else if (search.iterationsLeft() > 0) {
    solution.status = EditStatus::not_converged;
    solution.message = "No way was found to meet all constraints" + where + " with these controls. " + nearest;
  } else {
    solution.status = EditStatus::not_converged;
    solution.message = "The search ended after " + std::to_string(search.iterations()) +
                       " iterations, its limit, without meeting the constraints" + where + ". " + nearest;
  }
  return solution;
}

/// A point that is a solution within the impact sequence of the start; null otherwise.
EditPointPtr insideOrNone(const EditSearch& search, const EditPoint& start, const EditPointPtr& point) {
  return point && search.reached(*point) && point->signature == start.signature ? point : nullptr;
}

/// The smallest change within the impact sequence of the start where any impacts will do; null where none was found. Steps that
/// stay within it come first, as the solver takes several times as long; it needs them only where an objective of one's own
/// leads elsewhere.
EditPointPtr stepsInSequence(EditSearch& search, const RowChoice& choice, const EditPointPtr& start) {
  const auto landed = [&] { return insideOrNone(search, *start, land(search, choice.from, {.signature = &start->signature})); };
  const bool steps_first = !search.problem().constraints.objective();
  if (steps_first)
    if (const EditPointPtr inside = landed(); inside || !search.goesOn()) return inside;
  const int following = std::min(kFollowingIterations, search.iterationsLeft() / 4);
  const EditPointPtr followed = insideOrNone(search, *start, followSequence(search, choice.from, choice.rows, following));
  return followed || steps_first || !search.goesOn() ? followed : landed();
}

/// The same where the start's impacts are to be kept, or preferred: by the solver, as if features had no edges, and then with
/// every point simulated. Trials may leave the sequence on the way, and where they end outside of it they show where to look.
EditPointPtr solveInSequence(EditSearch& search, const RowChoice& choice, const EditPointPtr& start) {
  const bool may_leave = search.options().sequence != SequencePolicy::stay;
  const int most = std::min(kKeepingIterations, search.iterationsLeft());
  const int iterations = may_leave ? most / 2 : most;
  const EditPointPtr followed = insideOrNone(search, *start, followSequence(search, choice.from, choice.rows, iterations / 2));
  if (followed || !search.goesOn()) return followed;
  return insideOrNone(search, *start, minimiseChange(search, choice.from, choice.rows, &start->signature, iterations));
}

/// The solver's own way within the sequence of the start, which takes long and seldom leads to a smaller change: where
/// only large ones are known.
void solveInSequenceAgain(EditSearch& search, const RowChoice& choice, const EditPointPtr& start,
                          SequenceSearch& across) {
  if (!(across.solutions().front()->objective > kLargeChange) || !search.goesOn()) return;
  const int iterations = std::min(kInsideIterations, search.iterationsLeft());
  const EditPointPtr inside = minimiseChange(search, choice.from, choice.rows, &start->signature, iterations);
  if (search.reached(*inside) && inside->signature == start->signature) across.add(inside);
}

/// Whether rows that the motion of the start lacks may be there in others: not those of times after its duration.
bool mayBecomeAvailable(const EditSearch& search) {
  const EditProblem& problem = search.problem();
  if (search.options().sequence == SequencePolicy::stay || problem.unknowns() == 0) return false;
  if (search.best()->motion.status == MotionStatus::step_limit) return false;
  const std::vector<Constraint>& held = problem.constraints.constraints();
  return std::none_of(held.begin(), held.end(), [&](const Constraint& c) {
    return !c.targets.empty() && c.at.isTime() && c.at.time > problem.duration;
  });
}

/// So many times the patience, by what the landings were expected to bring since the best was found.
double patienceBy(const ExpectedImprovement& expected, const Patience& patience) {
  return std::clamp(expected.mean() / ExpectedImprovement::kUsual, patience.least_expected, patience.most_expected);
}

/// A first solution, and then smaller changes, until none was found for too long.
void searchAcross(const EditSearch& search, SequenceSearch& across) {
  const SearchPlan& plan = planOf(search.options().effort);
  const Patience& patience = plan.patience;
  for (int rounds = plan.first_rounds; across.solutions().empty() && rounds > 0 && across.round(); --rounds) {
  }
  if (across.solutions().empty()) return;
  double found = search.work();
  for (int idle = 0; idle < kIdleRounds || search.work() < patience.unusual;) {
    const bool many = !across.isBestInside() && across.impactsOfBest() > kManyImpacts;
    const double multiple = many ? kPatienceForMany : 1;
    const double enough = patience.after(found, multiple * patienceBy(across.expected(), patience));
    const double before = across.solutions().front()->objective;
    const bool may_end = before <= kNoticedChange || search.work() >= patience.usual;
    if (may_end && idle >= multiple * patience.rounds && search.work() - found >= enough) return;
    if (idle >= plan.small_rounds && across.hasSmallChangeInside()) return;
    if (idle > 0 && across.isLong()) return;
    if (search.work() >= patience.in_all) return;
    if (!across.round()) return;
    ++idle;
    if (across.solutions().front()->objective < kClearlyLess * before) idle = 0, found = search.work(), across.expectAnew();
  }
}

/// Distinct solutions until there are as many as the options ask for, the smallest change first. One that turns out smaller
/// than the solution takes its place, where any impacts will do.
void takeMoreSolutions(EditSearch& search, SequenceSearch& across, EditSolution& solution) {
  across.add(solution.point);
  const auto enough = static_cast<std::size_t>(search.options().alternatives);
  while (across.solutions().size() < enough && across.round(SequenceSearch::Seek::others)) continue;
  across.polish(enough);
  solution.others = across.solutions();
  if (search.options().sequence != SequencePolicy::smallest) return;
  for (const EditPointPtr& other : solution.others) {
    if (!(other->objective < solution.point->objective)) return;
    const EditPointPtr point = polished(search, other);
    if (!search.reached(*point) || !isConfirmed(search, *point)) continue;
    solution.point = point;
    return;
  }
}

}  // namespace

EditSolution findSolution(EditSearch& search) {
  EditSolution solution;
  const EditPointPtr start = solution.start = solution.point = search.evaluateStart();
  if (!start->rows.available && search.options().stop.stop_requested()) {
    solution.status = EditStatus::cancelled;
    solution.message = "The edit was cancelled before the motion of its start was known.";
    return solution;
  }
  if (!start->rows.available && !mayBecomeAvailable(search)) {
    solution.status = EditStatus::bad_start;
    solution.message = start->rows.message;
    return solution;
  }
  if (search.reached(*start)) {
    solution.status = EditStatus::solved;
    return solution;
  }
  if (const std::string why = whyImpossible(search, *start); !why.empty()) {
    solution.status = EditStatus::infeasible;
    solution.message = why;
    return solution;
  }
  const bool may_leave = search.options().sequence != SequencePolicy::stay;
  const bool from_start = start->rows.available && search.differentiate(*start);
  const RowChoice choice = from_start ? chooseRows(search, start) : RowChoice{};
  const bool contradicts = !choice.contradiction.empty();  // in this impact sequence at least
  EditPointPtr inside;
  if (from_start && !contradicts) {
    solution.growth = growthOf(start->motion, search.problem(), start->rows);
    const bool any = search.options().sequence == SequencePolicy::smallest;
    inside = any ? stepsInSequence(search, choice, start) : solveInSequence(search, choice, start);
  }
  SequenceSearch across(search, start);
  if (inside) across.add(inside);
  EditPointPtr confirmed;
  for (int tries = kTries; !confirmed && tries > 0; --tries) {
    if (may_leave) searchAcross(search, across);
    if (across.solutions().empty()) break;
    const bool unsolved_inside = from_start && !contradicts && !inside;
    if (may_leave && unsolved_inside && tries == kTries) solveInSequenceAgain(search, choice, start, across);
    across.polishSmallest();
    confirmed = smallestConfirmed(search, across);
  }
  solution.point = confirmed ? confirmed : polished(search, search.best());
  if (!search.reached(*solution.point)) {
    solution = unsolved(search, std::move(solution));
    const EditPointPtr lacks = across.nearestLacking();
    if (lacks && !lacks->rows.available && !solution.point->rows.available)
      for (const std::string& said : {lacks->rows.message, describeApproach(search.problem(), *lacks)})
        if (solution.message.find(said) == std::string::npos) solution.message += " " + said;
    if (search.halt() == Halt::none) solution.contradiction = choice.contradiction;
    return solution;
  }
  solution.status = EditStatus::solved;
  if (may_leave && search.options().alternatives > 1) takeMoreSolutions(search, across, solution);
  return solution;
}

}  // namespace carom::editing_detail
