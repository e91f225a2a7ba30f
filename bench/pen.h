// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "adjoint/scene/scene.h"

namespace carom {

/// `count` equal frictionless balls of elasticity 1 in a cubical pen of six planes, at places of a lattice three radii
/// apart, with random velocities. The same seed gives the same scene everywhere.
Scene penOfBalls(int count, std::uint64_t seed);

/// `count` boxes with three different moments, tumbling in such a pen, with friction and elasticity 0.98.
Scene penOfBoxes(int count, std::uint64_t seed);

/// `count` mugs (a concave mesh with a handle, read from the file), tumbling in such a pen.
Scene penOfMugs(int count, const std::string& mug_file, std::uint64_t seed);

int movingBodies(const Scene& scene);

}  // namespace carom
