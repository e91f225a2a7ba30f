// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "adjoint/scene/scene.h"

namespace carom::metamorphic {

/// A random world of one to three bodies that come into lasting contact, of about 1 m and 1 s.
struct LastingWorld {
  std::string name;  ///< "box on steps", ...
  Scene scene;
  double duration = 0;  ///< s
};

/// Boxes, balls, cylinders, capsules, hulls and meshes that slide, roll, rest, stand on each other or are dropped; on floors,
/// slopes, steps, tables, in grooves and before walls. Half of them lie flush and on round numbers.
LastingWorld lastingWorld(std::uint64_t seed);

}  // namespace carom::metamorphic
