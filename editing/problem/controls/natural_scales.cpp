// SPDX-License-Identifier: MIT
#include "editing/problem/controls/natural_scales.hpp"

#include <algorithm>
#include <cmath>

namespace carom::editing_detail {
namespace {

constexpr double kStandardGravity = 9.81;

/// A natural scale of velocity is this part of the speed at which bodies meet: four natural velocities.
constexpr double kPartOfSpeed = 0.25;
/// The parts of a speed and of an elasticity by which a change of them is just noticed, and the least elasticity with
/// which the latter was measured.
constexpr double kNoticedSpeed = 0.07, kNoticedElasticity = 0.1, kLeastElasticity = 0.125;

double boundingDiameter(const Body& body) { return 2 * kindOf(body.shape).boundingRadius(body.shape); }

double lengthOf(const Scene& scene, int body) {
  const double own = boundingDiameter(scene.bodies[body]);
  if (std::isfinite(own) && own > 0) return own;
  double largest = 0;
  for (const Body& other : scene.bodies) {
    const double diameter = boundingDiameter(other);
    if (std::isfinite(diameter)) largest = std::max(largest, diameter);
  }
  return largest > 0 ? largest : 1;
}

}  // namespace

NaturalScales naturalScales(const Scene& scene, int body) {
  NaturalScales s;
  s.length = lengthOf(scene, body);
  const double g = scene.gravity.norm();
  if (g > 0) {
    s.velocity = std::sqrt(g * s.length);
    s.angular_velocity = std::sqrt(g / s.length);
  } else {
    const double speed = scene.bodies[body].velocity.norm(), spin = scene.bodies[body].angular_velocity.norm();
    s.velocity = speed > 0 ? speed : s.length;
    s.angular_velocity = spin > 0 ? spin : 1;
  }
  s.time = s.length / s.velocity;
  s.specific_energy = s.velocity * s.velocity;
  return s;
}

double gravityScale(const Scene& scene) {
  const double g = scene.gravity.norm();
  return g > 0 ? g : kStandardGravity;
}

double elasticityScale(double elasticity) {
  return kPartOfSpeed / kNoticedSpeed * kNoticedElasticity * std::max(elasticity, kLeastElasticity);
}

}  // namespace carom::editing_detail
