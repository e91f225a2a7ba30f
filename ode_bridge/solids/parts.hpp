// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/shape_kinds/table.hpp"
#include "ode_bridge/solids/solid.hpp"

/// How a Solid is put together: one file a shape adds its features and pieces.
namespace carom::solids {

using namespace ode_bridge_detail;

using shapes::KindOf;

/// Where a part stands in the solid, and what it is called there.
struct Placement {
  Mat3 axes = Mat3::Identity();  ///< part's axes to the solid's
  Vec3 origin = Vec3::Zero();    ///< m, solid's axes
  int first_dimension = 0;
  std::string name;

  Vec3 point(const Vec3& p) const { return origin + axes * p; }
  Vec3 direction(const Vec3& d) const { return axes * d; }
};

struct SolidKind;

/// Adds one part to a solid. Points and directions are given in the part's axes, indices are those of the whole solid.
/// References hold until the next feature of that family is added.
class PartMaker {
 public:
  PartMaker(Solid& solid, const Placement& at, const char* kind, const SolidKind& row);

  /// The next dimension of the part (see Part::Stretch).
  void dimension(const Vec3& stretch, double swept = 0, double rim = 0, double apex = 0);

  int vertex(const Vec3& p, double radius = 0);
  /// Four marks on a rim about z. A rim that lies flat on a face has no point that touches first: they serve landings
  /// that are flat exactly, and nothing else, and are nobody's neighbours.
  void marks(double radius, double z);
  SolidEdge& edge(const Vec3& middle, const Vec3& direction, double half_length);
  SolidFace& face(const Vec3& p, const Vec3& normal);
  void rim(const Vec3& center, const Vec3& normal, double radius);
  /// Corner of the face added last.
  void corner(int vertex);

  /// A piece about `middle`, without features and the radius of its core.
  Piece& piece(Piece::Core core, const Vec3& middle);
  /// Gives the piece all features of the part, and its vertices as support points.
  void takeAll(Piece& piece);
  /// Gives the piece `count` features more of a family, from this index on.
  void take(Piece& piece, Family family, int first, int count = 1);

  /// First features of the part.
  const Part& part() const { return solid_.parts.back(); }
  Solid& solid() { return solid_; }
  const Placement& at() const { return at_; }

 private:
  template <class F>
  F& place(std::vector<F>& family, const Vec3& p, const Vec3& direction);

  Solid& solid_;
  const Placement& at_;
};

/// One row of the table of shapes: what collision detection asks of a shape. Like those of ShapeKind, rows and the
/// table are complete or do not compile.
struct SolidKind {
  /// Adds features and pieces at a place; `row` is this one, which names the features.
  Required<void(Solid&, const Shape&, const Placement&, const SolidKind& row)> add;
  /// What describe() calls feature `index` of a family, counted from the first of the part: "edge 12", "rim +z".
  Required<std::string(Family family, int index)> name;
  bool numbered = false;         ///< its features have numbers, which tell nothing of their place
  bool Solid::*whole = nullptr;  ///< set of a solid that is one such shape about its origin
};

// The table: a row each, which stands with its features in the file of that name.
SolidKind solidRow(KindOf<Sphere>);
SolidKind solidRow(KindOf<Box>);
SolidKind solidRow(KindOf<Plane>);
SolidKind solidRow(KindOf<Capsule>);
SolidKind solidRow(KindOf<Cylinder>);
SolidKind solidRow(KindOf<Cone>);
SolidKind solidRow(KindOf<Hull>);
SolidKind solidRow(KindOf<Mesh>);
SolidKind solidRow(KindOf<Compound>);

/// SolidKind::add of a shape that is one part, from addX(PartMaker&, const X&).
template <class S, void (*addFeatures)(PartMaker&, const S&)>
void addPart(Solid& solid, const Shape& shape, const Placement& at, const SolidKind& row) {
  PartMaker part(solid, at, kindOf(shape).name, row);
  addFeatures(part, std::get<S>(shape));
}

// For names: "+z", and "vertex 12".
std::string signedAxis(int positive, int axis);
std::string numberedName(Family family, int index);

/// Vertices, faces and edges of a surface, for hull and mesh.
void addSurface(PartMaker& part, const Surface& surface, double scale);

/// The row of a shape.
const SolidKind& rowOf(const Shape& shape);

/// A shape of any kind; the parts of a compound one after another, depth first, as its dimensions are counted.
void addShape(Solid& solid, const Shape& shape, const Placement& at);

/// Radius about `center` that holds the core of a piece; never less than it is, for all rounding. m
double coreRadius(const Solid& solid, const Piece& piece, const Vec3& center);

/// Solid::neighbours from the edges.
void addNeighbours(Solid& solid);
/// Solid::nodes from the pieces.
void addTree(Solid& solid);

}  // namespace carom::solids
