// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/scene/shape_kinds/kinds.hpp"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

// V = pi r^2 h, I_x = I_y = r^2/4 + h^2/12, I_z = r^2/2
SolidProperties cylinderProperties(const Shape& s) {
  constexpr double pi = std::numbers::pi;
  const double r = as<Cylinder>(s).radius, h = as<Cylinder>(s).height, x = r * r / 4 + h * h / 12;
  SolidProperties p;
  p.volume = pi * r * r * h;
  p.unit_inertia = diagonal(x, x, r * r / 2);
  p.rates = {{2 * pi * r * h, Vec3::Zero(), diagonal(r / 2, r / 2, r)},
             {pi * r * r, Vec3::Zero(), diagonal(h / 6, h / 6, 0)}};
  return p;
}

SolidProperties cylinderPropertiesRate(const Shape& s, const Eigen::VectorXd& d) {
  requireDimensions(d, 2);
  constexpr double pi = std::numbers::pi;
  const double r = as<Cylinder>(s).radius, h = as<Cylinder>(s).height, dr = d[0], dh = d[1], dx = r * dr / 2 + h * dh / 6;
  SolidProperties p;
  p.volume = pi * r * (2 * dr * h + r * dh);
  p.unit_inertia = diagonal(dx, dx, r * dr);
  p.rates = {{2 * pi * (dr * h + r * dh), Vec3::Zero(), diagonal(dr / 2, dr / 2, dr)},
             {2 * pi * r * dr, Vec3::Zero(), diagonal(dh / 6, dh / 6, 0)}};
  return p;
}

}  // namespace

ShapeKind kindRow(KindOf<Cylinder>) {
  return {
      .name = "cylinder",
      .check =
          [](const Shape& s, const validation::ShapeCheck& at) {
            validation::requireLength(at.where / "radius", as<Cylinder>(s).radius);
            validation::requireLength(at.where / "height", as<Cylinder>(s).height);
          },
      .dimension_names = [](const Shape&) -> std::vector<std::string> { return {"radius", "height"}; },
      .dimensions = [](const Shape& s) { return dimensionsOf({as<Cylinder>(s).radius, as<Cylinder>(s).height}); },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 2);
            std::get<Cylinder>(s) = {.radius = d[0], .height = d[1]};
          },
      .solid = alwaysSolid,
      .properties = cylinderProperties,
      .propertiesRate = cylinderPropertiesRate,
      .boundingRadius = [](const Shape& s) { return elementary::hypot(as<Cylinder>(s).radius, as<Cylinder>(s).height / 2); },
      .innerRadius = [](const Shape& s) { return std::min(as<Cylinder>(s).radius, 0.5 * as<Cylinder>(s).height); },
  };
}

}  // namespace carom::shapes
