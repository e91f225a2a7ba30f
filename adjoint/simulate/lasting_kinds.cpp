// SPDX-License-Identifier: MIT
#include "adjoint/simulate/lasting_kinds.hpp"

#include <variant>

namespace carom::adjoint_detail {

bool isUniformBall(const Shape& shape, const BodyModel& model) {
  return std::holds_alternative<Sphere>(shape) && model.center.isZero(0) &&
         model.inertia.minCoeff() == model.inertia.maxCoeff();
}

bool isRoundAboutAxis(const Shape& shape, const BodyModel& model) {
  const bool round = std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Capsule>(shape);
  return round && !(model.center.norm() > 0);
}

LastingKinds lastingKindsOf(const Shape& shape, const BodyModel& model, Tier derivative_tier) {
  if (isUniformBall(shape, model)) {
    if (!keepsBall(derivative_tier))
      return {{ArcKind::rest}, "rolls or slides, as its moments of inertia vary one by one"};
    return {{ArcKind::rest, ArcKind::slide, ArcKind::roll}, "rolls or slides on an edge or on several faces"};
  }
  if (isRoundAboutAxis(shape, model))
    return {{ArcKind::rest, ArcKind::slide, ArcKind::roll},
            "slides on its side, turns in another way than about its axis, tips, "
            "or stays on an edge or on several faces"};
  return {{ArcKind::rest, ArcKind::slide}, "turns, tips, or stays on an edge, a corner or several faces"};
}

}  // namespace carom::adjoint_detail
