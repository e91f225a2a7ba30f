// SPDX-License-Identifier: MIT
#include "editing/strategy/landing_score.hpp"

#include <algorithm>

#include "adjoint/numeric/elementary.hpp"

namespace carom::editing_detail {
namespace {

/// Nearer to the constraints, or by a shorter step, is as good as there.
constexpr double kNear = 1e-3;

}  // namespace

double landingScore(const Prospect& prospect, double below) {
  const double near = std::max(prospect.violation, kNear) * std::max(prospect.step / below, kNear);
  return elementary::pow(near, 0.25) * elementary::exp(std::max(0.0, prospect.change / below - 1));
}

void ExpectedImprovement::add(const Prospect& prospect, double below) {
  const double score = landingScore(prospect, below);
  if (!(score <= kLikelyScore)) return;
  const double change = std::max(prospect.change / below, kNear);
  sum_ += elementary::exp(-score) * std::max(0.0, -elementary::log(change));
  ++count_;
}

}  // namespace carom::editing_detail
