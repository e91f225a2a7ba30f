// SPDX-License-Identifier: MIT
#include "editing/strategy/local_solve_score.hpp"

#include <algorithm>

#include "adjoint/numeric/elementary.hpp"

namespace carom::editing_detail {
namespace {

/// Nearer to the constraints, or by a shorter step, is as good as there.
constexpr double kNear = 1e-3;

}  // namespace

double localSolveScore(const LocalSolveEstimate& estimate, double below) {
  const double near = std::max(estimate.violation, kNear) * std::max(estimate.step / below, kNear);
  return elementary::pow(near, 0.25) * elementary::exp(std::max(0.0, estimate.change / below - 1));
}

void ExpectedImprovement::add(const LocalSolveEstimate& estimate, double below) {
  const double score = localSolveScore(estimate, below);
  if (!(score <= kLikelyScore)) return;
  const double change = std::max(estimate.change / below, kNear);
  sum_ += elementary::exp(-score) * std::max(0.0, -elementary::log(change));
  ++count_;
}

}  // namespace carom::editing_detail
