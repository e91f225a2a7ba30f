// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/plan.h"

namespace carom::adjoint_detail {

/// A ball about whose centre every axis is alike, to the last bit.
bool isUniformBall(const Shape& shape, const BodyModel& model);
/// A cylinder or capsule whose centre of mass is that of the shape.
bool isRoundAboutAxis(const Shape& shape, const BodyModel& model);
/// Whether the closed forms of a ball that rolls or slides hold for the derivatives that are asked for, too.
inline bool keepsBall(Tier derivative_tier) {
  return derivative_tier == Tier::spherical || derivative_tier == Tier::none;
}

/// What a body can do in lasting contact with fixed bodies.
struct LastingKinds {
  std::vector<ArcKind> kinds;  ///< in the order of ArcKind
  std::string ends;            ///< where it ends the motion, as the end of a sentence that begins with "where it"
};
/// Of a body that moves and is not kinematic.
LastingKinds lastingKindsOf(const Shape& shape, const BodyModel& model, Tier derivative_tier);

}  // namespace carom::adjoint_detail
