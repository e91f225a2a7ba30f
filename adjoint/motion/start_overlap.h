// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/scene/scene.h"

namespace carom {

/// Two bodies that overlap at the start by more than the contact tolerance. They do not collide until they have
/// separated.
struct StartOverlap {
  int a = -1;                    ///< body
  int b = -1;                    ///< body, above a
  double depth = 0;              ///< m, at the start
  std::optional<double> parted;  ///< s; none if they overlap up to the end of the motion
};

/// Throws InputError with the second of the two bodies as its place.
[[noreturn]] void refuseOverlap(const Scene& scene, const StartOverlap& overlap);

/// "'a' and 'b' overlap by 0.1 m at the start: they do not collide until they have separated", of a scene that is not
/// simulated yet.
std::string describeOverlapAtStart(const Scene& scene, const StartOverlap& overlap);
/// "'a' and 'b' overlap by 0.1 m at the start and separate at t = 0.2 s: until then they do not collide".
std::string describeOverlap(const Scene& scene, const StartOverlap& overlap);

}  // namespace carom
