// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

void addCompound(Solid& solid, const Shape& shape, const Placement& at, const SolidKind&) {
  const std::vector<CompoundPart>& parts = std::get<Compound>(shape).parts;
  int first_dimension = at.first_dimension;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const CompoundPart& part = parts[i];
    addShape(solid, part.shape,
             {at.axes * part.orientation.normalized().toRotationMatrix(), at.point(part.position), first_dimension,
              at.name + "part " + std::to_string(i) + " "});
    first_dimension += static_cast<int>(kindOf(part.shape).dimensions(part.shape).size());
  }
}

}  // namespace

SolidKind solidRow(KindOf<Compound>) { return {.add = addCompound, .name = numberedName}; }

const SolidKind& rowOf(const Shape& shape) {
  static const auto kinds = shapes::tableOf([](auto kind) {
    static_assert(requires { solidRow(kind); }, "a shape without a row: see ode_bridge/solids/parts.hpp");
    return solidRow(kind);
  });
  return kinds[shape.index()];
}

void addShape(Solid& solid, const Shape& shape, const Placement& at) {
  rowOf(shape).add(solid, shape, at, rowOf(shape));
}

}  // namespace carom::solids
