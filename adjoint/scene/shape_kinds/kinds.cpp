// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape.h"

#include <array>

#include "adjoint/scene/shapes/kinds.hpp"

namespace carom {
namespace {

// In the order of the alternatives of Shape.
const std::array<ShapeKind, std::variant_size_v<Shape>>& table() {
  static const std::array<ShapeKind, std::variant_size_v<Shape>> kinds{
      shapes::sphereKind(),   shapes::boxKind(),  shapes::planeKind(), shapes::capsuleKind(),
      shapes::cylinderKind(), shapes::hullKind(), shapes::meshKind(),  shapes::compoundKind(),
  };
  return kinds;
}

}  // namespace

const ShapeKind& kindOf(const Shape& shape) { return table()[shape.index()]; }

}  // namespace carom
