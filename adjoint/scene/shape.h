// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "adjoint/base/types.h"
#include "adjoint/scene/surface.h"

namespace carom {

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

using Shape = std::variant<Sphere, Box, Plane, Capsule, Cylinder, Hull, Mesh, Compound>;

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

/// One row of the table of shapes: what the rest of the program asks of a shape. A new shape adds a struct above, a row
/// in shape.cpp and its features in ode_bridge/. What takes a vector throws InputError where it has not one number a
/// dimension.
struct ShapeKind {
  const char* name;  ///< word in the scene document
  /// Words of the `size` control: "radius"; "x", "y", "z"; "scale"; of a part of a compound "0.radius".
  std::vector<std::string> (*dimension_names)(const Shape&);
  Eigen::VectorXd (*dimensions)(const Shape&);  ///< one a name: metres, or a factor (scale)
  void (*setDimensions)(Shape&, const Eigen::VectorXd&);
  bool (*solid)(const Shape&);  ///< has a volume, so that mass properties can be derived
  SolidProperties (*properties)(const Shape&);
  /// Rate of every entry of `properties`, its rates included, as the dimensions change at the given rates.
  SolidProperties (*propertiesRate)(const Shape&, const Eigen::VectorXd& dimension_rates);
  double (*boundingRadius)(const Shape&);  ///< about the shape's origin; infinite for a plane
};

const ShapeKind& kindOf(const Shape& shape);

}  // namespace carom
