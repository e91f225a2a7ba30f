// SPDX-License-Identifier: MIT
#include "editing/strategy/least_squares_search.hpp"

#include <algorithm>

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

/// Fits the errors up to ever later times, each from the fit before: an early part has few impacts, and what it leaves of the
/// others is seldom more than steps can follow.
EditPointPtr growingFit(EditEvaluator& evaluator, EditPointPtr point) {
  std::vector<double> times;
  for (const Row& row : evaluator.problem().soft.set().rows()) {
    const When& at = evaluator.problem().soft.set().constraints()[static_cast<std::size_t>(row.constraint)].at;
    if (at.isTime() && !row.overSpan()) times.push_back(at.time);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const std::size_t parts = std::min(times.size(), kPartsOfFit);
  for (std::size_t k = 1; k < parts && evaluator.goesOn(); ++k)
    point = minimiseLeastSquares(evaluator, point, kStepsOfPart, times[times.size() * k / parts - 1]);
  return minimiseLeastSquares(evaluator, point, kStepsOfFit);
}

}  // namespace

EditPointPtr smallestSquares(EditEvaluator& evaluator, const EditPointPtr& from) {
  EditPointPtr best = minimiseLeastSquares(evaluator, from, kStepsOfFit);
  const EditPointPtr grown = growingFit(evaluator, from);
  if (grown->objective < best->objective) best = grown;
  const Effort effort = evaluator.options().effort;
  if (effort == Effort::fast) return best;
  for (const EditPointPtr& point : sampled(evaluator, *from, effort == Effort::thorough ? kThoroughFit : kNormalFit)) {
    const EditPointPtr end = minimiseLeastSquares(evaluator, point, kStepsOfSampledFit);
    if (end->objective < best->objective) best = end;
  }
  return minimiseLeastSquares(evaluator, best, kStepsOfFit);
}

}  // namespace carom::editing_detail
