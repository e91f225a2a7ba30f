// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace carom::test {

/// Adds to a scene, 40 m away along x, a box that falls from a height of `drop` metres onto another that lies on a plate,
/// and tips over its edge: a body that moves on another that can move is not modelled, so that the motion ends. Gravity points
/// down z.
void addStackedBoxes(nlohmann::json& scene, double drop);

}  // namespace carom::test
