// SPDX-License-Identifier: MIT
// Surfaces made of triangles: normals, edges and integrals against solids that are known; what is refused, and where.

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <functional>
#include <limits>
#include <numbers>

#include "adjoint/base/errors.h"
#include "tests/adjoint/shapes.h"
#include "tests/support/compare.h"
#include "tests/support/exact/vector.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom {
namespace {

using namespace test;
using Real = boost::multiprecision::cpp_bin_float_100;
using Exact = exact::Vec<Real>;

Mat3 boxInertia(const Vec3& d) {
  const Vec3 q = d.cwiseAbs2() / 12;
  return Vec3(q.y() + q.z(), q.x() + q.z(), q.x() + q.y()).asDiagonal();
}

TEST(Surface, BoxOfTriangles) {
  const Vec3 size(0.3, 0.7, 1.1);
  const auto s = boxTriangles(size).surface();
  EXPECT_TRUE(s->closed);
  EXPECT_EQ(s->vertices.size(), 8u);
  ASSERT_EQ(s->faces.size(), 12u);
  ASSERT_EQ(s->edges.size(), 18u);
  expectEntries(s->volume, size.prod(), 1e-15, "volume");
  expectEntries(s->center, Vec3::Zero(), 1e-16, "center");
  expectEntries(s->unit_inertia, boxInertia(size), 1e-15, "inertia");
  for (const Surface::Face& f : s->faces) {
    EXPECT_EQ(f.normal.cwiseAbs().maxCoeff(), 1);
    EXPECT_GT(f.normal.dot(s->vertices[static_cast<std::size_t>(s->corners[static_cast<std::size_t>(f.first)])]), 0);
  }
  int flat = 0;
  for (const Surface::Edge& e : s->edges) {
    ASSERT_GE(e.left, 0);
    ASSERT_GE(e.right, 0);
    if (e.bend == 0)
      ++flat;
    else
      EXPECT_EQ(e.bend, 1);
  }
  EXPECT_EQ(flat, 6) << "one diagonal a side";
}

// The left face runs along an edge from `from` to `to`, the right one the other way.
TEST(Surface, EdgesKnowTheirFaces) {
  for (const auto& s : {torusTriangles(1, 0.3, 9, 7).surface(), ballTriangles(1, 1).surface()})
    for (const Surface::Edge& e : s->edges) {
      const auto runs = [&](int face, int from, int to) {
        const Surface::Face& f = s->faces[static_cast<std::size_t>(face)];
        for (int i = 0; i < f.count; ++i)
          if (s->corners[static_cast<std::size_t>(f.first + i)] == from &&
              s->corners[static_cast<std::size_t>(f.first + (i + 1) % f.count)] == to)
            return true;
        return false;
      };
      EXPECT_TRUE(runs(e.left, e.from, e.to));
      EXPECT_TRUE(runs(e.right, e.to, e.from));
    }
}

TEST(Surface, BendTellsConvexFromReflex) {
  // a roof of two squares over the edge from (0,0,0) to (0,1,0), each falling off by `angle`; negative: a valley
  for (double angle : {0.3, -0.3, 1.2, -1.2}) {
    const Vec3 left(-std::cos(angle), 0, -std::sin(angle)), right(std::cos(angle), 0, -std::sin(angle));
    const auto s = meshSurface({{0, 0, 0}, {0, 1, 0}, left, right}, {{0, 1, 2}, {1, 0, 3}});
    EXPECT_FALSE(s->closed);
    int inner = 0;
    for (const Surface::Edge& e : s->edges) {
      if (e.right < 0) {
        EXPECT_EQ(e.bend, 0) << "border";
        continue;
      }
      ++inner;
      expectEntries(e.bend, std::sin(2 * angle), 1e-15, "bend");
    }
    EXPECT_EQ(inner, 1);
    EXPECT_EQ(s->edges.size(), 5u);
  }
}

TEST(Surface, OffCentreTetrahedron) {
  // corners o, o + a e_x, o + b e_y, o + c e_z: V = abc/6, c = o + (a, b, c)/4,
  // covariance: 3 a^2/80 on the diagonal, -ab/80 off it
  const Vec3 d(0.4, 0.9, 1.7);
  const Mat3 covariance = (-d * d.transpose() + 4 * Mat3(d.cwiseAbs2().asDiagonal())) / 80;
  const Mat3 inertia = covariance.trace() * Mat3::Identity() - covariance;
  Random random(11);
  for (double distance : {0., 1., 1e3, 1e6}) {
    SCOPED_TRACE(distance);
    const Vec3 o = distance * Vec3(0.5, -1, 0.25);  // exact sums, so that only the integrals can lose digits
    const Vec3 r = Vec3(0.5, 1, 1.75);
    const Mat3 C = (-r * r.transpose() + 4 * Mat3(r.cwiseAbs2().asDiagonal())) / 80;
    const auto s = tetrahedron(o, o + Vec3(r.x(), 0, 0), o + Vec3(0, r.y(), 0), o + Vec3(0, 0, r.z())).surface();
    expectEntries(s->volume, r.prod() / 6, 1e-15, "volume", r.prod() / 6);
    expectEntries(s->center, o + r / 4, 1e-15, "center", 1);
    expectEntries(s->unit_inertia, C.trace() * Mat3::Identity() - C, 1e-14, "inertia");
  }
  const Quat q = random.rotation();
  const Vec3 o(0.3, -2, 5);
  const auto s = tetrahedron(Vec3::Zero(), {d.x(), 0, 0}, {0, d.y(), 0}, {0, 0, d.z()}).placed(q, o).surface();
  expectEntries(s->center, o + q * d / 4, 1e-15, "turned, center");
  expectEntries(s->unit_inertia, turned(q, inertia), 1e-14, "turned, inertia");
}

// Turning and moving a mesh turns and moves its properties.
TEST(Surface, MovesWithItsVertices) {
  Random random(12);
  const Triangles torus = torusTriangles(0.7, 0.2, 13, 8);
  const auto at_rest = torus.surface();
  for (int i = 0; i < 20; ++i) {
    const Quat q = random.rotation();
    const Vec3 x = random.vec(10);
    const auto s = torus.placed(q, x).surface();
    expectEntries(s->volume, at_rest->volume, 1e-13, "volume");
    expectEntries(s->center, x + q * at_rest->center, 1e-14, "center");
    expectEntries(s->unit_inertia, turned(q, at_rest->unit_inertia), 1e-13, "inertia");
    for (std::size_t e = 0; e < s->edges.size(); ++e)
      expectEntries(s->edges[e].bend, at_rest->edges[e].bend, 1e-13, "bend");
  }
}

// An inscribed mesh with sides of length h lacks a volume of order h^2, and so do its moments: halving h quarters the
// error, ever more exactly.
void expectSecondOrder(const std::vector<double>& errors, const char* what) {
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(errors[i - 1] / errors[i], 4, 1.2 * std::pow(4, 1 - static_cast<double>(i))) << what << ", step " << i;
}

TEST(Surface, BallConverges) {
  const double r = 0.8;
  std::vector<double> volume, inertia;
  for (int level = 0; level <= 6; ++level) {
    const auto s = ballTriangles(r, level).surface();
    EXPECT_EQ(s->vertices.size() + s->faces.size(), s->edges.size() + 2) << "Euler";
    volume.push_back(1 - s->volume / (4. / 3 * kPi * r * r * r));
    inertia.push_back(1 - s->unit_inertia(0, 0) / (0.4 * r * r));
    expectEntries(s->center, Vec3::Zero(), 1e-15, "center");
    expectEntries(s->unit_inertia, s->unit_inertia(0, 0) * Mat3::Identity(), 1e-14, "same about every axis");
  }
  expectSecondOrder(volume, "volume");
  expectSecondOrder(inertia, "inertia");
  EXPECT_LT(volume.back(), 4e-4);
}

TEST(Surface, TorusConverges) {
  // V = 2 pi^2 R r^2, I_z = R^2 + 3/4 r^2, I_x = R^2/2 + 5/8 r^2
  const double R = 0.9, r = 0.25;
  std::vector<double> volume, Iz, Ix;
  for (int n : {8, 16, 32, 64, 128}) {
    const auto s = torusTriangles(R, r, 2 * n, n).surface();
    EXPECT_EQ(s->vertices.size() + s->faces.size(), s->edges.size()) << "one hole";
    volume.push_back(1 - s->volume / (2 * kPi * kPi * R * r * r));
    Iz.push_back(1 - s->unit_inertia(2, 2) / (R * R + 0.75 * r * r));
    Ix.push_back(1 - s->unit_inertia(0, 0) / (R * R / 2 + 0.625 * r * r));
  }
  expectSecondOrder(volume, "volume");
  expectSecondOrder(Iz, "I_z");
  expectSecondOrder(Ix, "I_x");
}

TEST(Surface, HollowBall) {
  const auto s = ballTriangles(1, 3).with(ballTriangles(0.5, 3).insideOut()).surface();
  const auto ball = ballTriangles(1, 3).surface();
  expectEntries(s->volume, ball->volume * (1 - 1. / 8), 1e-14, "volume");
  expectEntries(s->unit_inertia, ball->unit_inertia * (1 - 1. / 32) / (1 - 1. / 8), 1e-14, "inertia");
}

// Two blocks far apart: the sum with parallel axes.
TEST(Surface, SeveralPieces) {
  const Vec3 size(0.25, 0.5, 1), apart(3, 0, 0);
  const auto s = boxTriangles(size).with(boxTriangles(size).placed(Quat::Identity(), apart)).surface();
  EXPECT_TRUE(s->closed);
  expectEntries(s->volume, 2 * size.prod(), 1e-14, "volume");
  expectEntries(s->center, apart / 2, 1e-14, "center");
  expectEntries(s->unit_inertia, boxInertia(size) + Mat3(Vec3(0, 2.25, 2.25).asDiagonal()), 1e-14, "inertia");
}

TEST(Surface, PlatesAndNeedles) {
  Random random(14);
  for (double thin : {1e-3, 1e-6, 1e-8}) {
    SCOPED_TRACE(thin);
    for (const Vec3& size : {Vec3(1, 1, thin), Vec3(1, thin, thin)}) {
      const auto s = boxTriangles(size).surface();
      const Vec3 found = s->unit_inertia.diagonal(), expected = boxInertia(size).diagonal();
      for (int i = 0; i < 3; ++i) expectEntries(found[i] / expected[i], 1, 1e-14, "moment, of its own size");
    }
    const Quat q = random.rotation();
    const auto plate = boxTriangles({1, 1, thin}).placed(q, random.vec(1)).surface();
    expectEntries(plate->unit_inertia, turned(q, boxInertia({1, 1, thin})), 1e-15 / thin + 1e-13, "turned plate");
  }
}

// The volume of a needle turned any way is that of its corners, however thin it is, and so is its sign.
TEST(Surface, VolumesOfTurnedNeedles) {
  Random random(15);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("seed 15, needle " + std::to_string(i));
    const double thin = std::pow(10, random.in(-5.5, -1));  // the volume's share of area x extent falls to 1e-12 below
    const auto needle = tetrahedron({0, 0, 0}, {1, 0, 0}, {random.in(0, 1), thin, 0}, {random.in(0, 1), 0, thin})
                            .placed(random.rotation(), random.vec(1));
    const auto side = [&](std::size_t k) { return Exact(needle.vertices[k]) - Exact(needle.vertices[0]); };
    const Real volume = dot(side(1), cross(side(2), side(3))) / 6;
    expectEntries(needle.surface()->volume / static_cast<double>(volume), 1, 2e-15, "volume");
    EXPECT_THROW(needle.insideOut().surface(), InputError);
  }
}

