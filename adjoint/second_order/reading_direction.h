// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

namespace carom {

/// A direction of change of the inputs of readings: the scene, and the times of seeds at fixed times (one number per
/// seed, 0 for those at events; empty: constant).
struct ReadingDirection {
  SceneTangent scene;    ///< rates of the scene parameters
  Eigen::VectorXd time;  ///< rates of the times, s
};

}  // namespace carom
