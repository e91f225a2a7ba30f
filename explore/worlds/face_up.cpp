// SPDX-License-Identifier: MIT
#include "explore/worlds/face_up.hpp"

#include <cmath>

namespace carom::explore_detail {

std::uint8_t faceUp(const Motion& motion, int body) {
  const Vec3& gravity = motion.scene->gravity;
  if (gravity.isZero(0)) return 0;
  const Vec3 up = motion.stateAt(body, motion.end).orientation.conjugate() * Vec3(-gravity);
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::uint8_t>(1 + 2 * axis + (up[axis] < 0 ? 1 : 0));
}

}  // namespace carom::explore_detail
