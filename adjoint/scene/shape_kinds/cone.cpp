// SPDX-License-Identifier: MIT
#include <numbers>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/scene/shape_kinds/kinds.hpp"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

// V = pi r^2 h/3, c = -h/4 along z, and about c: I_x = I_y = 3 (4 r^2 + h^2)/80, I_z = 3 r^2/10
SolidProperties coneProperties(const Shape& s) {
  constexpr double pi = std::numbers::pi;
  const double r = as<Cone>(s).radius, h = as<Cone>(s).height, x = 3 * (4 * r * r + h * h) / 80;
  SolidProperties p;
  p.volume = pi * r * r * h / 3;
  p.center = Vec3(0, 0, -h / 4);
  p.unit_inertia = diagonal(x, x, 3 * r * r / 10);
  p.rates = {{2 * pi * r * h / 3, Vec3::Zero(), diagonal(3 * r / 10, 3 * r / 10, 3 * r / 5)},
             {pi * r * r / 3, Vec3(0, 0, -0.25), diagonal(3 * h / 40, 3 * h / 40, 0)}};
  return p;
}

SolidProperties conePropertiesRate(const Shape& s, const Eigen::VectorXd& d) {
  requireDimensions(d, 2);
  constexpr double pi = std::numbers::pi;
  const double r = as<Cone>(s).radius, h = as<Cone>(s).height, dr = d[0], dh = d[1], dx = 3 * (4 * r * dr + h * dh) / 40;
  SolidProperties p;
  p.volume = pi * r * (2 * dr * h + r * dh) / 3;
  p.center = Vec3(0, 0, -dh / 4);
  p.unit_inertia = diagonal(dx, dx, 3 * r * dr / 5);
  p.rates = {{2 * pi * (dr * h + r * dh) / 3, Vec3::Zero(), diagonal(3 * dr / 10, 3 * dr / 10, 3 * dr / 5)},
             {2 * pi * r * dr / 3, Vec3::Zero(), diagonal(3 * dh / 40, 3 * dh / 40, 0)}};
  return p;
}

}  // namespace

ShapeKind kindRow(KindOf<Cone>) {
  return {
      .name = "cone",
      .check =
          [](const Shape& s, const validation::ShapeCheck& at) {
            validation::requireLength(at.where / "radius", as<Cone>(s).radius);
            validation::requireLength(at.where / "height", as<Cone>(s).height);
          },
      .dimension_names = [](const Shape&) -> std::vector<std::string> { return {"radius", "height"}; },
      .dimensions = [](const Shape& s) { return dimensionsOf({as<Cone>(s).radius, as<Cone>(s).height}); },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 2);
            std::get<Cone>(s) = {.radius = d[0], .height = d[1]};
          },
      .solid = alwaysSolid,
      .properties = coneProperties,
      .propertiesRate = conePropertiesRate,
      .boundingRadius = [](const Shape& s) { return elementary::hypot(as<Cone>(s).radius, as<Cone>(s).height / 2); },
      // the side is the nearer: (h/2) r/sqrt(r^2 + h^2)
      .innerRadius =
          [](const Shape& s) {
            const double r = as<Cone>(s).radius, h = as<Cone>(s).height;
            return 0.5 * h * (r / elementary::hypot(r, h));
          },
  };
}

}  // namespace carom::shapes
