// SPDX-License-Identifier: MIT
// Features of the solids of every kind of shape and their rates, against formulas of their own.

#include "ode_bridge/solids/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "tests/ode_bridge/solid_rows.h"
#include "tests/support/compare.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using namespace test;

// Support function of a shape about its origin.
double extentOf(const Shape& shape, const Vec3& d) {
  if (const auto* s = std::get_if<Sphere>(&shape)) return s->radius * d.norm();
  if (const auto* s = std::get_if<Box>(&shape)) return 0.5 * s->size.dot(d.cwiseAbs());
  if (const auto* s = std::get_if<Capsule>(&shape)) return s->radius * d.norm() + s->height / 2 * std::abs(d.z());
  if (const auto* s = std::get_if<Cylinder>(&shape))
    return s->radius * std::hypot(d.x(), d.y()) + s->height / 2 * std::abs(d.z());
  if (const auto* s = std::get_if<Cone>(&shape))
    return std::max(s->radius * std::hypot(d.x(), d.y()) - s->height / 2 * d.z(), s->height / 2 * d.z());
  double most = -std::numeric_limits<double>::infinity();
  if (const auto* s = std::get_if<Compound>(&shape)) {
    for (const CompoundPart& p : s->parts)
      most = std::max(most, d.dot(p.position) + extentOf(p.shape, p.orientation.conjugate() * d));
    return most;
  }
  const auto* hull = std::get_if<Hull>(&shape);
  const Surface& surface = hull ? *hull->surface : *std::get<Mesh>(shape).surface;
  for (const Vec3& v : surface.vertices) most = std::max(most, d.dot(v));
  return most * (hull ? hull->scale : std::get<Mesh>(shape).scale);
}

Vec3 centerOf(const Body& body) {
  if (body.fixed) return Vec3::Zero();
  if (body.center_of_mass) return *body.center_of_mass;
  const ShapeKind& kind = kindOf(body.shape);
  return kind.solid(body.shape) ? kind.properties(body.shape).center : Vec3(Vec3::Zero());
}

double discExtent(const Vec3& center, const Vec3& axis, double radius, const Vec3& d) {
  return d.dot(center) + radius * axis.cross(d).norm();
}

double pieceExtent(const Solid& solid, const Piece& piece, const Vec3& d) {
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < piece.points.count; ++i) most = std::max(most, d.dot(solid.points[at(piece.points.first + i)]));
  if (piece.core == Piece::Core::frustum)
    for (double side : {-1., 1.})
      most = std::max(most, discExtent(piece.center + side * piece.half_length * piece.axis, piece.axis,
                                       side < 0 ? piece.rho : piece.rho_high, d));
  return most + piece.radius;
}

TEST(Solids, ExtentsOfFeaturesAndPieces) {
  for (const SolidRow& row : solidRows(51)) {
    SCOPED_TRACE(row.name + ", seed 51");
    const Solid solid = solidOf(row.body);
    Random random(52);
    for (int i = 0; i < 200; ++i) {
      const Vec3 d = i < 6 ? Vec3((i % 2 ? 1 : -1) * Vec3::Unit(i / 2)) : random.unit();
      const double expected = extentOf(row.body.shape, d) - d.dot(centerOf(row.body));
      double features = -std::numeric_limits<double>::infinity(), pieces = features;
      for (const Feature& v : solid.vertices) features = std::max(features, d.dot(v.point) + v.radius);
      for (const Feature& r : solid.rims) features = std::max(features, discExtent(r.point, r.direction, r.rim, d));
      for (const Piece& p : solid.pieces) pieces = std::max(pieces, pieceExtent(solid, p, d));
      expectEntries(features, expected, 1e-14, "features");
      expectEntries(pieces, expected, 1e-14, "pieces");
      ASSERT_LE(expected, solid.bound());
    }
  }
}

