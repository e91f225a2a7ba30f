// SPDX-License-Identifier: MIT
#include "editing/strategy/effort.hpp"

namespace carom::editing_detail {
namespace {

constexpr SearchPlan kFast{.first_rounds = 10,
                           .improving_rounds = 0,
                           .idle_rounds = 1,
                           .idle_rounds_of_many = 1,
                           .first_steps = 7e3,
                           .improving_steps = 1e4,
                           .least_samples = 40,
                           .most_samples = 2048,
                           .landings = 8,
                           .minimised = 2};
constexpr SearchPlan kNormal{.first_rounds = 10,
                             .improving_rounds = 24,
                             .idle_rounds = 4,
                             .idle_rounds_of_many = 10,
                             .first_steps = 1e4,
                             .improving_steps = 2.5e3,
                             .least_samples = 24,
                             .most_samples = 4096,
                             .landings = 20,
                             .minimised = 3};
constexpr SearchPlan kThorough{.first_rounds = 16,
                               .improving_rounds = 24,
                               .idle_rounds = 6,
                               .idle_rounds_of_many = 10,
                               .first_steps = 4e4,
                               .improving_steps = 1e5,
                               .least_samples = 256,
                               .most_samples = 8192,
                               .landings = 60,
                               .minimised = 8};

}  // namespace

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
