// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom::charts {

/// Scenes that engines can play as well: balls, boxes and planes of one material.
struct ChartScene {
  std::string name;
  double duration;  ///< s
  int impacts;      ///< in that time
  Scene (*make)();
};

/// A ball with three bounces; a tumbling box with three impacts; two boxes that meet in the air; a pool break.
const std::vector<ChartScene>& speedScenes();

/// Parts to make scenes of: material "m" everywhere, mass 1.
Scene emptyScene(double elasticity, double friction, const Vec3& gravity = {0, 0, -9.81});
Body movingBody(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity);
Body fixedPlane(const std::string& name, const Vec3& normal, double offset);

}  // namespace carom::charts
