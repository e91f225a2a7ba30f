// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "adjoint/base/required.h"
#include "adjoint/base/types.h"
#include "adjoint/scene/farthest_point.h"
#include "adjoint/scene/shapes/cone.h"
#include "adjoint/scene/shapes/kind_of.h"
#include "adjoint/scene/surface.h"

namespace carom {

/// Ball about the shape's origin.
struct Sphere {
  double radius = 0.5;  ///< m
  bool operator==(const Sphere&) const = default;  ///< the same numbers
};

/// Cuboid centred on the shape's origin, edges along its axes.
struct Box {
  Vec3 size{1, 1, 1};  ///< full edge lengths, m
  bool operator==(const Box&) const = default;  ///< the same numbers
};

/// The half space { p : normal . p <= offset } in the shape's frame; fixed bodies only.
struct Plane {
  Vec3 normal{0, 0, 1};  ///< unit, pointing out of the solid
  double offset = 0;     ///< m, along the unit normal
  bool operator==(const Plane&) const = default;  ///< the same numbers
};

/// All points within `radius` of the segment from (0, 0, -height/2) to (0, 0, height/2).
struct Capsule {
  double radius = 0.5;  ///< m
  double height = 1;    ///< between the centres of its two ends, m
  bool operator==(const Capsule&) const = default;  ///< the same numbers
};

/// Round cylinder about z, from -height/2 to height/2, with sharp rims.
struct Cylinder {
  double radius = 0.5;  ///< m
  double height = 1;    ///< m
  bool operator==(const Cylinder&) const = default;  ///< the same numbers
};

/// Convex hull of points; see `convexHull` in ode_bridge/ for one made from points.
struct Hull {
  std::shared_ptr<const Surface> surface;  ///< convex and closed, at scale 1
  double scale = 1;                        ///< factor on all coordinates
  std::string file;                        ///< where it was read from; empty when its points were written out
  bool operator==(const Hull&) const = default;  ///< the same surface in memory, and the same numbers
};

/// Triangle mesh, which may be concave; closed unless the body is fixed or has mass and inertia given.
struct Mesh {
  std::shared_ptr<const Surface> surface;  ///< at scale 1
  double scale = 1;                        ///< factor on all coordinates
  std::string file;                        ///< where it was read from; empty when it was made in memory
  bool operator==(const Mesh&) const = default;  ///< the same surface in memory, and the same numbers
};

struct CompoundPart;
/// Several shapes that move as one. They may overlap: mass properties are sums over the parts.
struct Compound {
  std::vector<CompoundPart> parts;  ///< at least one
  bool operator==(const Compound&) const;  ///< the same parts in the same order
};

/// Any shape.
using Shape = std::variant<Sphere, Box, Plane, Capsule, Cylinder, Hull, Mesh, Compound, Cone>;

/// One shape of a compound and its pose.
struct CompoundPart {
  Shape shape;                          ///< any but a plane
  Vec3 position = Vec3::Zero();         ///< of the part's origin in the compound's axes, m
  Quat orientation = Quat::Identity();  ///< part to compound, unit
  bool operator==(const CompoundPart&) const = default;  ///< the same shape in the same place
};
inline bool Compound::operator==(const Compound& other) const { return parts == other.parts; }

/// Derivatives of SolidPropertiesOf with respect to one dimension of the shape.
template <class S>
struct SolidRateOf {
  S volume = 0;                                                          ///< m^3
  Eigen::Matrix<S, 3, 1> center = Eigen::Matrix<S, 3, 1>::Zero();        ///< m
  Eigen::Matrix<S, 3, 3> unit_inertia = Eigen::Matrix<S, 3, 3>::Zero();  ///< m^2
};

/// Mass properties at uniform density, in the shape's axes.
template <class S>
struct SolidPropertiesOf {
  S volume = 0;                                                    ///< m^3
  Eigen::Matrix<S, 3, 1> center = Eigen::Matrix<S, 3, 1>::Zero();  ///< centre of mass, m
  /// About the centre of mass, per unit mass, symmetric, m^2.
  Eigen::Matrix<S, 3, 3> unit_inertia = Eigen::Matrix<S, 3, 3>::Zero();
  std::vector<SolidRateOf<S>> rates;  ///< per dimension, in the order of ShapeKind::dimensions
};
using SolidRate = SolidRateOf<double>;              ///< in doubles
using SolidProperties = SolidPropertiesOf<double>;  ///< in doubles

namespace validation {
struct ShapeCheck;  // adjoint/scene/validation.hpp
}

/// One row of the table of shapes: the operations that every kind of shape provides. An incomplete row does not
/// compile, nor does a table without a row for every alternative of Shape. Functions of a vector throw InputError
/// unless it has one number per dimension. Collision detection and documents have tables of their own, in
/// ode_bridge/solids/ and formats/shapes/.
struct ShapeKind {
  const char* name;       ///< word in the scene document
  bool endless = false;   ///< a half space: it cannot move, nor be a part of a compound
  bool of_parts = false;  ///< a compound: its centre of mass and principal axes are not proportional to a single dimension
  /// Throws InputError for invalid members.
  Required<void(const Shape&, const validation::ShapeCheck&)> check;
  /// Words of the `size` control: "radius"; "x", "y", "z"; "scale"; of a part of a compound "0.radius".
  Required<std::vector<std::string>(const Shape&)> dimension_names;
  Required<Eigen::VectorXd(const Shape&)> dimensions;  ///< one per name: metres, or a factor (scale)
  Required<void(Shape&, const Eigen::VectorXd&)> setDimensions;  ///< to these
  Required<bool(const Shape&)> solid;  ///< has a volume, so that mass properties can be derived
  Required<SolidProperties(const Shape&)> properties;  ///< with derivatives
  /// Rate of every entry of `properties`, its derivatives included, for the given rates of the dimensions.
  Required<SolidProperties(const Shape&, const Eigen::VectorXd& dimension_rates)> propertiesRate;
  Required<double(const Shape&)> boundingRadius;  ///< about the shape's origin; infinite for a plane
  /// Radius of a ball about the shape's origin inside the shape, m; 0 if none is known.
  Required<double(const Shape&)> innerRadius;
  /// Support point along a direction in its axes. Throws InputError for a plane, which has none.
  Required<FarthestPoint(const Shape&, const Vec3& direction)> farthest;
};

/// The rows, in the order of the alternatives of Shape.
std::span<const ShapeKind> shapeKinds();
/// The row of a shape.
const ShapeKind& kindOf(const Shape& shape);

}  // namespace carom
