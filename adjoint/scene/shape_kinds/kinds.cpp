// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape.h"

#include "adjoint/scene/shapes/kinds.hpp"
#include "adjoint/scene/shapes/table.hpp"

namespace carom {

std::span<const ShapeKind> shapeKinds() {
  static const auto kinds = shapes::tableOf([](auto kind) {
    static_assert(requires { shapes::kindRow(kind); }, "a shape without a row: see adjoint/scene/shapes/kinds.hpp");
    return shapes::kindRow(kind);
  });
  return kinds;
}

const ShapeKind& kindOf(const Shape& shape) { return shapeKinds()[shape.index()]; }

}  // namespace carom