// Rates against central differences of the whole construction; directions stay.
TEST(Solids, RatesByEveryDimension) {
  for (const SolidRow& row : solidRows(53)) {
    SCOPED_TRACE(row.name + ", seed 53");
    const Solid solid = solidOf(row.body);
    const ShapeKind& kind = kindOf(row.body.shape);
    const Eigen::VectorXd dimensions = kind.dimensions(row.body.shape);
    ASSERT_EQ(solid.center_rates.cols(), dimensions.size());
    for (Eigen::Index c = 0; c < dimensions.size(); ++c) {
      const double h = 1e-5 * dimensions[c];
      const auto moved = [&](double by) {
        Body body = row.body;
        Eigen::VectorXd values = dimensions;
        values[c] += by;
        kind.setDimensions(body.shape, values);
        return solidOf(body);
      };
      const Solid low = moved(-h), high = moved(h);
      for (Family family : {Family::vertex, Family::edge, Family::face, Family::rim}) {
        const int sizes[] = {count(solid.vertices), count(solid.edges), count(solid.faces), count(solid.rims)};
        for (int i = 0; i < sizes[static_cast<int>(family)]; ++i) {
          const Feature &a = low.feature(family, i), &b = high.feature(family, i);
          const FeatureRates rates = ratesOf(solid, solid.feature(family, i));
          const std::string what = nameOf(solid, family, i) + " by " + kind.dimension_names(row.body.shape)[at(int(c))];
          expectEntries(rates.point.col(c), (b.point - a.point) / (2 * h), 1e-7, what + ", point");
          expectEntries(rates.radius[c], (b.radius - a.radius) / (2 * h), 1e-7, what + ", radius");
          expectEntries(rates.rim[c], (b.rim - a.rim) / (2 * h), 1e-7, what + ", rim");
          const double apex = rates.apex.size() > 0 ? rates.apex[c] : 0;
          expectEntries(apex, (b.apex - a.apex) / (2 * h), 1e-7, what + ", apex");
          EXPECT_EQ(a.direction, b.direction) << what;
        }
      }
      if (HasFailure()) return;
    }
  }
}

// The sides of all faces, by their two vertices in the order in which the face runs along them.
std::map<std::pair<int, int>, int> sidesOf(const Solid& solid) {
  std::map<std::pair<int, int>, int> sides;
  for (int f = 0; f < count(solid.faces); ++f) {
    const SolidFace& face = solid.faces[at(f)];
    for (int i = 0; i < face.count; ++i) {
      const auto corner = [&](int k) { return solid.corners[at(face.first + k % face.count)]; };
      EXPECT_TRUE(sides.emplace(std::pair(corner(i), corner(i + 1)), f).second) << "a side of two faces";
    }
  }
  return sides;
}

TEST(Solids, EdgesJoinFacesAndVertices) {
  for (const SolidRow& row : solidRows(54)) {
    SCOPED_TRACE(row.name + ", seed 54");
    const Solid solid = solidOf(row.body);
    auto sides = sidesOf(solid);
    int borders = 0;
    for (int i = 0; i < count(solid.edges); ++i) {
      const SolidEdge& e = solid.edges[at(i)];
      if (e.from < 0) {  // the side of a cylinder or a cone
        EXPECT_TRUE(e.to == -1 && e.left == -1 && e.right == -1 && e.convex && isSwept(e));
        continue;
      }
      const Vec3 half = e.half_length * e.direction;
      expectEntries(e.point - half, solid.vertices[at(e.from)].point, 1e-14, "from");
      expectEntries(e.point + half, solid.vertices[at(e.to)].point, 1e-14, "to");
      EXPECT_EQ(e.radius, solid.vertices[at(e.from)].radius);
      if (e.left < 0) continue;  // of a capsule
      EXPECT_EQ(sides.extract(std::pair(e.from, e.to)).mapped(), e.left);
      if (e.right < 0) {
        ++borders;
        EXPECT_TRUE(e.convex);
        continue;
      }
      EXPECT_EQ(sides.extract(std::pair(e.to, e.from)).mapped(), e.right);
      const SolidFace& left = solid.faces[at(e.left)];
      const double bend = left.direction.cross(solid.faces[at(e.right)].direction).dot(e.direction);
      EXPECT_EQ(e.convex, std::string(solid.parts[at(e.part)].kind) == "mesh" ? bend > 1e-9 : true);
    }
    EXPECT_TRUE(sides.empty()) << "a side without edge";
    EXPECT_EQ(borders, row.name.starts_with("open") ? 6 : 0);
  }
}

