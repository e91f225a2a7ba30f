// SPDX-License-Identifier: MIT
// Meshes that are broken in every way that files are: what is repaired, what is said of it, and that the solid is the one
// that was broken.
#include "formats/mesh/repair/mesh_repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "formats/mesh/mesh_file.h"
#include "formats/mesh/obj_reader.hpp"
#include "formats/mesh/repair/triangulate.hpp"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom {

using namespace formats_detail;

namespace {


TriangleSoup soupOf(const test::Triangles& t) { return {t.vertices, t.triangles, {}, {}}; }

/// Triangle t gets three vertices of its own, each off by up to `by` m.
void unweld(test::Triangles& mesh, std::size_t t, double by, test::Random& random) {
  for (int& v : mesh.triangles[t]) {
    mesh.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)] + random.vec(by / 2));
    v = static_cast<int>(mesh.vertices.size()) - 1;
  }
}

/// A vertex in the middle of an edge of triangle t, which the triangle beside it does not have; with a sliver between.
void splitAlone(test::Triangles& mesh, std::size_t t, bool sliver) {
  const auto [a, b, c] = mesh.triangles[t];
  const int m = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)]));
  mesh.triangles[t] = {a, m, c};
  mesh.triangles.push_back({m, b, c});
  if (sliver) mesh.triangles.push_back({a, b, m});
}

double volumeOf(const test::Triangles& mesh) { return mesh.surface()->volume; }

TEST(MeshRepair, ASweepOfBrokenSolids) {
  int unrepaired = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    test::Random random(seed);
    const int kind = random.below(3);
    const test::Triangles whole = (kind == 0   ? test::boxTriangles({random.in(0.1, 2), random.in(0.1, 2), random.in(0.1, 2)})
                             : kind == 1 ? test::ballTriangles(random.in(0.1, 2), 2)
                                         : test::torusTriangles(random.in(0.5, 2), random.in(0.1, 0.4), 12, 8))
                                .placed(random.rotation(), random.vec(3));
    test::Triangles broken = whole;
    const auto any = [&] { return static_cast<std::size_t>(random.below(static_cast<int>(broken.triangles.size()))); };
    double error = 1e-12;
    if (random.below(3) == 0) broken = broken.insideOut();
    // a hole that is small beside the rest
    if (kind != 0 && random.below(3) == 0)
      broken.triangles.erase(broken.triangles.begin() + static_cast<std::ptrdiff_t>(any()));
    if (random.below(3) == 0) splitAlone(broken, any(), random.below(2) == 0);
    if (random.below(3) == 0) broken.triangles.push_back(broken.triangles[any()]);
    if (random.below(3) == 0) unweld(broken, any(), 2e-7, random), error = 1e-5;
    if (random.below(2) == 0) {
      auto& turned = broken.triangles[any()];
      std::swap(turned[1], turned[2]);
    }
    const RepairedSurface repaired = surfaceOf(soupOf(broken), true);
    unrepaired += repaired.repairs.empty();
    std::string told;
    for (const std::string& repair : repaired.repairs) told += repair + '\n';
    ASSERT_TRUE(repaired.surface->closed) << told;
    const double expected = volumeOf(whole);
    EXPECT_TRUE(std::abs(repaired.surface->volume - expected) <= error * expected)
        << repaired.surface->volume << ", expected " << expected << '\n' << told;
  }
  EXPECT_LE(unrepaired, 100);
}

/// Of two boxes of a metre that share an edge along z, the second on the far side of it.
const char* const kTwoBoxes =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
    "v 2 1 0\nv 2 2 0\nv 1 2 0\nv 2 1 1\nv 2 2 1\nv 1 2 1\n"
    "f 3 11 10 9\nf 7 12 13 14\nf 3 9 12 7\nf 9 10 13 12\nf 10 11 14 13\nf 11 3 7 14\n";

Body thrownSolid(const Shape& shape) {
  Body body;
  body.name = "body", body.shape = shape, body.density = 700, body.material = "m";
  body.position = {0.2, -0.1, 2}, body.velocity = {0.4, 0.1, 0}, body.angular_velocity = {1, 2, -0.7};
  return body;
}

