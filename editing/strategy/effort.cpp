// SPDX-License-Identifier: MIT
#include "editing/strategy/effort.hpp"
#include <cstdlib>

namespace carom::editing_detail {
namespace {

constexpr SearchPlan kFast{.first_rounds = 8,
                           .improving_rounds = 0,
                           .idle_rounds = 1,
                           .first_steps = 1e4,
                             .improving_steps = 2e4,
                           .least_samples = 64,
                           .most_samples = 1024,
                           .landings = 8,
                           .minimised = 2};
static double envOr(const char* n, double d) { const char* e = getenv(n); return e ? atof(e) : d; }
static SearchPlan kNormal{.first_rounds = 10,
                             .improving_rounds = (int)envOr("IR", 6),
                             .idle_rounds = (int)envOr("ID", 2),
                             .first_steps = envOr("FS", 1e4),
                             .improving_steps = envOr("IS", 1.5e4),
                             .least_samples = (int)envOr("LS", 48),
                             .most_samples = 4096,
                             .landings = (size_t)envOr("LA", 20),
                             .minimised = 3};
constexpr SearchPlan kThorough{.first_rounds = 16,
                               .improving_rounds = 12,
                               .idle_rounds = 4,
                               .first_steps = 4e4,
                             .improving_steps = 4e5,
                               .least_samples = 256,
                               .most_samples = 4096,
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
