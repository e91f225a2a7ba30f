// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_path_values.hpp"
#include "adjoint/constrained/path_limits.hpp"

namespace carom::adjoint_detail {

std::optional<std::pair<State, double>> ConstrainedPath::beyondEnd() const {
  if (!end_ || (end_->guard.cause != TransitionCause::slips && end_->guard.cause != TransitionCause::lifts)) return std::nullopt;
  const std::size_t which = indexOf(end_->guard);
  ConstrainedStepper stepper(scene_, contacts_, redundant_);
  const ConstrainedStepper::Start start{last_, known_, slipAfter(), std::vector<char>(contacts_.size(), 0)};
  for (const double share : PathLimits::kFurther) {
    const std::optional<ConstrainedStep> step = stepper.tried(start, share * scene_.length / scene_.speed, nullptr);
    if (!step) return std::nullopt;
    const double later = step->start + step->length;
    if (Values(*this, *step).at(later)[which] < -PathLimits::kClearlyBeyond) return std::pair(step->stateAt(later), later);
  }
  return std::nullopt;
}

}  // namespace carom::adjoint_detail
