// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"
#include "bench/edits/dice.h"
#include "bench/edits/wanted.h"
#include "editing/constraint.h"

namespace carom::bench {

/// Constraints that a motion meets exactly, the last of them after `wanted.impacts` impacts (or at the last of those).
/// Empty where the motion has too few impacts, or impacts too close to one another.
std::vector<Constraint> drawGoal(const Motion& hidden, const Wanted& wanted, Dice& dice);

}  // namespace carom::bench
