// SPDX-License-Identifier: MIT
#include "editing/shooting/multiple_shooting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/numeric/elementary.hpp"
#include "editing/shooting/growth.h"
#include "editing/shooting/shooting_program.h"
#include "editing/solve/edit_solution.h"
#include "editing/solve/ipopt_solver.h"
#include "editing/solve/projection.h"
#include "editing/text.h"

namespace carom {
namespace {

constexpr int kShootingPolishSteps = 15;
/// From about this growth on segments were seen to solve more places than the whole motion (docs/editing.md).
constexpr double kLongMotion = 100;
/// Segments are made so long that small changes grow by about this factor over each.
constexpr double kGrowthOfSegment = 10;
/// Of the states at nodes, in natural scales: the whole motion multiplies what is left by its growth.
constexpr double kNodeTolerance = 1e-11;

int impactsOfSegment(int impacts, double growth) {
  const double of_one = elementary::log(std::max(growth, 1.0)) / std::max(impacts, 1);
  const double enough = of_one > 0 ? elementary::log(kGrowthOfSegment) / of_one : impacts;
  return std::max(1, static_cast<int>(std::min(enough, 0.5 * impacts)));
}

SolverResult solveProgram(EditSearch& search, ShootingProgram& program, int max_iterations) {
  SolverOptions options;
  options.max_iterations = max_iterations;
  options.tolerance = 1e-8;
  options.constraint_tolerance = kNodeTolerance;
  options.deadline = search.deadline();
  return solveWithIpopt(program, options);
}

/// The motion that the controls of a solution really have, brought onto the constraints.
EditPointPtr wholeMotion(EditSearch& search, const EditPoint& from, const SolverResult& result) {
  const EditPointPtr point = search.evaluate(result.x.head(search.problem().unknowns()));
  return point ? projectOntoConstraints(search, point, kShootingPolishSteps, &from.signature) : nullptr;
}

}  // namespace

bool wantsSegments(const EditSearch& search, const EditPoint& start, ShootingReport& report) {
  const Shooting shooting = search.options().shooting;
  if (shooting == Shooting::single) return false;
  report.growth = growthOf(start.motion, search.problem(), start.rows);
  return shooting == Shooting::multiple || report.growth >= kLongMotion;
}

EditPointPtr shootInSegments(EditSearch& search, const EditPointPtr& from, const std::vector<int>& rows,
                             int max_iterations, ShootingReport& report) {
  const EditProblem& problem = search.problem();
  const int impacts = impactsThatMatter(problem, from->motion, from->rows.times);
  const Cut cut = cutMotion(problem, from->motion, from->rows.times, impactsOfSegment(impacts, report.growth));
  if (cut.nodes.empty()) {
    report.why_not = "There is no flight between two impacts before the constraints where the motion could be cut.";
    return nullptr;
  }
  const Segments segments = makeSegments(problem, *from, cut);
  if (segments.segments.empty()) {
    report.why_not = segments.why_not;
    return nullptr;
  }
  report.segments = static_cast<int>(segments.segments.size());
  ShootingProgram program(search, *from, segments, rows);
  const SolverResult result = solveProgram(search, program, max_iterations);
  EditPointPtr point = wholeMotion(search, *from, result);
  report.solved = point && search.reached(*point);
  // Where an impact stands against a node at a fixed time the change may not be the smallest yet.
  if (report.solved && result.status != SolverStatus::converged)
    point = minimiseWithin(search, point, search.iterationsLeft());
  return point;
}

std::string describe(const ShootingReport& report, const EditOptions& options, bool solved) {
  if (options.shooting == Shooting::multiple && !report.why_not.empty()) return report.why_not + " It was taken whole.";
  const std::string growth = "Small changes grow " + number(report.growth) + "-fold up to the constraints";
  if (report.solved && solved) return growth + "; solved in " + std::to_string(report.segments) + " segments.";
  const double rounding = report.growth * std::numeric_limits<double>::epsilon();
  if (!solved && rounding > options.tolerance)
    return growth + ", so that rounding alone moves them by " + number(rounding) + " of the natural scales.";
  if (!solved && report.segments > 0) return growth + ".";
  return "";
}

}  // namespace carom
