// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/control.h"
#include "editing/session.h"

namespace carom {

/// A scene, what may vary in it, and where a body is taken hold of.
struct DragCase {
  std::string name;
  Scene scene;
  double duration = 2;
  std::vector<Control> controls = {};
  std::vector<Constraint> nails = {};
  std::string body = "";
  When at = 1.0;
  Grip grip = {};
  double wide = 0.3;  ///< m, half the width of the path of the mouse
  /// m; a target with a larger x is behind a wall, where nothing brings the body.
  double farthest_x = std::numeric_limits<double>::infinity();
  double limit = 4;  ///< ms, that 95 of 100 updates are to keep
};
std::vector<DragCase> dragCases();

/// Where a hand takes a mouse in `seconds`, at 60 Hz: aimed movements of minimum jerk between places of a vertical
/// rectangle around `start`, with rests, the tremor of a hand, and the steps of a screen. The same seed gives the same
/// path.
std::vector<Vec3> mousePath(const Vec3& start, double wide, double seconds, std::uint64_t seed);

}  // namespace carom
