// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bench/edits/dice.h"
#include "editing/control.h"

namespace carom::bench {

inline constexpr int kFewestNumbers = 3, kMostNumbers = 30;

/// Random controls of 3 to 30 numbers, among them always some of the velocity of "thrown"; of the other kinds all but
/// size and gravity. Some have bounds, a weight, or only some of their components.
std::vector<Control> drawControls(const Scene& scene, int impacts, Dice& dice);

}  // namespace carom::bench
