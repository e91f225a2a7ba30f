#include "editing/edit_solution.h"

#include <algorithm>
#include <cmath>

#include "editing/dependence.h"
#include "editing/edit_program.h"
#include "editing/ipopt_solver.h"
#include "editing/row_choice.h"
#include "editing/sequence_search.h"
#include "editing/text.h"

namespace carom {
namespace {

constexpr int kProjectionSteps = 15;
constexpr int kCrossingSteps = 40;
constexpr int kPolishSteps = 15;

/// The best point, once more brought as near to the constraints as rounding allows, within its own impact sequence.
EditPointPtr polished(EditSearch& search) {
  const EditPointPtr best = search.best();
  return projectOntoConstraints(search, best, kPolishSteps, &best->signature);
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
  } else if (isStuck(search, *solution.point)) {
    solution.status = EditStatus::infeasible;
    solution.message = "No way was found to meet all constraints" + where + " with these controls. " + nearest;
  } else {
    solution.status = EditStatus::not_converged;
    solution.message = "The search ended after " + std::to_string(search.iterations()) +
                       " iterations without meeting the constraints" + where + ". " + nearest;
  }
  return solution;
}

}  // namespace

EditPointPtr minimiseChange(EditSearch& search, const EditPointPtr& from, const std::vector<int>& rows,
                            const std::string* signature, int max_iterations) {
  if (max_iterations <= 0) return from;
  // From a point that meets the constraints the solver has only the change left to minimise.
  const EditPointPtr projected = projectOntoConstraints(search, from, kProjectionSteps, signature);
  const EditPointPtr start = search.reached(*projected) ? projected : from;
  EditProgram program(search, start->changes, rows, signature);
  SolverOptions options;
  options.max_iterations = max_iterations;
  options.tolerance = 1e-8;
  options.constraint_tolerance = std::max(search.options().tolerance, 1e-10);
  options.deadline = search.deadline();
  const SolverResult result = solveWithIpopt(program, options);
  EditPointPtr end = search.evaluate(result.x);
  if (!end || (signature && end->signature != *signature)) return start;
  end = projectOntoConstraints(search, end, kPolishSteps, signature);
  const bool worse = search.reached(*start) && (!search.reached(*end) || end->objective > start->objective);
  return worse ? start : end;
}

EditPointPtr followSequence(EditSearch& search, const EditPointPtr& from, const std::vector<int>& rows,
                            int max_iterations) {
  EditSearch smooth = search.branch({nullptr, from}, false);
  const EditPointPtr end = minimiseChange(smooth, from, rows, nullptr, max_iterations);
  search.adopt(smooth);
  return search.evaluate(end->changes);
}

EditPointPtr minimiseWithin(EditSearch& search, const EditPointPtr& point, int max_iterations) {
  search.differentiate(*point);
  const RowSplit split = splitRows(*point->row_jacobian, search.problem().constraints.equations());
  return minimiseChange(search, point, split.independent, &point->signature,
                        std::min(max_iterations, search.iterationsLeft()));
}

namespace {

/// The smallest change within the impact sequence of the start.
void solveInSequence(EditSearch& search, const RowChoice& choice, const EditPointPtr& start, int iterations) {
  static const char* e = getenv("CAROM_EXP");
  const std::string x = e ? e : "";
  if (x.find('f') != std::string::npos) {
    const EditPointPtr followed = followSequence(search, choice.from, choice.rows, iterations);
    if (search.reached() || !search.goesOn()) return;
  }
  if (x.find('n') != std::string::npos) return;
  minimiseChange(search, choice.from, choice.rows, &start->signature, iterations);
}

/// Solutions of other impact sequences, until there is one, or as many as are asked for.
std::vector<EditPointPtr> solveAcross(EditSearch& search, const EditPointPtr& start) {
  SequenceSearch across(search, start);
  const auto wanted = static_cast<std::size_t>(std::max(1, search.options().alternatives));
  if (search.reached()) across.add(search.best());
  while (across.solutions().size() < wanted && across.round()) continue;
  return across.solutions();
}

}  // namespace

EditSolution findSolution(EditSearch& search) {
  EditSolution solution;
  const EditPointPtr start = solution.start = solution.point = search.evaluateStart();
  if (!start->rows.available) {
    solution.status = EditStatus::bad_start;
    solution.message = start->rows.message;
    return solution;
  }
  if (search.reached(*start)) {
    solution.status = EditStatus::solved;
    return solution;
  }
  const RowChoice choice = chooseRows(search, start);
  if (!choice.contradiction.empty()) {
    solution.status = EditStatus::infeasible;
    solution.message = choice.contradiction;
    return solution;
  }

  const bool may_leave = search.options().sequence != SequencePolicy::stay;
  const int share = may_leave ? search.iterationsLeft() / 2 : search.iterationsLeft();
  solveInSequence(search, choice, start, share);
  if (may_leave && (!search.reached() || search.options().alternatives > 1))
    solution.others = solveAcross(search, start);

  solution.point = search.halt() == Halt::none ? polished(search) : search.best();
  if (!search.reached(*solution.point)) return unsolved(search, std::move(solution));
  solution.status = EditStatus::solved;
  return solution;
}

}  // namespace carom
