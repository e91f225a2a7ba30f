// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace carom::test {

/// Adds to a scene, 40 m away along x, a box that falls from a height of `drop` metres onto another that lies on a plate,
/// and stays on it: contact that lasts on a body that moves is not modelled, so that the motion ends. Gravity points down
/// z.
void addStackedBoxes(nlohmann::json& scene, double drop);

}  // namespace carom::test
