// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom::solids {
struct SolidKind;  // ode_bridge/solids/parts.hpp
}

namespace carom::ode_bridge_detail {

enum class Family : std::uint8_t { vertex, edge, face, rim };
inline constexpr std::array kFamilies{Family::vertex, Family::edge, Family::face, Family::rim};

/// A vertex, edge, face or rim of a solid, in the solid's axes: the shape's axes, from the centre of mass of a moving
/// body or from the shape's origin of a fixed one. Vertices and edges are swept by a ball of `radius`: a sphere is a
/// vertex with a radius, the side of a cylinder an edge with one; what is sharp has radius 0. The side of a cone is a
/// tapered edge: the ball that sweeps it shrinks to nothing at the apex, and its `rim` is the circle at the other end.
struct Feature {
  Vec3 point = Vec3::Zero();      ///< the vertex, the middle of the edge, a point of the face, the centre of the rim
  Vec3 direction = Vec3::Zero();  ///< unit: along the edge, out of the face, out of the cap that the rim bounds; 0 for
                                  ///< a vertex
  double radius = 0;              ///< swept radius of a vertex or an edge, m
  double rim = 0;                 ///< radius of the circle of a rim, or at the wide end of a tapered edge, m
  double apex = 0;                ///< tapered edge: how far its apex lies along `direction`, its wide end against it, m
  bool mark = false;              ///< a vertex that only stands for a rim which lies flat
  int part = 0;                   ///< which Part of the solid it belongs to
};

/// Whether a vertex or an edge is swept by a ball, even or tapered: its normal is not decided by what it meets alone.
inline bool isSwept(const Feature& f) { return f.radius > 0 || f.apex > 0; }

/// Rates of a feature by the dimensions of the whole shape. Directions never change with a dimension.
struct FeatureRates {
  Eigen::Matrix3Xd point;     ///< 3 x dimensions
  Eigen::RowVectorXd radius;  ///< 1 x dimensions
  Eigen::RowVectorXd rim;
  Eigen::RowVectorXd apex;  ///< empty but for a tapered edge
};

struct SolidEdge : Feature {
  double half_length = 0;     ///< m
  int from = -1, to = -1;     ///< vertices; -1 where the edge ends at a rim (side of a cylinder or cone)
  int left = -1, right = -1;  ///< faces; -1 where there is none (capsule, side of a cylinder, border of an open mesh)
  bool convex = true;  ///< false for flat and reflex edges of a mesh: nothing can touch there but what touches its
                       ///< faces too
};

struct SolidFace : Feature {
  int first = 0, count = 0;  ///< corners[first .. first + count): vertices, counter-clockwise seen from outside; none
                             ///< for a half space or a disc
  double disc = 0;           ///< radius of a disc about `point`; 0 for a polygon or a half space
  bool open = false;         ///< a face of an open mesh, which may be struck from both sides
};

/// A convex piece of a solid: what a bound on a separation is taken over. A piece is the set of all points within
/// `radius` of its core.
struct Piece {
  enum class Core : std::uint8_t {
    point,       ///< ball
    segment,     ///< capsule
    polytope,    ///< box, hull; its support points are the vertices
    triangle,    ///< of a mesh, without thickness
    frustum,     ///< round about an axis, of radius `rho` at its low end and `rho_high` at its high one
    half_space,  ///< face `faces.first`
  };
  struct Range {
    int first = 0, count = 0;
  };
  Core core = Core::point;
  double radius = 0;           ///< swept radius, m
  Vec3 center = Vec3::Zero();  ///< near the middle of the core, solid's axes
  double core_radius = 0;      ///< radius about `center` that holds the core, without `radius`
  Vec3 axis = Vec3::UnitZ();   ///< frustum: from its low to its high end, unit
  double half_length = 0;      ///< frustum, m
  double rho = 0;              ///< frustum, m
  double rho_high = 0;         ///< frustum: the same for a cylinder, 0 for a cone, m
  Range points;  ///< in Solid::points: the core's support points (point 1, segment 2, polytope, triangle 3)
  std::array<Range, 4> features;  ///< by Family, in Solid::piece_features: indices of the solid's features
};

/// A ball that holds a subtree of pieces, swept radii included.
struct Node {
  Vec3 center = Vec3::Zero();
  double radius = 0;          ///< infinite for a half space
  int left = -1, right = -1;  ///< children, or -1
  int piece = -1;             ///< of a leaf
};

/// How the features of one part of a compound (or of a whole simple shape) change with its own dimensions: dimension
/// first_dimension + k moves a point by axes * stretch_k o (axes^T (p - origin)).
struct Part {
  struct Stretch {
    Vec3 stretch = Vec3::Zero();  ///< 1/m, or 1 for a factor
    double swept = 0;             ///< rate of the radius of features that have one
    double rim = 0;               ///< rate of the radius of rims
    double apex = 0;              ///< rate of Feature::apex
  };
  Mat3 axes = Mat3::Identity();  ///< part's axes to the solid's
  Vec3 origin = Vec3::Zero();    ///< of the part, solid's axes
  int first_dimension = 0;
  std::vector<Stretch> stretches;
  std::string name;  ///< how describe() calls it: empty for a simple shape, "part 3 " in a compound
  const char* kind = "";  ///< word of the shape: "box"
  const solids::SolidKind* row = nullptr;  ///< names its features
  std::array<int, 4> firsts{};             ///< where the part's features begin, by Family
  Eigen::AlignedBox3d box;                 ///< of its vertices, part's axes, m

