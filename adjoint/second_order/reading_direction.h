// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

namespace carom {

/// A direction in which the inputs of readings change: the scene, and the times of the seeds that are read at a given
/// time (one number a seed, 0 for those at events; empty: all stay).
struct ReadingDirection {
  SceneTangent scene;
  Eigen::VectorXd time;
};

}  // namespace carom
