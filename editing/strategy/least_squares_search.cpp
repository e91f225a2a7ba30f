// SPDX-License-Identifier: MIT
#include "editing/strategy/least_squares_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/decompositions.hpp"
#include "editing/solve/least_squares.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/samples.hpp"

namespace carom::editing_detail {
namespace {

/// Samples and how many of them are followed, by effort; steps of each, and of the best one to its end.
struct FitPlan {
  int samples, followed;
};
constexpr FitPlan kNormalFit{64, 4}, kThoroughFit{512, 16};
constexpr int kStepsOfSampledFit = 12, kStepsOfFit = 200;
/// Parts of a recording that are fitted one after the other, and steps of each.
constexpr std::size_t kPartsOfFit = 16;
constexpr int kStepsOfPart = 10;
/// Points drawn around the best fit to the part before, their lengths in standard deviations, how many of them are followed,
/// and fits that are kept from part to part.
constexpr int kDrawn = 12;
constexpr double kDrawnLengths[] = {1, 0.5, 2};
constexpr std::size_t kFollowedDrawn = 3, kKeptFits = 3;
/// Errors are not taken for smaller than this, in natural scales over weights.
constexpr double kLeastSpread = 1e-6;
/// Steps of a sample onto the hard constraints.
constexpr int kOntoHard = 8;

/// The best of the samples that meet the hard constraints, the smallest objective first.
std::vector<EditPointPtr> sampled(EditEvaluator& evaluator, const EditPoint& centre, const FitPlan& plan) {
  std::vector<EditPointPtr> points;
  for (const Eigen::VectorXd& y : samples(centre.changes, {}, evaluator.lower(), evaluator.upper(),
                                          evaluator.options().seed * plan.samples, plan.samples)) {
    if (!evaluator.goesOn()) break;
    EditPointPtr point = evaluator.evaluate(y);
    if (point && !evaluator.reached(*point)) point = projectOntoConstraints(evaluator, point, kOntoHard, nullptr, Care::coarse);
    if (point && evaluator.reached(*point)) points.push_back(point);
  }
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a->objective < b->objective; });
  points.resize(std::min(points.size(), static_cast<std::size_t>(plan.followed)));
  return points;
}

