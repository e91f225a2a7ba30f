// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/solid.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "adjoint/scene/body_model.h"
#include "ode_bridge/solids/parts.hpp"

namespace carom::ode_bridge_detail {
namespace {

bool same(const Shape& a, const Shape& b);

bool same(const Sphere& a, const Sphere& b) { return a.radius == b.radius; }
bool same(const Box& a, const Box& b) { return a.size == b.size; }
bool same(const Plane& a, const Plane& b) { return a.normal == b.normal && a.offset == b.offset; }
bool same(const Capsule& a, const Capsule& b) { return a.radius == b.radius && a.height == b.height; }
bool same(const Cylinder& a, const Cylinder& b) { return a.radius == b.radius && a.height == b.height; }
bool same(const Cone& a, const Cone& b) { return a.radius == b.radius && a.height == b.height; }
// surfaces never change: two of them are taken to differ
bool same(const Hull& a, const Hull& b) { return a.surface == b.surface && a.scale == b.scale; }
bool same(const Mesh& a, const Mesh& b) { return a.surface == b.surface && a.scale == b.scale; }
bool same(const CompoundPart& a, const CompoundPart& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs() && same(a.shape, b.shape);
}
bool same(const Compound& a, const Compound& b) {
  return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                    [](const CompoundPart& p, const CompoundPart& q) { return same(p, q); });
}

bool same(const Shape& a, const Shape& b) {
  if (a.index() != b.index()) return false;
  return std::visit([&](const auto& shape) { return same(shape, std::get<std::decay_t<decltype(shape)>>(b)); }, a);
}

}  // namespace

bool SolidSource::isOf(const Body& body) const {
  return fixed == body.fixed && center_of_mass == body.center_of_mass && same(shape, body.shape);
}

const Feature& Solid::feature(Family family, int index) const {
  const auto i = static_cast<std::size_t>(index);
  switch (family) {
    case Family::edge:
      return edges[i];
    case Family::face:
      return faces[i];
    case Family::rim:
      return rims[i];
    case Family::vertex:
      break;
  }
  return vertices[i];
}

std::size_t Solid::count(Family family) const {
  return std::array{vertices.size(), edges.size(), faces.size(), rims.size()}[static_cast<std::size_t>(family)];
}

Solid solidOf(const Body& body) {
  Solid solid;
  const Vec3 center = centerOfMass(body);
  solid.center_rates = centerOfMassRates(body);
  if (kindOf(body.shape).of_parts && !body.fixed && !body.center_of_mass)
    solid.uneven = std::make_shared<const Shape>(body.shape);
  solids::addShape(solid, body.shape, {Mat3::Identity(), Vec3::Zero() - center, 0, ""});
  const auto whole = solids::rowOf(body.shape).whole;
  if (whole && center.isZero(0)) solid.*whole = true;
  if (solid.box) solid.half = solid.vertices.back().point;
  solids::addNeighbours(solid);
  solids::addTree(solid);
  return solid;
}

}  // namespace carom::ode_bridge_detail
