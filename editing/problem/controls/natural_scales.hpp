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

/// Natural scales of what bodies are made of, so that equal costs are about equally noticed: each is the change that is
/// seen as well as a natural scale of velocity (docs/editing.md derives them and names the sources).
double elasticityScale(double elasticity);  ///< of an elasticity that starts at this value
inline constexpr double kFrictionScale = 1.0 / 6;
inline constexpr double kTangentialElasticityScale = 0.35;
inline constexpr double kMassScale = 0.5;     ///< of log(mass)
inline constexpr double kInertiaScale = 0.5;  ///< of log(moment)

}  // namespace carom::editing_detail
