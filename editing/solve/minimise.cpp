// SPDX-License-Identifier: MIT
#include "editing/solve/minimise.hpp"

#include <algorithm>
#include <cmath>

#include "editing/solve/dependence.hpp"
#include "editing/solve/edit_program.hpp"
#include "editing/solve/ipopt_solver.hpp"
#include "editing/solve/projection.hpp"

namespace carom::editing_detail {
namespace {

constexpr double kOptimality = 1e-8, kLeastTolerance = 1e-10;
/// Of an objective of one's own: rounds in which it falls by more than this share, each of so many iterations.
constexpr int kLoweringRounds = 8, kLoweringIterations = 100;
constexpr double kLowers = 1e-9;

}  // namespace

EditPointPtr minimiseChange(EditEvaluator& evaluator, const EditPointPtr& from, const std::vector<int>& rows,
                            const std::string* signature, int max_iterations) {
  if (max_iterations <= 0) return from;
  // From a point that meets the constraints the solver has only the change left to minimise.
  const EditPointPtr projected = projectOntoConstraints(evaluator, from, kOntoSteps, signature);
  const EditPointPtr start = evaluator.reached(*projected) ? projected : from;
  EditProgram program(evaluator, start->changes, rows, signature);
  SolverOptions options;
  options.max_iterations = max_iterations;
  options.tolerance = kOptimality;
  options.constraint_tolerance = std::max(evaluator.options().tolerance, kLeastTolerance);
  const SolverResult result = solveWithIpopt(program, options);
  EditPointPtr end = evaluator.evaluate(result.x);
  if (!end || (signature && end->signature != *signature)) return start;
  end = projectOntoConstraints(evaluator, end, kOntoSteps, signature);
  const bool worse = evaluator.reached(*start) && (!evaluator.reached(*end) || end->objective > start->objective);
  return worse ? start : end;
}

EditPointPtr followSequence(EditEvaluator& evaluator, const EditPointPtr& from, const std::vector<int>& rows,
                            int max_iterations) {
  EditEvaluator smooth = evaluator.branch({{}, from}, false);
  const EditPointPtr end = minimiseChange(smooth, from, rows, nullptr, max_iterations);
  evaluator.adopt(smooth);
  const EditPointPtr real = evaluator.make(end->changes, false, {{nullptr, true}});
  if (real) evaluator.consider(real);
  return real;
}

EditPointPtr lowerObjective(EditEvaluator& evaluator, EditPointPtr point) {
  for (int round = 0; round < kLoweringRounds && evaluator.goesOn(); ++round) {
    if (!evaluator.differentiate(*point)) break;
    const RowSplit split = splitRows(*point->row_jacobian, evaluator.problem().constraints.equations());
    const double before = point->objective, enough = before - kLowers * (1 + std::abs(before));
    const auto takeIfLower = [&](const EditPointPtr& end) {
      if (end && evaluator.reached(*end) && end->objective < point->objective) point = end;
    };
    const EditPointPtr from = point;
    takeIfLower(minimiseWithin(evaluator, from, kLoweringIterations));
    takeIfLower(followSequence(evaluator, from, split.independent, std::min(kLoweringIterations, evaluator.iterationsLeft())));
    if (!(point->objective < enough)) break;
  }
  return point;
}

EditPointPtr minimiseWithin(EditEvaluator& evaluator, const EditPointPtr& point, int max_iterations) {
  if (!evaluator.differentiate(*point)) return point;
  const RowSplit split = splitRows(*point->row_jacobian, evaluator.problem().constraints.equations());
  return minimiseChange(evaluator, point, split.independent, &point->signature,
                        std::min(max_iterations, evaluator.iterationsLeft()));
}

}  // namespace carom::editing_detail
