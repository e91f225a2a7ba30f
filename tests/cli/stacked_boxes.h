// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace carom::test {

/// Adds to a scene, 40 m away along x, a box that falls from a height of `drop` metres onto a pile of eight that a belt carries: where they come to the
/// end of the belt, after 0.6 s, the motion ends, as nine bodies move on each other. Gravity points down z.
void addStackedBoxes(nlohmann::json& scene, double drop);

}  // namespace carom::test
