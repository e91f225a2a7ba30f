// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// The fixed bodies of an event that touch each other where a body goes over from one to the other, or is in contact with
/// both in one plane. Moved alone, one of them makes a step of the seam.
std::vector<int> flushBodiesOf(const Motion& motion, const Event& event);

}  // namespace carom::adjoint_detail