/// The times up to which errors read the motion, each once.
std::vector<double> recordedTimes(const ConstraintSet& soft) {
  std::vector<double> times;
  for (const Row& row : soft.rows()) {
    const When& at = soft.constraints()[static_cast<std::size_t>(row.constraint)].at;
    if (const auto last = recordedUntil(row, at)) times.push_back(*last);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Points as likely as a fit up to `until` leaves them: what it does not determine varies by a natural scale.
std::vector<Eigen::VectorXd> drawnFrom(const EditEvaluator& evaluator, EditPoint& fit, double until, int first) {
  const EditProblem& problem = evaluator.problem();
  const Eigen::Index n = problem.controls.size();
  const LeastSquaresModel model = leastSquaresModel(problem, fit, {}, until);
  const double spread = std::sqrt(model.r.squaredNorm() / std::max<Eigen::Index>(1, model.r.size() - n));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(model.S.rows() + n, n);
  A.topRows(model.S.rows()) = model.S.leftCols(n) / std::max(spread, kLeastSpread);
  for (Eigen::Index j = 0; j < n; ++j) {
    const int control = problem.controls.variables()[static_cast<std::size_t>(j)].control;
    A(model.S.rows() + j, j) = 1 / problem.controls.controls()[static_cast<std::size_t>(control)].control.weight;
  }
  const adjoint_detail::ThinSvd svd(A);
  const EvenPoints directions(n);
  std::vector<Eigen::VectorXd> points;
  for (int k = 0; k < kDrawn; ++k) {
    const double length = kDrawnLengths[static_cast<std::size_t>(k) % std::size(kDrawnLengths)] * std::sqrt(static_cast<double>(n));
    Eigen::VectorXd y = fit.changes;
    y.head(n) += length * (svd.V * directions.onSphere(first + k).cwiseQuotient(svd.s));
    points.push_back(y.cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper()));
  }
  return points;
}

struct PartFit {
  EditPointPtr point;
  double objective;
};

/// The best few of points, by the errors up to `until`, each fitted to them.
std::vector<PartFit> fitted(EditEvaluator& evaluator, const std::vector<EditPointPtr>& points, double until) {
  std::vector<PartFit> fits;
  for (const EditPointPtr& point : points) {
    const EditPointPtr end = minimiseLeastSquares(evaluator, point, kStepsOfPart, until);
    fits.push_back({end, objectiveUntil(until, evaluator.problem(), *end)});
  }
  std::stable_sort(fits.begin(), fits.end(), [](const PartFit& a, const PartFit& b) { return a.objective < b.objective; });
  fits.resize(std::min(fits.size(), kKeptFits));
  return fits;
}

/// Those of the drawn points that fit the errors up to `until` best.
std::vector<EditPointPtr> bestDrawn(EditEvaluator& evaluator, EditPoint& fit, double before, double until, int first) {
  std::vector<PartFit> drawn;
  for (const Eigen::VectorXd& y : drawnFrom(evaluator, fit, before, first)) {
    if (!evaluator.goesOn()) break;
    const EditPointPtr point = evaluator.evaluate(y);
    if (point && evaluator.reached(*point)) drawn.push_back({point, objectiveUntil(until, evaluator.problem(), *point)});
  }
  std::stable_sort(drawn.begin(), drawn.end(), [](const PartFit& a, const PartFit& b) { return a.objective < b.objective; });
  std::vector<EditPointPtr> best;
  for (std::size_t k = 0; k < std::min(drawn.size(), kFollowedDrawn); ++k) best.push_back(drawn[k].point);
  return best;
}

/// Fits the errors up to ever later times, from the best few fits to the part before and from what that leaves likely: an early
/// part has few impacts, and each part adds few.
EditPointPtr growingFit(EditEvaluator& evaluator, const EditPointPtr& from) {
  const std::vector<double> times = recordedTimes(evaluator.problem().soft.set());
  const std::size_t parts = std::min(times.size(), kPartsOfFit);
  const bool draws = evaluator.options().effort != Effort::fast;
  std::vector<EditPointPtr> points{from};
  double before = 0;
  for (std::size_t k = 1; k <= parts && evaluator.goesOn(); ++k) {
    const double until = k < parts ? times[times.size() * k / parts - 1] : std::numeric_limits<double>::infinity();
    if (draws && k > 1)
      for (const EditPointPtr& drawn : bestDrawn(evaluator, *points.front(), before, until, static_cast<int>(k) * kDrawn))
        points.push_back(drawn);
    const std::vector<PartFit> fits = fitted(evaluator, points, until);
    points.clear();
    for (const PartFit& fit : fits) points.push_back(fit.point);
    before = until;
  }
  return minimiseLeastSquares(evaluator, points.front(), kStepsOfFit);
}

}  // namespace

EditPointPtr smallestSquares(EditEvaluator& evaluator, const EditPointPtr& from) {
  EditPointPtr best = minimiseLeastSquares(evaluator, from, kStepsOfFit);
  try {
    const EditPointPtr grown = growingFit(evaluator, from);
    if (grown->objective < best->objective) best = grown;
  } catch (const NotComputable&) {  // without derivatives nothing can be drawn
  }
  const Effort effort = evaluator.options().effort;
  if (effort == Effort::fast) return best;
  for (const EditPointPtr& point : sampled(evaluator, *from, effort == Effort::thorough ? kThoroughFit : kNormalFit)) {
    const EditPointPtr end = minimiseLeastSquares(evaluator, point, kStepsOfSampledFit);
    if (end->objective < best->objective) best = end;
  }
  return minimiseLeastSquares(evaluator, best, kStepsOfFit);
}

}  // namespace carom::editing_detail