TEST(MeshRepair, AnEdgeOfFourTrianglesIsThatOfTwoSolids) {
  const RepairedSurface repaired = surfaceOf(parseObj(kTwoBoxes), true);
  ASSERT_TRUE(repaired.surface->closed);
  ASSERT_EQ(repaired.repairs.size(), 1u);
  EXPECT_EQ(repaired.repairs[0],
            "1 edge of more than two triangles parted between the solids that meet there (the first at (1, 1, 0.5) m)");
  // It moves as the compound of the two boxes does.
  Compound boxes;
  boxes.parts = {{Box{{1, 1, 1}}, {0.5, 0.5, 0.5}}, {Box{{1, 1, 1}}, {1.5, 1.5, 0.5}}};
  Motion motions[2];
  for (const bool compound : {false, true}) {
    Body floor;
    floor.name = "floor", floor.fixed = true, floor.material = "m", floor.shape = Plane{};
    const Scene scene = test::makeScene({0, 0, -9.81}, 0.6, 0.4, {floor, thrownSolid(compound ? Shape(boxes) : Shape(Mesh{repaired.surface, 1, ""}))});
    motions[compound] = test::play(scene, 1.6);
  }
  ASSERT_GE(motions[0].events.size(), 3u);
  ASSERT_EQ(motions[0].events.size(), motions[1].events.size());
  EXPECT_TRUE((motions[0].stateAt("body", 1.6).position - motions[1].stateAt("body", 1.6).position).norm() <= 1e-10);
}

struct RepairKind {
  const char* what;
  std::string text;
  bool solid;
  double volume;  ///< m^3; 0: the surface is open
  std::string repair;
};

TEST(MeshRepair, EveryKindIsTold) {
  const std::string box =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const std::string top = "f 5 6 7 8\n";
  const RepairKind kinds[] = {
      {"as it is", box + top, true, 1, ""},
      {"open, of a fixed body", box, false, 0, ""},
      {"a face turned over", box + "f 8 7 6 5\n", true, 1, "2 triangles turned over to look the way of those beside them (the first at line 14)"},
      {"a triangle twice", box + top + "f 1 2 6\n", false, 1, "1 triangle written twice dropped (the first at line 15)"},
      {"a point", box + top + "f 1 1 2\n", false, 1, "1 triangle with two corners at one place dropped (the first at line 15)"},
      {"a sliver", box + "v 0.5 0 1\nf 5 9 7 8\nf 9 6 7\nf 5 6 9\n", true, 1,
       "1 triangle with corners on one line dropped (the first at line 17)"},
      {"a vertex on an edge", box + "v 0.5 0 1\nf 5 9 7 8\nf 9 6 7\n", true, 1, "1 edge split at a vertex on it"},
      {"a vertex beside its own", box + "v 0 1 1.0000001\nf 5 6 7 9\n", true, 1, "1 vertex welded to another at most 1e-07 m away"},
      {"a sheet from both sides", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n", false, 0,
       "1 triangle covering others from behind dropped (the first at line 5)"},
      {"a wall between two boxes",
       box + top + "v 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\nf 5 8 7 6\nf 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n", true, 2,
       "4 triangles between solids that meet there dropped (the first at line 14)"},
      {"a small hole", box + "v 0.4 0.4 1\nv 0.6 0.4 1\nv 0.6 0.6 1\nv 0.4 0.6 1\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n", true, 1,
       "1 hole closed, 0.04 m^2 in all (0.28 m across, around (0.5, 0.5, 1) m)"},
      {"a fin", box + top + "v 1.1 0 0\nf 2 9 6\n", false, 0, "1 edge where triangles bound no solid together cut open (the first at (1, 0, 0.5) m)"},
      {"a small fin", box + top + "v 1.01 0 0\nf 2 9 6\n", true, 1, "1 triangle that bound no solid dropped, less than 1 % of the area (the first at line 16)"},
      {"inside out", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 6\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n", true, 1, "the mesh turned inside out"},
      {"an edge alone", box + top + "f 1 2\n", true, 1, "1 face of fewer than three corners left out (the first at line 15)"},
  };
  for (const RepairKind& kind : kinds) {
    SCOPED_TRACE(kind.what);
    const TriangleSoup soup = parseObj(kind.text);
    RepairedSurface repaired = surfaceOf(soup, kind.solid);
    repaired.repairs.insert(repaired.repairs.begin(), soup.repairs.begin(), soup.repairs.end());
    EXPECT_EQ(repaired.surface->closed, kind.volume > 0);
    EXPECT_TRUE(std::abs(repaired.surface->volume - kind.volume) <= 1e-6) << repaired.surface->volume;
    std::string all;
    for (const std::string& repair : repaired.repairs) all += repair + '\n';
    if (kind.repair.empty()) EXPECT_EQ(all, "");
    else EXPECT_NE(all.find(kind.repair), std::string::npos) << all;
  }
}

TEST(MeshRepair, ALargeHoleStaysAndIsNamed) {
  std::string tube;  // open at one end: its lid would be a tenth of it
  tube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const RepairedSurface found = surfaceOf(parseObj(tube), true);
  EXPECT_FALSE(found.surface->closed);
  EXPECT_TRUE(found.repairs.empty());
  Scene scene;
  scene.bodies = {thrownSolid(Mesh{found.surface, 1, ""})};
  scene.bodies[0].material.clear();
  try {
    validate(scene);
    ADD_FAILURE() << "was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("an open mesh (a hole 1.41 m across, around (0.5, 0.5, 2) m)"), std::string::npos)
        << error.what();
  }
}

/// A star of 2 n corners about the origin, flat, turned in space: from no corner of it all others are seen.
std::vector<Vec3> starOf(int n, test::Random& random) {
  const Quat turn = random.rotation();
  std::vector<Vec3> star;
  for (int k = 0; k < 2 * n; ++k) {
    const double r = k % 2 == 0 ? random.in(0.8, 1) : random.in(0.2, 0.3), angle = k * 3.14159265358979 / n;
    star.push_back(turn * Vec3(r * std::cos(angle), r * std::sin(angle), 0));
  }
  return star;
}

TEST(MeshRepair, PolygonsOfAnyKindAreFilled) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    test::Random random(seed);
    const std::vector<Vec3> star = starOf(3 + random.below(20), random);
    const auto triangles = mesh_repair::triangulate(star);
    ASSERT_EQ(triangles.size(), star.size() - 2);
    Vec3 whole = Vec3::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < star.size(); ++k) whole += 0.5 * star[k].cross(star[(k + 1) % star.size()]);
    for (const auto& t : triangles) {
      const auto at = [&](std::size_t i) -> const Vec3& { return star[static_cast<std::size_t>(t[i])]; };
      const Vec3 area = 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
      sum += area.norm();
      EXPECT_GT(area.dot(whole), 0);
    }
    EXPECT_TRUE(std::abs(sum - whole.norm()) <= 1e-12) << sum << ", expected " << whole.norm();
  }
}