TEST(Solids, FacesBoundTheirParts) {
  for (const SolidRow& row : solidRows(55)) {
    SCOPED_TRACE(row.name + ", seed 55");
    const Solid solid = solidOf(row.body);
    for (int f = 0; f < count(solid.faces); ++f) {
      const SolidFace& face = solid.faces[at(f)];
      expectEntries(face.direction.norm(), 1, 1e-14, "normal");
      EXPECT_EQ(face.open, row.name.starts_with("open"));
      const bool convex = std::string(solid.parts[at(face.part)].kind) != "mesh";
      for (const Feature& v : solid.vertices) {
        if (!convex || v.part != face.part) continue;
        ASSERT_LE(face.direction.dot(v.point - face.point), 1e-12) << nameOf(solid, Family::face, f);
      }
      Vec3 area = Vec3::Zero();
      const auto corner = [&](int k) { return solid.vertices[at(solid.corners[at(face.first + k)])].point; };
      for (int i = 0; i < face.count; ++i) {
        EXPECT_LE(std::abs(face.direction.dot(corner(i) - face.point)), 1e-12);
        area += (corner(i) - face.point).cross(corner((i + 1) % face.count) - face.point);
      }
      if (face.count > 0) expectEntries(area.normalized(), face.direction, 1e-9, "counter-clockwise");
    }
  }
}

TEST(Solids, NeighboursAreTheOtherEndsOfEdges) {
  for (const SolidRow& row : solidRows(56)) {
    SCOPED_TRACE(row.name + ", seed 56");
    const Solid solid = solidOf(row.body);
    std::vector<std::multiset<int>> expected(solid.vertices.size());
    for (const SolidEdge& e : solid.edges)
      if (e.from >= 0) expected[at(e.from)].insert(e.to), expected[at(e.to)].insert(e.from);
    ASSERT_EQ(solid.neighbour_first.size(), solid.vertices.size() + 1);
    for (int v = 0; v < count(solid.vertices); ++v) {
      const auto first = solid.neighbours.begin();
      EXPECT_EQ(std::multiset<int>(first + solid.neighbour_first[at(v)], first + solid.neighbour_first[at(v + 1)]),
                expected[at(v)]);
      const std::string kind = solid.parts[at(solid.vertices[at(v)].part)].kind;
      EXPECT_EQ(expected[at(v)].size() > 0, kind != "sphere" && kind != "cylinder" && kind != "cone");
    }
  }
}

TEST(Solids, WholesAreMarked) {
  for (const SolidRow& row : solidRows(61)) {
    SCOPED_TRACE(row.name);
    const Solid solid = solidOf(row.body);
    const bool centred = !row.body.center_of_mass;
    EXPECT_EQ(solid.ball, centred && row.name.starts_with("sphere"));
    EXPECT_EQ(solid.box, centred && row.name.starts_with("box"));
    EXPECT_FALSE(solid.plane);
    EXPECT_EQ(solid.closed_mesh, row.name.starts_with("mesh") || row.name.starts_with("nested"));
  }
  Body body = makeBall("body", 1, {0, 0, 0});
  body.shape = Compound{{{Sphere{0.3}, Vec3::Zero(), Quat::Identity()}}};
  EXPECT_FALSE(solidOf(body).ball);
  body.shape = Box{{1, 2, 3}};
  EXPECT_EQ(solidOf(body).half, Vec3(0.5, 1, 1.5));
}

