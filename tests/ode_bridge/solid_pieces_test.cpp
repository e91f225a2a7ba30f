// SPDX-License-Identifier: MIT
// The convex pieces of solids, and the tree of balls about them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "ode_bridge/solids/solid.hpp"
#include "tests/ode_bridge/solid_rows.h"
#include "tests/support/compare.h"
#include "tests/support/solids.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using namespace test;

// A point of the swept surface of a piece, or of its inside.
Vec3 pointOf(const Solid& solid, const Piece& piece, Random& random) {
  Vec3 p = Vec3::Zero();
  if (piece.core == Piece::Core::frustum) {
    const Vec3 across = piece.axis.cross(random.unit()).normalized();
    const bool high = random.below(2);
    p = piece.center + (high ? 1 : -1) * piece.half_length * piece.axis + (high ? piece.rho_high : piece.rho) * across;
  } else if (random.below(2)) {
    p = solid.points[at(piece.points.first + random.below(piece.points.count))];
  } else {
    double sum = 0;
    for (int i = 0; i < piece.points.count; ++i) {
      const double weight = random.in(0, 1);
      p += weight * solid.points[at(piece.points.first + i)];
      sum += weight;
    }
    p /= sum;
  }
  return p + piece.radius * random.unit();
}

// Every piece below exactly one leaf, every ball on the way to it holds it, no path longer than halving needs.
void expectTree(const Solid& solid, std::uint64_t seed, int points) {
  Random random(seed);
  std::vector<int> leaves(solid.pieces.size(), 0), visits(solid.nodes.size(), 0);
  const int deepest = static_cast<int>(std::ceil(std::log2(static_cast<double>(solid.pieces.size()))));
  const std::function<void(int, std::vector<int>)> descend = [&](int n, std::vector<int> path) {
    const Node& node = solid.nodes[at(n)];
    ++visits[at(n)];
    path.push_back(n);
    if (node.piece < 0) {
      descend(node.left, path);
      descend(node.right, path);
      return;
    }
    EXPECT_TRUE(node.left == -1 && node.right == -1);
    EXPECT_LE(count(path) - 1, deepest);
    ++leaves[at(node.piece)];
    for (int i = 0; i < points; ++i) {
      const Vec3 p = pointOf(solid, solid.pieces[at(node.piece)], random);
      for (int above : path)
        ASSERT_LE((p - solid.nodes[at(above)].center).norm(), solid.nodes[at(above)].radius * (1 + 1e-15))
            << "node " << above;
    }
  };
  descend(0, {});
  EXPECT_EQ(leaves, std::vector<int>(solid.pieces.size(), 1));
  EXPECT_EQ(visits, std::vector<int>(solid.nodes.size(), 1));
  EXPECT_EQ(solid.nodes[0].center, Vec3::Zero());
}

TEST(SolidPieces, TreeHoldsAllPieces) {
  for (const SolidRow& row : solidRows(57)) {
    SCOPED_TRACE(row.name + ", seed 57");
    const Solid solid = solidOf(row.body);
    expectTree(solid, 58, 50);
    if (row.body.fixed && !std::holds_alternative<Compound>(row.body.shape))
      expectEntries(solid.bound(), kindOf(row.body.shape).boundingRadius(row.body.shape), 1e-14, "bound");
  }
}

// Balls shrink as they should: of an even mesh of a ball, the share 1/2^k has the area of a disc of radius 2/2^(k/2),
// and no ball about such a share is more than two and a half times as large.
TEST(SolidPieces, TreeOfManyTriangles) {
  Body body = makeBall("ball", 1, {0, 0, 0});
  body.shape = Mesh{ballTriangles(1, 5).surface(), 1, ""};
  const Solid solid = solidOf(body);
  ASSERT_EQ(solid.pieces.size(), 20480u);
  expectTree(solid, 59, 1);
  const Solid again = solidOf(body);
  for (std::size_t n = 0; n < solid.nodes.size(); ++n) {
    ASSERT_EQ(solid.nodes[n].piece, again.nodes[n].piece);
    ASSERT_EQ(solid.nodes[n].radius, again.nodes[n].radius);
  }
  const std::function<double(int, int)> largest = [&](int n, int depth) -> double {
    const Node& node = solid.nodes[at(n)];
    return depth == 0 ? node.radius : std::max(largest(node.left, depth - 1), largest(node.right, depth - 1));
  };
  for (int depth : {3, 6, 8, 11}) EXPECT_LT(largest(0, depth), 2.5 * 2 / std::exp2(0.5 * depth)) << "depth " << depth;
}

// Pieces name what they are made of; nothing is left out; a piece's own ball holds its core.
TEST(SolidPieces, PiecesListTheirFeatures) {
  for (const SolidRow& row : solidRows(60)) {
    SCOPED_TRACE(row.name + ", seed 60");
    const Solid solid = solidOf(row.body);
    std::set<int> vertices, edges, faces, rims;
    for (const Piece& p : solid.pieces) {
      const auto index = [&](Family family, int i) { return solid.featuresOf(p, family)[at(i)]; };
      for (int v : solid.featuresOf(p, Family::vertex)) vertices.insert(v);
      for (int e : solid.featuresOf(p, Family::edge)) edges.insert(e);
      for (int f : solid.featuresOf(p, Family::face)) faces.insert(f);
      for (int r : solid.featuresOf(p, Family::rim)) rims.insert(r);
      for (int i = 0; i < p.points.count; ++i) {
        const Vec3& point = solid.points[at(p.points.first + i)];
        EXPECT_EQ(point, solid.vertices[at(index(Family::vertex, i))].point);
        EXPECT_LE((point - p.center).norm(), p.core_radius);
      }
      if (p.core != Piece::Core::triangle) continue;
      for (int i = 0; i < 3; ++i) {
        const SolidEdge& e = solid.edges[at(index(Family::edge, i))];
        EXPECT_EQ((std::set<int>{e.from, e.to}),
                  (std::set<int>{index(Family::vertex, i), index(Family::vertex, (i + 1) % 3)}));
        EXPECT_TRUE(e.left == index(Family::face, 0) || e.right == index(Family::face, 0));
      }
    }
    EXPECT_EQ(vertices.size(), solid.vertices.size());
    EXPECT_EQ(edges.size(), solid.edges.size());
    EXPECT_EQ(faces.size(), solid.faces.size());
    EXPECT_EQ(rims.size(), solid.rims.size());
  }
}

TEST(SolidPieces, BallsAboutTriangles) {
  const auto radius = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    Body body = fixedBody(makeBall("triangle", 1, {0, 0, 0}));
    body.shape = Mesh{meshSurface({a, b, c}, {{0, 1, 2}}), 2, ""};
    return solidOf(body).pieces[0].core_radius;
  };
  const double h = std::sqrt(3) / 2;
  expectEntries(radius({-0.5, 0, 0}, {0.5, 0, 0}, {0, h, 0}), 4 * h / 3, 1e-14, "equal sides");
  expectEntries(radius({0, 0, 0}, {3, 0, 0}, {0, 0, 4}), 5, 1e-14, "right angle");
  expectEntries(radius({0, 0, 0}, {0.1, 0.2, 0}, {0, 2, 0}), 2, 1e-14, "wide angle");
  expectEntries(radius({-1e-6, 0, 0}, {1e-6, 0, 0}, {0, 1, 0}), 1, 1e-9, "sliver");
}

}  // namespace
}  // namespace carom