// Two pieces with one corner in common are a solid.
TEST(Surface, PiecesMayShareACorner) {
  const auto s = boxTriangles({1, 1, 1}).with(boxTriangles({1, 1, 1}).placed(Quat::Identity(), {1, 1, 1})).surface();
  EXPECT_EQ(s->vertices.size(), 15u);
  EXPECT_TRUE(s->closed);
  expectEntries(s->volume, 2, 1e-15, "volume");
}

TEST(Surface, EqualVerticesAreJoined) {
  // every triangle with corners of its own, as STL files and many glTF files have them; -0 is 0
  const Triangles box = boxTriangles({2, 2, 2}).placed(Quat::Identity(), {1, 1, 1});
  Triangles loose;
  for (const auto& t : box.triangles) {
    std::array<int, 3> own{};
    for (std::size_t k = 0; k < 3; ++k) {
      own[k] = static_cast<int>(loose.vertices.size());
      Vec3 v = box.vertices[static_cast<std::size_t>(t[k])];
      for (int i = 0; i < 3; ++i)
        if (v[i] == 0 && k == 1) v[i] = -0.;
      loose.vertices.push_back(v);
    }
    loose.triangles.push_back(own);
  }
  loose.vertices.push_back({50, 50, 50});  // no triangle uses it
  const auto s = loose.surface();
  EXPECT_EQ(s->vertices.size(), 8u);
  EXPECT_EQ(s->edges.size(), 18u);
  EXPECT_TRUE(s->closed);
  expectEntries(s->volume, 8, 1e-15, "volume");
  loose.vertices[0].x() += 1e-15;
  EXPECT_FALSE(loose.surface()->closed) << "only equal coordinates are joined";
}

