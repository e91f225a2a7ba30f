// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/base/types.h"
#include "editing/problem/edit_problem.hpp"

/// Proofs by free flight. Internal to editing/.
namespace carom::editing_detail {

/// Bounds of the origin of a body's shape, m, and of the velocity of its centre of mass, m/s, at a time, component by
/// component; infinite where what varies is unbounded.
struct FreeFlight {
  Vec3 lowest = Vec3::Zero(), highest = Vec3::Zero();
  Vec3 slowest = Vec3::Zero(), fastest = Vec3::Zero();
};

/// The bounds of a body at time t > 0 if it meets nothing before, whatever varies within its bounds; null where that is not
/// proven. The centre of mass of a body that flies is at x0 + v t + g f t^2 / 2; no two bodies of which one may reach it meet
/// while their bounding balls are apart along an axis, or along the normal of a plane. Sizes and gravity must not vary.
std::optional<FreeFlight> freeFlightUntil(const EditProblem& problem, int body, double t);

}  // namespace carom::editing_detail
