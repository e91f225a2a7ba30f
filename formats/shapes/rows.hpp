// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/base/required.h"
#include "adjoint/scene/shape.h"
#include "formats/json/json.hpp"

namespace carom::gltf {
struct Tapered;
}

namespace carom::formats_detail {

struct Contours;
struct TriangleMesh;
class JsonWriter;
struct ColliderAdder;
class SurfaceFiles;

/// An axis-aligned box in the world, m; empty where it holds nothing.
using Extent = Eigen::AlignedBox3d;

/// Smallest axis-aligned box around a shape at a pose (origin x, shape axes to world q); empty for a plane.
Extent shapeExtent(const Shape& shape, const Vec3& x, const Quat& q);
/// Radius of the smallest ball about a point of the shape's axes that holds the shape; infinite for a plane.
double radiusAbout(const Shape& shape, const Vec3& point);

}  // namespace carom::formats_detail

namespace carom::shapes {

using namespace formats_detail;

/// A pose, shape axes to world.
struct ShapePose {
  const Vec3& x;
  const Quat& q;
};

/// A hull or mesh: a shape, or a part of one.
struct SurfaceUse {
  Shape& shape;  ///< itself
  const Surface& surface;
  double scale;
  std::string& file;  ///< where it is from; empty where it was made in memory
  std::string place;  ///< in the document of the whole shape: "/compound/2/mesh"
  bool convex;        ///< a hull
};

/// One row of the table of shapes: what documents, pictures and glTF files ask of a shape, beside its words in
/// scene.schema.json. Like those of ShapeKind, rows and the table are complete or do not compile.
struct FormatKind {
  /// From the value of its word in a document that follows the schema; `where` is the value's place.
  Required<Shape(const Json& value, const std::string& where, SurfaceFiles& files)> read;
  /// The value of its word.
  Required<void(JsonWriter& out, const Shape&)> write;
  Required<bool(const Shape&)> on_one_line;  ///< whether it is written on one
  /// Adds itself where it has a surface, or its parts; `where` is the place of the object that has its word.
  Required<void(Shape&, const std::string& where, std::vector<SurfaceUse>& out)> surfaces;
  /// See shapeExtent.
  Required<Extent(const Shape&, const ShapePose& at)> extent;
  /// See radiusAbout.
  Required<double(const Shape&, const Vec3& point)> radius_about;
  /// See addContours.
  Required<void(Contours& out, const Shape&, const ShapePose& at, const Vec3& viewer)> contours;
  /// See meshOf.
  Required<TriangleMesh(const Shape&, double plane_half_width)> mesh;
  /// Adds it to a node of a glTF file.
  Required<void(const ColliderAdder& out, const Shape&)> collider;
  /// The shape that a capsule or cylinder of a glTF file is, its radii as they may differ, if it is of this kind.
  Required<std::optional<Shape>(const gltf::Tapered&)> from_tapered;
};

/// FormatKind::from_tapered of what no such shape is.
inline std::optional<Shape> notTapered(const gltf::Tapered&) { return std::nullopt; }
inline bool onOneLine(const Shape&) { return true; }
inline void noSurfaces(Shape&, const std::string&, std::vector<SurfaceUse>&) {}

// The table: a row each, which stands in the file of that name.
FormatKind formatRow(KindOf<Sphere>);
FormatKind formatRow(KindOf<Box>);
FormatKind formatRow(KindOf<Plane>);
FormatKind formatRow(KindOf<Capsule>);
FormatKind formatRow(KindOf<Cylinder>);
FormatKind formatRow(KindOf<Cone>);
FormatKind formatRow(KindOf<Hull>);
FormatKind formatRow(KindOf<Mesh>);
FormatKind formatRow(KindOf<Compound>);

/// All of them, in the order of Shape.
const std::array<FormatKind, std::variant_size_v<Shape>>& formatKinds();
const FormatKind& formatOf(const Shape& shape);
/// Of a shape and all its parts. A copy of a shape uses the same surfaces.
std::vector<SurfaceUse> surfacesOf(Shape& shape);

}  // namespace carom::shapes
