// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "explore/worlds/exploration.h"

/// What the tests of explore/ throw.
namespace carom::explore_test {

/// A scene, what is drawn of it, and what is read.
struct Throw {
  Scene scene;
  double duration;
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
};

Control drawn(Control control, Distribution distribution);

Exploration exploring(const Throw& t, const ExploreOptions& options = {});

/// A ball with spin onto a floor, 1.5 s; its velocity, spin, and the material's coefficients are drawn. Rows: where it
/// is at 1.2 s, x in a range, and when it strikes the floor for the second time.
Throw bouncingBall();
/// A box that tumbles; every orientation.
Throw tumblingBox();
/// A ball over a wall, vz normal: it clears the wall where vz is above a number that clearingSpeed() finds.
Throw ballOverWall();
double clearingSpeed();
constexpr double kMeanSpeed = 3.8, kSpeedDeviation = 0.4;  // of vz, m/s
/// A cube whose every orientation is drawn, dropped onto a floor that it comes to rest on.
Throw droppedDie();

}  // namespace carom::explore_test
