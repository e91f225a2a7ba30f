// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "tests/random/coulomb_check.h"

/// One body of any kind on a floor, an incline, stairs, in a groove, a pen or on a ground of flush pieces.
namespace carom::one_body_worlds {

struct World {
  std::string what;
  Scene scene;
  std::vector<test::Ground> grounds;
};

/// The same one for the same seed: elasticity one of 0, 1e-9, 0.3, 0.9, 1, friction one of 0, 1e-9, 0.2, 1, 10.
World worldOf(std::uint64_t seed);
/// Adds a half-space as ground.
void addPlane(World& world, const Vec3& n, double offset);

}  // namespace carom::one_body_worlds
