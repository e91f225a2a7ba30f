// SPDX-License-Identifier: MIT
#include <numbers>

#include "adjoint/scene/shape_kinds/kinds.hpp"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

// V = 4/3 pi r^3, I = 2/5 r^2 about every axis
SolidProperties sphereProperties(const Shape& s) {
  const double r = as<Sphere>(s).radius, area = 4 * std::numbers::pi * r * r;
  SolidProperties p;
  p.volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  p.unit_inertia = 0.4 * r * r * Mat3::Identity();
  p.rates = {{area, Vec3::Zero(), 0.8 * r * Mat3::Identity()}};
  return p;
}

SolidProperties spherePropertiesRate(const Shape& s, const Eigen::VectorXd& d) {
  requireDimensions(d, 1);
  const double r = as<Sphere>(s).radius, dr = d[0];
  SolidProperties p;
  p.volume = 4 * std::numbers::pi * r * r * dr;
  p.unit_inertia = 0.8 * r * dr * Mat3::Identity();
  p.rates = {{8 * std::numbers::pi * r * dr, Vec3::Zero(), 0.8 * dr * Mat3::Identity()}};
  return p;
}

}  // namespace

ShapeKind kindRow(KindOf<Sphere>) {
  return {
      .name = "sphere",
      .check = [](const Shape& s,
                  const validation::ShapeCheck& at) { validation::requireLength(at.where / "radius", as<Sphere>(s).radius); },
      .dimension_names = [](const Shape&) -> std::vector<std::string> { return {"radius"}; },
      .dimensions = [](const Shape& s) { return dimensionsOf({as<Sphere>(s).radius}); },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, 1);
            std::get<Sphere>(s).radius = d[0];
          },
      .solid = alwaysSolid,
      .properties = sphereProperties,
      .propertiesRate = spherePropertiesRate,
      .boundingRadius = [](const Shape& s) { return as<Sphere>(s).radius; },
      .innerRadius = [](const Shape& s) { return as<Sphere>(s).radius; },
  };
}

}  // namespace carom::shapes
