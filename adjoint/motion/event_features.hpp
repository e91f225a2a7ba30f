// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

namespace carom {

struct Event;

namespace adjoint_detail {

/// Bodies and features of an event's contacts, sorted: those of one instant have no order, as rounding decides which
/// of them is found first.
std::vector<std::array<int, 6>> sortedFeatures(const Event& event);

}  // namespace adjoint_detail
}  // namespace carom