TEST(Solids, HalfSpace) {
  const Vec3 normal = Vec3(1, -2, 2) / 3;
  const Solid solid = solidOf(makePlane("floor", normal, 0.6));
  EXPECT_TRUE(solid.plane);
  EXPECT_EQ(solid.bound(), std::numeric_limits<double>::infinity());
  ASSERT_EQ(solid.faces.size(), 1u);
  EXPECT_EQ(solid.faces[0].direction, normal);
  EXPECT_EQ(solid.faces[0].point, 0.6 * normal);
  EXPECT_EQ(solid.faces[0].count, 0);
  ASSERT_EQ(solid.pieces.size(), 1u);
  EXPECT_EQ(solid.pieces[0].core, Piece::Core::half_space);
  EXPECT_EQ(ratesOf(solid, solid.faces[0]).point.cols(), 0);
}

TEST(Solids, Names) {
  const auto name = [](const Shape& shape, Family family, int index) {
    Body body = makeBall("body", 1, {0, 0, 0});
    body.shape = shape;
    return nameOf(solidOf(body), family, index);
  };
  EXPECT_EQ(name(Sphere{}, Family::vertex, 0), "ball");
  EXPECT_EQ(nameOf(solidOf(makePlane("floor", {0, 0, 1}, 0)), Family::face, 0), "plane");
  EXPECT_EQ(name(Box{}, Family::vertex, 5), "vertex +x-y+z");
  EXPECT_EQ(name(Box{}, Family::face, 5), "face +z");
  EXPECT_EQ(name(Box{}, Family::edge, 1), "edge +y-z");
  EXPECT_EQ(name(Box{}, Family::edge, 10), "edge -x+y");
  EXPECT_EQ(name(Capsule{}, Family::edge, 0), "side");
  EXPECT_EQ(name(Capsule{}, Family::vertex, 1), "end +z");
  EXPECT_EQ(name(Cylinder{}, Family::edge, 0), "side");
  EXPECT_EQ(name(Cylinder{}, Family::rim, 1), "rim +z");
  EXPECT_EQ(name(Cylinder{}, Family::face, 0), "cap -z");
  EXPECT_EQ(name(Cylinder{}, Family::vertex, 6), "mark 2 of rim +z");
  EXPECT_EQ(name(Cone{}, Family::vertex, 4), "apex");
  EXPECT_EQ(name(Cone{}, Family::vertex, 2), "mark 2 of rim");
  EXPECT_EQ(name(Cone{}, Family::edge, 0), "side");
  EXPECT_EQ(name(Cone{}, Family::face, 0), "base");
  EXPECT_EQ(name(Cone{}, Family::rim, 0), "rim");
  Random random(62);
  EXPECT_EQ(name(randomHull(random, 9), Family::face, 3), "face 3 facing +y");
  EXPECT_EQ(name(bentStrip(1), Family::edge, 7), "edge 7 at +x+y");
  const CompoundPart box{Box{}, Vec3::Zero(), Quat::Identity()}, ball{Sphere{}, Vec3::Zero(), Quat::Identity()};
  const CompoundPart inner{Compound{{ball, box}}, Vec3::Zero(), Quat::Identity()};
  EXPECT_EQ(name(Compound{{box, inner, box}}, Family::face, 5), "part 0 face +z");
  EXPECT_EQ(name(Compound{{box, inner, box}}, Family::vertex, 8), "part 1 part 0 ball");
  EXPECT_EQ(name(Compound{{box, inner, box}}, Family::face, 6), "part 1 part 1 face -x");
  EXPECT_EQ(name(Compound{{box, inner, box}}, Family::vertex, 17), "part 2 vertex -x-y-z");
}

}  // namespace
}  // namespace carom
