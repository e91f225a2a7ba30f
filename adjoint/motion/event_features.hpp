// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Bodies and features of an event's contacts, sorted: those of one instant have no order, as rounding decides which
/// of them is found first.
std::vector<std::array<int, 6>> sortedFeatures(const Event& event);

}  // namespace carom::adjoint_detail