/// Files of other projects, which are not part of this one.
TEST(MeshRepair, PublicFiles) {
  const char* folder = std::getenv("CAROM_OBJ_SAMPLES");
  if (!folder) GTEST_SKIP() << "CAROM_OBJ_SAMPLES is not set";
  int count = 0, solids = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    SCOPED_TRACE(entry.path().filename().string());
    ++count;
    const TriangleSoup soup = readMeshFile(entry.path().string());
    EXPECT_FALSE(surfaceOf(soup, false).surface->faces.empty());
    const RepairedSurface solid = surfaceOf(soup, true);
    solids += solid.surface->closed && solid.surface->volume > 0;
    const std::vector<Vec3> points = readPointsFile(entry.path().string());
    if (points.size() > 4) EXPECT_TRUE(convexHull(points)->closed);
  }
  EXPECT_GE(count, 1);
  EXPECT_GE(solids, 0.8 * count);
}

TEST(MeshRepair, PolygonsOfAnObjFile) {
  // A U, a quadrilateral that comes round twice, corners at the place of the one before, a line and back.
  const std::string u = "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 2 2 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
  EXPECT_EQ(parseObj(u + "f 1 2 3 4 5 6 7 8\n").triangles.size(), 6u);
  EXPECT_EQ(parseObj(u + "f 1 2 3 8 1 2 3 8\n").triangles.size(), 2u);
  EXPECT_EQ(parseObj(u + "f 1 1 2 3 8 8\n").triangles.size(), 2u);
  EXPECT_THROW(surfaceOf(parseObj(u + "f 1 2 1 2\n"), false), InputError);
  EXPECT_EQ(parseObjPoints(u + "v 9 9 9\nf 1 2 3 4 5 6 7 8\nf 1 2\n").size(), 8u);
}

}  // namespace
}  // namespace carom
