// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "adjoint/base/required.h"
#include "adjoint/base/types.h"
#include "adjoint/scene/shapes/cone.h"
#include "adjoint/scene/surface.h"

namespace carom {

namespace shapes {
/// Stands for a kind of shape where a row is chosen (adjoint/scene/shapes/table.hpp).
template <class S>
struct KindOf {};
}  // namespace shapes

/// Ball about the shape's origin.
struct Sphere {
  double radius = 0.5;  ///< m
};

/// Cuboid centred on the shape's origin, edges along its axes.
struct Box {
  Vec3 size{1, 1, 1};  ///< full edge lengths, m
};

/// The half space { p : normal . p <= offset } in the shape's frame; fixed bodies only.
struct Plane {
  Vec3 normal{0, 0, 1};  ///< unit, pointing out of the solid
  double offset = 0;     ///< m, along the unit normal
};

/// All points within `radius` of the segment from (0, 0, -height/2) to (0, 0, height/2).
struct Capsule {
  double radius = 0.5;  ///< m
  double height = 1;    ///< between the centres of its two ends, m
};

/// Round cylinder about z, from -height/2 to height/2, with sharp rims.
struct Cylinder {
  double radius = 0.5;  ///< m
  double height = 1;    ///< m
};

/// Convex hull of points; see `convexHull` in ode_bridge/ for one made from points.
struct Hull {
  std::shared_ptr<const Surface> surface;  ///< convex and closed, at scale 1
  double scale = 1;                        ///< factor on all coordinates
  std::string file;                        ///< where it was read from; empty when its points were written out
};

/// Surface of triangles, which may be concave; closed unless the body is fixed or has its mass and inertia written.
struct Mesh {
  std::shared_ptr<const Surface> surface;  ///< at scale 1
  double scale = 1;                        ///< factor on all coordinates
  std::string file;                        ///< where it was read from; empty when it was made in memory
};

/// Several shapes that move as one. They may overlap: mass properties are the sums over the parts.
struct CompoundPart;
struct Compound {
  std::vector<CompoundPart> parts;
};

using Shape = std::variant<Sphere, Box, Plane, Capsule, Cylinder, Hull, Mesh, Compound, Cone>;

struct CompoundPart {
  Shape shape;                          ///< any but a plane
  Vec3 position = Vec3::Zero();         ///< of the part's origin in the compound's axes, m
  Quat orientation = Quat::Identity();  ///< part to compound, unit
};

/// Rates of SolidProperties by one dimension of the shape.
struct SolidRate {
  double volume = 0;
  Vec3 center = Vec3::Zero();
  Mat3 unit_inertia = Mat3::Zero();
};

/// Mass properties at uniform density, in the shape's axes.
struct SolidProperties {
  double volume = 0;                 ///< m^3
  Vec3 center = Vec3::Zero();        ///< centre of mass, m
  Mat3 unit_inertia = Mat3::Zero();  ///< about the centre of mass, per unit mass, symmetric, m^2
  std::vector<SolidRate> rates;      ///< by dimension, in the order of ShapeKind::dimensions
};

namespace validation {
struct ShapeCheck;  // adjoint/scene/validation.hpp
}

/// One row of the table of shapes: what the rest of the program asks of a shape, whatever its kind. A row that leaves
/// one of them out does not compile, nor does a table without a row for every alternative of Shape. What takes a vector
/// throws InputError where it has not one number a dimension. Collision detection and documents have tables of their
/// own, in ode_bridge/solids/ and formats/shapes/.
struct ShapeKind {
  const char* name;  ///< word in the scene document
  /// Throws InputError for members that no such shape can have.
  Required<void(const Shape&, const validation::ShapeCheck&)> check;
  /// Words of the `size` control: "radius"; "x", "y", "z"; "scale"; of a part of a compound "0.radius".
  Required<std::vector<std::string>(const Shape&)> dimension_names;
  Required<Eigen::VectorXd(const Shape&)> dimensions;  ///< one a name: metres, or a factor (scale)
  Required<void(Shape&, const Eigen::VectorXd&)> setDimensions;
  Required<bool(const Shape&)> solid;  ///< has a volume, so that mass properties can be derived
  Required<SolidProperties(const Shape&)> properties;
  /// Rate of every entry of `properties`, its rates included, as the dimensions change at the given rates.
  Required<SolidProperties(const Shape&, const Eigen::VectorXd& dimension_rates)> propertiesRate;
  Required<double(const Shape&)> boundingRadius;  ///< about the shape's origin; infinite for a plane
  /// Of a ball about the shape's origin that lies within the shape, m; 0 where none is known.
  Required<double(const Shape&)> innerRadius;
};

/// The rows, in the order of the alternatives of Shape.
std::span<const ShapeKind> shapeKinds();
const ShapeKind& kindOf(const Shape& shape);

}  // namespace carom