TEST(Surface, OpenMeshesHaveBorders) {
  Triangles cup = boxTriangles({1, 1, 1});
  cup.triangles.resize(10);
  const auto s = cup.surface();
  EXPECT_FALSE(s->closed);
  EXPECT_EQ(std::count_if(s->edges.begin(), s->edges.end(), [](const Surface::Edge& e) { return e.right < 0; }), 4);
  EXPECT_EQ(meshSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})->edges.size(), 3u) << "one triangle";
}

TEST(Surface, PolygonsShareEdges) {
  std::vector<Vec3> corners = boxTriangles({1, 2, 3}).vertices;
  const Surface s =
      assembleSurface(corners, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
  EXPECT_EQ(s.faces.size(), 6u);
  EXPECT_EQ(s.edges.size(), 12u);
  for (const Surface::Edge& e : s.edges) EXPECT_EQ(e.bend, 1);
  expectEntries(s.volume, 6, 1e-15, "volume");
  expectEntries(s.unit_inertia, boxInertia({1, 2, 3}), 1e-15, "inertia");
}

// The normal of a sliver is as good as any other.
TEST(Surface, NormalsOfSlivers) {
  Random random(13);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE("seed 13, throw " + std::to_string(i));
    const Vec3 a = random.vec(1), along = random.vec(1), aside = random.vec(1);
    const double height = std::pow(10, random.in(-11, 0));
    const std::vector<Vec3> p = {a, a + along, a + random.in(-0.5, 1.5) * along + height * aside};
    const Exact normal = unit(cross(Exact(p[1]) - Exact(p[0]), Exact(p[2]) - Exact(p[0])));
    expectEntries(meshSurface(p, {{0, 1, 2}})->faces[0].normal, normal.rounded(), 5e-16, "normal");
  }
}

