// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/scene/scene.h"

namespace carom {

/// Two bodies that overlap at the start by more than counts as touching. They do not meet until they have parted; from
/// then on they collide as others do.
struct StartOverlap {
  int a = -1, b = -1;            ///< a < b
  double depth = 0;              ///< m, at the start
  std::optional<double> parted;  ///< s; none where they overlap up to the end of the motion
};

/// Throws InputError at the second of the two bodies.
[[noreturn]] void refuseOverlap(const Scene& scene, const StartOverlap& overlap);

/// "'a' and 'b' overlap by 0.1 m at the start: they do not collide until they have parted", of a scene that is not
/// simulated yet.
std::string describeOverlapAtStart(const Scene& scene, const StartOverlap& overlap);
/// "'a' and 'b' overlap by 0.1 m at the start and part at t = 0.2 s: until then they do not collide".
std::string describeOverlap(const Scene& scene, const StartOverlap& overlap);

}  // namespace carom
