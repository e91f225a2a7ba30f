// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_path_values.hpp"

namespace carom::adjoint_detail {

std::optional<std::pair<State, double>> ConstrainedPath::beyondEnd() const {
  if (!end_ || (end_->guard.cause != TransitionCause::slips && end_->guard.cause != TransitionCause::lifts)) return std::nullopt;
  const std::size_t which = indexOf(guards_, end_->guard);
  ConstrainedStepper stepper(scene_, contacts_, redundant_);
  const ConstrainedStepper::Start start{last_, known_, slipAfter(), std::vector<char>(contacts_.size(), 0)};
  const auto step = stepBeyond<ConstrainedStep>(stepper, start, scene_.length / scene_.speed,
                                                [&](const ConstrainedStep& of, double t) { return Values(*this, of).at(t)[which]; });
  if (!step) return std::nullopt;
  const double later = step->start + step->length;
  return std::pair(step->stateAt(later), later);
}

}  // namespace carom::adjoint_detail
