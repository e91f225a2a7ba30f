#pragma once

#include <string>
#include <variant>
#include <vector>

#include "adjoint/types.h"

namespace carom {

/// Ball about the body's origin.
struct Sphere {
  double radius = 0.5;  ///< m
};

/// Cuboid centred on the body's origin, edges along the shape's axes.
struct Box {
  Vec3 size{1, 1, 1};  ///< full edge lengths, m
};

/// The half space { p : normal . p <= offset } in the shape's frame; fixed bodies only.
struct Plane {
  Vec3 normal{0, 0, 1};  ///< unit, pointing out of the solid
  double offset = 0;     ///< m, along the unit normal
};

using Shape = std::variant<Sphere, Box, Plane>;

/// The most dimensions that one shape has (the columns kept for `size` derivatives of one body).
inline constexpr int kMaxDimensions = 3;

/// Volume [m^3] and moments of inertia per unit mass [m^2] about the shape's axes, with their derivatives by the
/// shape's dimensions: dvolume[d], dunit_inertia.col(d).
struct SolidProperties {
  double volume = 0;
  Vec3 unit_inertia = Vec3::Zero();
  Vec3 dvolume = Vec3::Zero();
  Mat3 dunit_inertia = Mat3::Zero();
};

/// One row of the table of shapes: what the rest of the program asks of a shape. A new shape adds a struct above, a row
/// in shape.cpp and its features in ode_bridge/.
struct ShapeKind {
  const char* name;                          ///< word in the scene document
  std::vector<const char*> dimension_names;  ///< words of the `size` control: "radius"; "x", "y", "z"
  bool solid;                                ///< has a volume, so that it can move
  Vec3 (*dimensions)(const Shape&);          ///< metres; unused entries are 0
  void (*setDimensions)(Shape&, const Vec3&);
  SolidProperties (*properties)(const Shape&);
  double (*boundingRadius)(const Shape&);  ///< about the origin; infinite for a plane
};

const ShapeKind& kindOf(const Shape& shape);

}  // namespace carom
