// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

// Boxes of three different sides that a floor holds at their corners.

namespace carom::reference {

/// On its lowest corner.
inline Scene onCorner(const Quat& q, double friction, const Vec3& v, const Vec3& spin) {
  const Vec3 size(0.1, 0.2, 0.3);
  const double height = 0.5 * q.toRotationMatrix().row(2).cwiseAbs().dot(size);
  Body box = test::makeBox("box", size, {0, 0, height}, v);
  box.orientation = q, box.angular_velocity = spin;
  return test::makeScene({0, 0, -9.81}, 0, friction, {box, test::makePlane("floor", Vec3::UnitZ(), 0)});
}

inline const Quat kLeaning(Eigen::AngleAxisd(0.9, Vec3(1, 0.8, 0.3).normalized()));

/// Dropped, any way round.
inline Scene droppedBox(std::uint64_t seed) {
  test::Random random(seed);
  const double friction = random.in(0.05, 0.9);
  const Vec3 spin = random.vec(6), velocity = random.vec(0.5);
  Scene scene = onCorner(random.rotation(), friction, velocity, spin);
  scene.bodies[0].position.z() += random.in(0, 0.05);
  scene.materials[0].elasticity = random.below(2) * random.in(0, 0.6);
  return scene;
}

}  // namespace carom::reference