  int first(Family family) const { return firsts[static_cast<std::size_t>(family)]; }
};

/// A shape as collision sees it: exact double geometry, from which everything about a contact is decided. Convex or
/// not; a union of convex pieces with features that the pieces may share.
struct Solid {
  std::vector<Feature> vertices;
  std::vector<SolidEdge> edges;
  std::vector<SolidFace> faces;
  std::vector<Feature> rims;
  std::vector<int> corners;                      ///< of the faces
  std::vector<int> neighbour_first, neighbours;  ///< vertices at the other ends of the edges of vertex v:
                                                 ///< neighbours[neighbour_first[v] .. neighbour_first[v + 1])
  std::vector<Piece> pieces;
  std::vector<Vec3> points;         ///< support points of the pieces
  std::vector<int> piece_features;  ///< indices of the pieces' features
  std::vector<Node> nodes;          ///< nodes[0] is the root; its centre is the solid's origin
  std::vector<Part> parts;
  Eigen::Matrix3Xd center_rates;        ///< rate of the centre of mass in the shape by the dimensions (3 x dimensions)
  std::shared_ptr<const Shape> uneven;  ///< the shape, where these rates depend on the dimensions themselves; else null
  Vec3 half = Vec3::Zero();             ///< box: half the size
  bool ball = false;                    ///< a single ball about the origin, which looks the same from all sides
  bool box = false;                     ///< a single box about the origin
  bool plane = false;                   ///< a half space
  bool closed_mesh = false;             ///< has parts that are closed meshes: what is inside without touching overlaps

  std::size_t count(Family family) const;
  const Feature& feature(Family family, int index) const;
  /// Of a piece.
  std::span<const int> featuresOf(const Piece& piece, Family family) const {
    const Piece::Range& range = piece.features[static_cast<std::size_t>(family)];
    return {piece_features.data() + range.first, static_cast<std::size_t>(range.count)};
  }
  /// Corner i of a face, the first one after the last.
  const Vec3& corner(const SolidFace& face, int i) const {
    const int v = corners[static_cast<std::size_t>(face.first + i % face.count)];
    return vertices[static_cast<std::size_t>(v)].point;
  }
  /// Radius about the origin that holds all of it; infinite for a half space.
  double bound() const { return nodes[0].radius; }
};

/// The solid of a body, about its centre of mass when it moves.
Solid solidOf(const Body& body);

/// All that the solid of a body depends on.
struct SolidSource {
  Shape shape;
  bool fixed = false;
  std::optional<Vec3> center_of_mass;

  explicit SolidSource(const Body& body)
      : shape(body.shape), fixed(body.fixed), center_of_mass(body.center_of_mass) {}
  /// Whether a body has the same solid, to the last bit.
  bool isOf(const Body& body) const;
};

FeatureRates ratesOf(const Solid& solid, const Feature& feature);
/// Rate of FeatureRates::point, which is the same for all features, as the dimensions change; features themselves
/// follow the dimensions linearly. Empty: 0.
Eigen::Matrix3Xd pointRatesRate(const Solid& solid, const Eigen::VectorXd& dimension_rates);

/// Such as "vertex +x-y+z", "part 2 face +z", "side", "rim +z"; "ball" and "plane" for the whole. Of hulls and meshes with its
/// number and where it is or faces, in the axes of the shape: "vertex 12 at +x-z", "face 3 facing +z".
std::string nameOf(const Solid& solid, Family family, int index);

}  // namespace carom::ode_bridge_detail
