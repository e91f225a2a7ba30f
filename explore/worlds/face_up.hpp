// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "adjoint/motion/motion.h"

namespace carom::explore_detail {

/// Which face of a box looks up at the end of a motion, as in WorldTable::face.
std::uint8_t faceUp(const Motion& motion, int body);

}  // namespace carom::explore_detail
