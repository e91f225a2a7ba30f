// SPDX-License-Identifier: MIT
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/scene/shapes/kinds.hpp"

namespace carom::shapes {

ShapeKind planeKind() {
  return {"plane",
          [](const Shape&) { return std::vector<std::string>{}; },
          [](const Shape&) { return Eigen::VectorXd(0); },
          [](Shape&, const Eigen::VectorXd& d) { requireDimensions(d, 0); },
          [](const Shape&) { return false; },
          [](const Shape&) -> SolidProperties {
            throw InputError("found the mass properties of a plane asked for, expected a shape with a volume");
          },
          [](const Shape&, const Eigen::VectorXd&) -> SolidProperties {
            throw InputError("found the mass properties of a plane asked for, expected a shape with a volume");
          },
          [](const Shape&) { return std::numeric_limits<double>::infinity(); }};
}

}  // namespace carom::shapes
