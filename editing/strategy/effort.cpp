// SPDX-License-Identifier: MIT
#include "editing/strategy/effort.hpp"

#include <algorithm>

namespace carom::editing_detail {
namespace {

constexpr SearchPlan kFast{.first_rounds = 10,
                           .stopping = {.least = 0, .whole = 1, .largest_share = 0, .most = 0, .rounds = 0},
                           .small_rounds = 0,
                           .first_steps = 7e3,
                           .improving_steps = 1e4,
                           .least_samples = 40,
                           .most_samples = 2048,
                           .local_solves = 8,
                           .minimised = 2,
                           .first_ends = true};
constexpr SearchPlan kNormal{.first_rounds = 10,
                             .stopping = {.least = 2e4, .whole = 2.4e4, .largest_share = 4, .most = 2.7e6, .usual = 1.3e5,
                                          .unusual = 7e5, .rounds = 4, .least_expected = 0.25, .most_expected = 4, .in_all = 6.5e6},
                             .small_rounds = 3,
                             .first_steps = 1e4,
                             .improving_steps = 2.5e3,
                             .unusual_multiple = 4,
                             .least_samples = 24,
                             .most_samples = 4096,
                             .local_solves = 20,
                             .minimised = 3};
constexpr SearchPlan kThorough{.first_rounds = 16,
                               .stopping = {.least = 6e5, .whole = 1.8e4, .largest_share = 4, .most = 2e7, .rounds = 4, .most_expected = 2},
                               .small_rounds = 30,
                               .first_steps = 4e4,
                               .improving_steps = 1e5,
                               .least_samples = 256,
                               .most_samples = 8192,
                               .local_solves = 60,
                               .minimised = 8};

}  // namespace

double StoppingRule::allowance(double found, double factor) const {
  const double allowance = factor * (least + found * std::min(largest_share, found / whole));
  return std::min(most, found + allowance > usual ? std::max(allowance, unusual - found) : allowance);
}

const SearchPlan& planOf(Effort effort) {
  switch (effort) {
    case Effort::fast:
      return kFast;
    case Effort::normal:
      return kNormal;
    case Effort::thorough:
      return kThorough;
  }
  return kNormal;
}

}  // namespace carom::editing_detail
