#include "adjoint/shape.h"

#include <array>
#include <limits>
#include <numbers>

namespace carom {
namespace {

Vec3 sphereDimensions(const Shape& s) { return {std::get<Sphere>(s).radius, 0, 0}; }
void setSphereDimensions(Shape& s, const Vec3& d) { std::get<Sphere>(s).radius = d[0]; }

// V = 4/3 pi r^3, I/m = 2/5 r^2
SolidProperties sphereProperties(const Shape& s) {
  const double r = std::get<Sphere>(s).radius;
  SolidProperties p;
  p.volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  p.dvolume[0] = 4.0 * std::numbers::pi * r * r;
  p.unit_inertia.setConstant(0.4 * r * r);
  p.dunit_inertia.col(0).setConstant(0.8 * r);
  return p;
}

Vec3 boxDimensions(const Shape& s) { return std::get<Box>(s).size; }
void setBoxDimensions(Shape& s, const Vec3& d) { std::get<Box>(s).size = d; }

// V = x y z, I_x/m = (y^2 + z^2)/12 and so on
SolidProperties boxProperties(const Shape& s) {
  const Vec3& d = std::get<Box>(s).size;
  SolidProperties p;
  p.volume = d.prod();
  p.dvolume = {d.y() * d.z(), d.x() * d.z(), d.x() * d.y()};
  const Vec3 squares = d.cwiseAbs2();
  p.unit_inertia = Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()) / 12.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) p.dunit_inertia(i, j) = i == j ? 0.0 : d[j] / 6.0;
  return p;
}

Vec3 noDimensions(const Shape&) { return Vec3::Zero(); }
void setNoDimensions(Shape&, const Vec3&) {}
SolidProperties noProperties(const Shape&) { return {}; }

// In the order of the alternatives of Shape.
const std::array<ShapeKind, std::variant_size_v<Shape>>& table() {
  static const std::array<ShapeKind, std::variant_size_v<Shape>> kinds{{
      {"sphere",
       {"radius"},
       true,
       sphereDimensions,
       setSphereDimensions,
       sphereProperties,
       [](const Shape& s) { return std::get<Sphere>(s).radius; }},
      {"box",
       {"x", "y", "z"},
       true,
       boxDimensions,
       setBoxDimensions,
       boxProperties,
       [](const Shape& s) { return 0.5 * std::get<Box>(s).size.norm(); }},
      {"plane",
       {},
       false,
       noDimensions,
       setNoDimensions,
       noProperties,
       [](const Shape&) { return std::numeric_limits<double>::infinity(); }},
  }};
  return kinds;
}

}  // namespace

const ShapeKind& kindOf(const Shape& shape) { return table()[shape.index()]; }

}  // namespace carom
