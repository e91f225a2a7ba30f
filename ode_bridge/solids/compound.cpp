// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {
namespace {

void add(PartMaker& part, const Sphere& s) { addBall(part, s); }
void add(PartMaker& part, const Box& s) { addBox(part, s); }
void add(PartMaker& part, const Plane& s) { addHalfSpace(part, s); }
void add(PartMaker& part, const Capsule& s) { addCapsule(part, s); }
void add(PartMaker& part, const Cylinder& s) { addCylinder(part, s); }
void add(PartMaker& part, const Hull& s) { addHull(part, s); }
void add(PartMaker& part, const Mesh& s) { addMesh(part, s); }

struct Adder {
  Solid& solid;
  const Placement& at;
  const char* kind;

  template <class Simple>
  void operator()(const Simple& shape) const {
    PartMaker part(solid, at, kind);
    add(part, shape);
  }

  void operator()(const Compound& shape) const {
    int first_dimension = at.first_dimension;
    for (std::size_t i = 0; i < shape.parts.size(); ++i) {
      const CompoundPart& part = shape.parts[i];
      addShape(solid, part.shape,
               {at.axes * part.orientation.normalized().toRotationMatrix(), at.point(part.position), first_dimension,
                at.name + "part " + std::to_string(i) + " "});
      first_dimension += static_cast<int>(kindOf(part.shape).dimensions(part.shape).size());
    }
  }
};

}  // namespace

void addShape(Solid& solid, const Shape& shape, const Placement& at) {
  std::visit(Adder{solid, at, kindOf(shape).name}, shape);
}

}  // namespace carom::solids
