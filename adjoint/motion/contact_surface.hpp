// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"
#include "adjoint/scene/surface_motion.hpp"

namespace carom::adjoint_detail {

/// The moving surface of a body whose shape has a pose (of its centre of mass, see shapePose).
inline SurfaceMotion<double> surfaceMotionOf(const Motion& motion, int body, const Pose& pose) {
  const auto b = static_cast<std::size_t>(body);
  const Body& written = motion.scene->bodies[b];
  return {written.surface_velocity, written.surface_angular_velocity, pose.R, pose.x - pose.R * (*motion.models)[b].center};
}

}  // namespace carom::adjoint_detail
