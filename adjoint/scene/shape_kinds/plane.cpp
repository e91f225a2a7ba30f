// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

void checkPlane(const Shape& s, const validation::ShapeCheck& at) {
  const Plane& plane = as<Plane>(s);
  if (!(std::abs(plane.normal.norm() - 1) <= 1e-9))
    validation::fail(at.where / "normal", "a vector of length " + validation::text(plane.normal.norm()), "a unit vector");
  validation::requireFinite(at.where / "offset", plane.offset);
}

[[noreturn]] void noMass() {
  throw InputError("found a plane, which has no mass properties, expected a shape with a volume");
}

}  // namespace

ShapeKind kindRow(KindOf<Plane>) {
  return {
      .name = "plane",
      .endless = true,
      .check = checkPlane,
      .dimension_names = [](const Shape&) { return std::vector<std::string>{}; },
      .dimensions = [](const Shape&) { return Eigen::VectorXd(0); },
      .setDimensions = [](Shape&, const Eigen::VectorXd& d) { requireDimensions(d, 0); },
      .solid = [](const Shape&) { return false; },
      .properties = [](const Shape&) -> SolidProperties { noMass(); },
      .propertiesRate = [](const Shape&, const Eigen::VectorXd&) -> SolidProperties { noMass(); },
      .boundingRadius = [](const Shape&) { return std::numeric_limits<double>::infinity(); },
      .innerRadius = [](const Shape&) { return 0.0; },
      .farthest = [](const Shape&, const Vec3&) -> FarthestPoint {
        throw InputError("found a plane, which has no farthest point, expected a bounded shape");
      },
  };
}

}  // namespace carom::shapes
