// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace carom::adjoint_detail
