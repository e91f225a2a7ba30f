// SPDX-License-Identifier: MIT
#include "editing/strategy/edit_solution.hpp"

#include <algorithm>
#include <cmath>

#include "editing/detail/messages.hpp"
#include "editing/problem/growth.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/solve/minimise.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/row_choice.hpp"
#include "editing/strategy/sequence_search.hpp"

namespace carom::editing_detail {
namespace {

/// Rounds of the search across impact sequences.
constexpr int kRounds = 6;
/// More of them after the first solution, for smaller ones.
constexpr int kRoundsToImprove = 2;
/// Of the objective: a fifth of a natural scale.
constexpr double kLargeChange = 0.02;
/// Rounds when the constraints stand against each other in the sequence of the start: mostly they do so in all.
constexpr int kRoundsAgainstContradiction = 2;

/// A point once more brought as near to the constraints as rounding allows, within its own impact sequence.
EditPointPtr polished(EditSearch& search, const EditPointPtr& point) {
  if (search.halt() != Halt::none) return point;
  return projectOntoConstraints(search, point, kOntoSteps, &point->signature);
}

/// "position.x of 'hat' at 1.4 s by 0.02 and ..."
std::string unmetRows(const EditSearch& search, const EditPoint& point) {
  std::vector<std::string> unmet;
  for (int i = 0; i < search.problem().constraints.size(); ++i) {
    if (std::abs(point.rows.scaled[i]) <= search.options().tolerance) continue;
    unmet.push_back(search.problem().constraints.describeRow(i) + " by " + number(point.rows.residuals[i]));
  }
  return listOf(unmet);
}

/// Whether even the linearised rows cannot be brought much nearer to their targets from here.
bool isStuck(EditSearch& search, EditPoint& point) {
  search.differentiate(point);
  const double before = point.rows.scaled.norm();
  const double after = residualsAfter(search, point, smallestStep(search, point)).norm();
  return !(after < 0.5 * before);
}

EditSolution unsolved(EditSearch& search, EditSolution solution) {
  const std::string nearest = "The nearest that was found misses " + unmetRows(search, *solution.point) + ".";
  const bool stays = search.options().sequence == SequencePolicy::stay;
  const std::string where = stays ? " within the impact sequence of the start" : "";
  if (search.halt() == Halt::out_of_time) {
    solution.status = EditStatus::out_of_time;
    solution.message = "The time budget ran out before the constraints were met. " + nearest;
  } else if (search.halt() == Halt::cancelled) {
    solution.status = EditStatus::cancelled;
    solution.message = "The edit was cancelled before the constraints were met. " + nearest;
  } else if (search.iterationsLeft() > 0 && isStuck(search, *solution.point)) {
    solution.status = EditStatus::infeasible;
    solution.message = "No way was found to meet all constraints" + where + " with these controls. " + nearest;
  } else {
    solution.status = EditStatus::not_converged;
    const std::string limit = search.iterationsLeft() > 0 ? "" : ", its limit,";
    solution.message = "The search ended after " + std::to_string(search.iterations()) + " iterations" + limit +
                       " without meeting the constraints" + where + ". " + nearest;
  }
  return solution;
}

/// The smallest change within the impact sequence of the start; null where none was found. First as if its features had
/// no edges: trials may leave the sequence on the way, and where they end outside of it they show where to look.
EditPointPtr solveInSequence(EditSearch& search, const RowChoice& choice, const EditPointPtr& start) {
  const bool may_leave = search.options().sequence != SequencePolicy::stay;
  const int iterations = may_leave ? search.iterationsLeft() / 2 : search.iterationsLeft();
  const auto solves = [&](const EditPointPtr& point) {
    return point && search.reached(*point) && point->signature == start->signature;
  };
  const EditPointPtr followed = followSequence(search, choice.from, choice.rows, iterations / 2);
  if (solves(followed)) return followed;
  if (!search.goesOn()) return nullptr;
  const EditPointPtr inside = minimiseChange(search, choice.from, choice.rows, &start->signature, iterations);
  return solves(inside) ? inside : nullptr;
}

/// Distinct solutions until there are as many as the options ask for, the smallest change first.
std::vector<EditPointPtr> moreSolutions(const EditSearch& search, SequenceSearch& across, const EditPointPtr& first) {
  across.add(first);
  while (static_cast<int>(across.solutions().size()) < search.options().alternatives && across.round()) continue;
  return across.solutions();
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
  if (!start->rows.available) {
    solution.status = EditStatus::bad_start;
    solution.message = start->rows.message;
    return solution;
  }
  if (search.reached(*start)) {
    solution.status = EditStatus::solved;
    return solution;
  }
  const bool may_leave = search.options().sequence != SequencePolicy::stay;
  const RowChoice choice = chooseRows(search, start);
  const bool contradicts = !choice.contradiction.empty();  // in this impact sequence at least
  if (!contradicts) solution.growth = growthOf(start->motion, search.problem(), start->rows);
  const EditPointPtr inside = contradicts ? nullptr : solveInSequence(search, choice, start);
  SequenceSearch across(search, start);
  for (int rounds = contradicts ? kRoundsAgainstContradiction : kRounds;
       may_leave && !inside && rounds > 0 && across.solutions().empty() && across.round(); --rounds) {
  }
  // The first that is found across sequences is seldom the smallest, nor is a large change within one.
  const bool large = inside && inside->objective > kLargeChange;
  if (large) across.add(inside);
  const auto seek = large ? SequenceSearch::Seek::smaller_inside : SequenceSearch::Seek::smaller;
  for (int rounds = kRoundsToImprove; !across.solutions().empty() && rounds > 0 && across.round(seek); --rounds) {
  }

  solution.point = polished(search, large ? across.solutions().front() : inside ? inside : search.best());
  if (!search.reached(*solution.point)) {
    if (contradicts && search.halt() == Halt::none) {
      solution.status = EditStatus::infeasible;
      solution.message = choice.contradiction;
      return solution;
    }
    return unsolved(search, std::move(solution));
  }
  solution.status = EditStatus::solved;
  if (may_leave && search.options().alternatives > 1) solution.others = moreSolutions(search, across, solution.point);
  return solution;
}

}  // namespace carom::editing_detail
