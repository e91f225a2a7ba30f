// SPDX-License-Identifier: MIT
#include "formats/drawing/shape_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace carom {
namespace {

Extent around(const Vec3& middle, const Vec3& half) { return Extent(middle - half, middle + half); }

Extent surfaceExtent(const Surface& surface, double scale, const Vec3& x, const Quat& q) {
  Extent extent;
  for (const Vec3& p : surface.vertices) extent.extend(x + q * (scale * p));
  return extent;
}

struct Extender {
  const Vec3& x;
  const Quat& q;

  Extent operator()(const Sphere& sphere) const { return around(x, Vec3::Constant(sphere.radius)); }
  Extent operator()(const Box& box) const { return around(x, 0.5 * (q.toRotationMatrix().cwiseAbs() * box.size)); }
  Extent operator()(const Plane&) const { return Extent(); }
  Extent operator()(const Capsule& capsule) const {
    const Vec3 axis = q * Vec3::UnitZ();
    return around(x, 0.5 * capsule.height * axis.cwiseAbs() + Vec3::Constant(capsule.radius));
  }
  // A disc with the unit normal a reaches r sqrt(1 - a_i^2) along axis i.
  Extent operator()(const Cylinder& cylinder) const {
    const Vec3 axis = q * Vec3::UnitZ();
    const Vec3 rim = (1 - axis.array().square()).max(0).sqrt();
    return around(x, 0.5 * cylinder.height * axis.cwiseAbs() + cylinder.radius * rim);
  }
  Extent operator()(const Hull& hull) const { return surfaceExtent(*hull.surface, hull.scale, x, q); }
  Extent operator()(const Mesh& mesh) const { return surfaceExtent(*mesh.surface, mesh.scale, x, q); }
  Extent operator()(const Compound& compound) const {
    Extent extent;
    for (const CompoundPart& part : compound.parts)
      extent.extend(shapeExtent(part.shape, x + q * part.position, q * part.orientation));
    return extent;
  }
};

double surfaceRadius(const Surface& surface, double scale, const Vec3& point) {
  double most = 0;
  for (const Vec3& p : surface.vertices) most = std::max(most, (scale * p - point).norm());
  return most;
}

struct Reach {
  const Vec3& point;

  double operator()(const Sphere& sphere) const { return point.norm() + sphere.radius; }
  double operator()(const Box& box) const { return (0.5 * box.size + point.cwiseAbs()).norm(); }
  double operator()(const Plane&) const { return std::numeric_limits<double>::infinity(); }
  double operator()(const Capsule& capsule) const {
    const Vec3 end(point.x(), point.y(), std::abs(point.z()) + 0.5 * capsule.height);
    return end.norm() + capsule.radius;
  }
  double operator()(const Cylinder& cylinder) const {
    return std::hypot(std::hypot(point.x(), point.y()) + cylinder.radius, std::abs(point.z()) + 0.5 * cylinder.height);
  }
  double operator()(const Hull& hull) const { return surfaceRadius(*hull.surface, hull.scale, point); }
  double operator()(const Mesh& mesh) const { return surfaceRadius(*mesh.surface, mesh.scale, point); }
  double operator()(const Compound& compound) const {
    double most = 0;
    for (const CompoundPart& part : compound.parts)
      most = std::max(most, radiusAbout(part.shape, part.orientation.conjugate() * (point - part.position)));
    return most;
  }
};

}  // namespace

Extent shapeExtent(const Shape& shape, const Vec3& x, const Quat& q) { return std::visit(Extender{x, q}, shape); }

double radiusAbout(const Shape& shape, const Vec3& point) { return std::visit(Reach{point}, shape); }

}  // namespace carom
