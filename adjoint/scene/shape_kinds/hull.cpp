// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape_kinds/kinds.hpp"
#include "adjoint/scene/shape_kinds/scaled_surface.hpp"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

void checkHull(const Shape& shape, const validation::ShapeCheck& at) {
  const Hull& s = as<Hull>(shape);
  if (!s.surface) validation::fail(at.where, "no surface", "one made by convexHull");
  if (!s.surface->closed || !(s.surface->volume > 0))
    validation::fail(at.where, "a surface that is not closed", "a convex hull");
  requireScale(at, s.scale, *s.surface);
}

}  // namespace

ShapeKind kindRow(KindOf<Hull>) {
  return {
      .name = "hull",
      .check = checkHull,
      .dimension_names = [](const Shape&) -> std::vector<std::string> { return {"scale"}; },
      .dimensions = [](const Shape& s) { return dimensionsOf({as<Hull>(s).scale}); },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 1);
            std::get<Hull>(s).scale = d[0];
          },
      .solid = [](const Shape& s) { return as<Hull>(s).surface && as<Hull>(s).surface->closed; },
      .properties =
          [](const Shape& s) { return scaledProperties(as<Hull>(s).surface.get(), as<Hull>(s).scale, "hull"); },
      .propertiesRate =
          [](const Shape& s, const Eigen::VectorXd& rates) {
            requireDimensions(rates, 1);
            return scaledPropertiesRate(as<Hull>(s).surface.get(), as<Hull>(s).scale, rates[0], "hull");
          },
      .boundingRadius = [](const Shape& s) { return scaledRadius(as<Hull>(s).surface.get(), as<Hull>(s).scale); },
      .innerRadius = [](const Shape&) { return 0.0; },
  };
}

}  // namespace carom::shapes
