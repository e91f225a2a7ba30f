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

}  // namespace carom::adjoint_detail
