// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

namespace carom::editing_detail {

/// What counts as "much" for one body: the units in which changes and residuals are weighed against each other
/// (docs/equations.md section 6). All are positive and finite.
struct NaturalScales {
  double length = 1;            ///< m: bounding diameter of the body
  double velocity = 1;          ///< m/s: sqrt(g length); without gravity the body's speed, or one length a second
  double angular_velocity = 1;  ///< rad/s: sqrt(g / length); without gravity the body's spin, or 1 rad/s
  double time = 1;              ///< s: length / velocity
  double specific_energy = 1;   ///< J/kg: velocity^2
};

/// A body without a bound (a plane) takes the length of the largest body that has one, or 1 m.
NaturalScales naturalScales(const Scene& scene, int body);

/// |g|, or 9.81 m/s^2 without gravity.
double gravityScale(const Scene& scene);

}  // namespace carom::editing_detail
