// SPDX-License-Identifier: MIT
#include "adjoint/constrained/support.hpp"

namespace carom::adjoint_detail {

namespace {

bool isCarried(const Motion& motion, std::size_t body) {
  return (*motion.models)[body].kinematic && !motion.world_lines[body].arcs.back().stays();
}

}  // namespace

bool drivesContacts(const Motion& motion, int body) {
  const auto b = static_cast<std::size_t>(body);
  return isCarried(motion, b) || motion.scene->bodies[b].surfaceMoves();
}

Support supportOf(const Motion& motion, int body, double t) {
  const auto b = static_cast<std::size_t>(body);
  const Arc& arc = motion.world_lines[b].arcs.back();
  Support support;
  const Body& written = motion.scene->bodies[b];
  support.has_belt = written.surfaceMoves();
  support.surface_velocity = written.surface_velocity, support.surface_angular_velocity = written.surface_angular_velocity;
  support.center = (*motion.models)[b].center;
  if (!isCarried(motion, b)) {
    const Kinematics k = arc.kinematicsOf(arc.startState());
    support.pose = {k.x, k.R};
    return support;
  }
  support.arc = std::make_shared<const Arc>(arc);
  support.pose = support.poseAt(t);
  return support;
}

}  // namespace carom::adjoint_detail
