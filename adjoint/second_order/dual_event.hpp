// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/event_pass.hpp"
#include "adjoint/second_order/lanes.hpp"

namespace carom::adjoint_detail {

/// One event, linearised, in dual numbers: what EventLinearization is in doubles.
struct DualEvent {
  std::vector<DualState> before;  ///< of the participants
  EventPass<Num> pass;
};
DualEvent dualEvent(const Lanes& lanes, int event);

}  // namespace carom::adjoint_detail