struct BadMesh {
  const char* name;
  std::function<Triangles()> make;
  std::vector<const char*> words;  ///< that the message holds
};

std::vector<BadMesh> badMeshes() {
  const auto box = [](auto&& change) {
    return [change] {
      Triangles t = boxTriangles({1, 1, 1});
      change(t);
      return t;
    };
  };
  return {
      {"nothing", [] { return Triangles{}; }, {"0 vertices", "0 triangles", "a triangle or more"}},
      {"noTriangles", box([](Triangles& t) { t.triangles.clear(); }), {"8 vertices", "a triangle or more"}},
      {"noVertices", box([](Triangles& t) { t.vertices.clear(); }), {"0 vertices", "a triangle or more"}},
      {"notANumber", box([](Triangles& t) { t.vertices[5].y() = kNan; }), {"vertex 5", "nan", "finite"}},
      {"infinite", box([](Triangles& t) { t.vertices[7].z() = -kInf; }), {"vertex 7", "-inf", "finite"}},
      {"huge", box([](Triangles& t) { t.vertices[1].x() = 2e9; }), {"vertex 1", "2000000000", "at most 1e9"}},
      {"unusedNotANumber",
       box([](Triangles& t) {
         t.vertices.push_back({0, 0, kNan});
       }),
       {"vertex 8", "nan"}},
      {"indexTooLarge", box([](Triangles& t) { t.triangles[3][1] = 8; }), {"triangle 3", "vertex 8", "0 to 7"}},
      {"indexNegative", box([](Triangles& t) { t.triangles[4][2] = -1; }), {"triangle 4", "vertex -1", "0 to 7"}},
      {"cornerTwice",
       box([](Triangles& t) { t.triangles[2][1] = t.triangles[2][0]; }),
       {"triangle 2", "two corners at the same place", "three places"}},
      {"equalCorners",
       box([](Triangles& t) {
         t.vertices.push_back(t.vertices[0]);
         t.triangles.push_back({0, 8, 1});
       }),
       {"triangle 12", "two corners at the same place"}},
      {"cornersOnALine",
       [] {
         return Triangles{{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}};
       },
       {"triangle 0", "on one line", "an area"}},
      {"almostOnALine",
       [] {
         return Triangles{{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 1e-13}}, {{0, 1, 2}}};
       },
       {"triangle 0", "on one line"}},
      {"tiny",
       [] {
         return boxTriangles({1e-90, 1e-90, 1e-90});
       },
       {"triangle 0", "a side of 1", "e-90 m", "at least 1e-30"}},
      {"tinySide",
       [] {
         return Triangles{{{0, 0, 0}, {1e-200, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
       },
       {"triangle 0", "a side of 1e-200 m", "at least 1e-30"}},
      {"threeTriangles",
       box([](Triangles& t) {
         t.vertices.push_back({9, 9, 9});
         t.triangles.push_back({0, 1, 8});
       }),
       {"edge from vertex 0 to 1", "triangles 1, 4 and 12", "at most two"}},
      {"oneTriangleTwice",
       box([](Triangles& t) { t.triangles.push_back(t.triangles[0]); }),
       {"edge from vertex", "expected at most two"}},
      {"oneTriangleTurned",
       box([](Triangles& t) { std::swap(t.triangles[6][1], t.triangles[6][2]); }),
       {"edge from vertex", " 6 ", "in one direction", "counter-clockwise"}},
      {"insideOut",
       [] {
         return boxTriangles({1, 2, 1}).insideOut();
       },
       {"inside out", "volume -2", "counter-clockwise seen from outside"}},
      {"onePieceInsideOut",
       [] {
         return boxTriangles({2, 2, 2}).with(boxTriangles({1, 1, 1}).placed(Quat::Identity(), {5, 0, 0}).insideOut());
       },
       {"triangle 12 and those joined to it", "inside out", "volume -1"}},
      {"hollowTooLarge",
       [] {
         return boxTriangles({1, 1, 1}).with(boxTriangles({2, 2, 2}).insideOut());
       },
       {"triangle 12 and those joined to it", "inside out"}},
      {"twoSidesOfASheet",
       [] {
         return Triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
       },
       {"without volume", "> 0"}},
  };
}

TEST(Surface, BadMeshesAreNamed) {
  for (const BadMesh& bad : badMeshes()) {
    SCOPED_TRACE(bad.name);
    try {
      bad.make().surface();
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      const std::string text = error.what();
      for (const char* word : bad.words)
        EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
      EXPECT_NE(text.find("found "), std::string::npos) << text;
      EXPECT_NE(text.find("expected "), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace carom
