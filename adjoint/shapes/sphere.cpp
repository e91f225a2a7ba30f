#include <numbers>

#include "adjoint/shapes/kinds.h"

namespace carom::shapes {
namespace {

const Sphere& get(const Shape& s) { return std::get<Sphere>(s); }

// V = 4/3 pi r^3, I = 2/5 r^2 about every axis
SolidProperties properties(const Shape& s) {
  const double r = get(s).radius, area = 4 * std::numbers::pi * r * r;
  SolidProperties p;
  p.volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  p.unit_inertia = 0.4 * r * r * Mat3::Identity();
  p.rates = {{area, Vec3::Zero(), 0.8 * r * Mat3::Identity()}};
  return p;
}

SolidProperties propertiesRate(const Shape& s, const Eigen::VectorXd& d) {
  const double r = get(s).radius, dr = d[0];
  SolidProperties p;
  p.volume = 4 * std::numbers::pi * r * r * dr;
  p.unit_inertia = 0.8 * r * dr * Mat3::Identity();
  p.rates = {{8 * std::numbers::pi * r * dr, Vec3::Zero(), 0.8 * dr * Mat3::Identity()}};
  return p;
}

}  // namespace

ShapeKind sphereKind() {
  return {"sphere",
          [](const Shape&) { return std::vector<std::string>{"radius"}; },
          [](const Shape& s) { return dimensionsOf({get(s).radius}); },
          [](Shape& s, const Eigen::VectorXd& d) { std::get<Sphere>(s).radius = d[0]; },
          alwaysSolid,
          properties,
          propertiesRate,
          [](const Shape& s) { return get(s).radius; }};
}

}  // namespace carom::shapes
