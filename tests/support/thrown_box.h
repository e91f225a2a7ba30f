// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/scenes.h"

namespace carom::test {

/// m/s^2, tilted a little.
inline const Vec3 kThrownGravity(0.2, -0.1, -9.81);

/// Askew and spinning, 0.6 m up, thrown down and along.
Body thrownBox();

/// That box, then the plane z = 0, of one material.
Scene boxOnFloor(double elasticity, double friction, double tangential = 0);

/// The same under plain gravity, lying flat and without spin: four contacts at once.
Scene flatBoxOnFloor(double friction);

}  // namespace carom::test
