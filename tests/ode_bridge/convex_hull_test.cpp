// SPDX-License-Identifier: MIT
// Convex hulls: known solids, what every hull keeps, points that are hard on rounding, what is refused.

#include "ode_bridge/convex_hull.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <thread>

#include "adjoint/base/errors.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom {
namespace {

using namespace test;

const double kNotANumber = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

double sizeOf(const std::vector<Vec3>& points) {
  Vec3 low = points[0], high = low;
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

const Vec3& corner(const Surface& s, const Surface::Face& f, int i) {
  return s.vertices[static_cast<std::size_t>(s.corners[static_cast<std::size_t>(f.first + i % f.count)])];
}

// Volume as a sum of tetrahedra over one vertex, by determinants.
double volumeOf(const Surface& s) {
  double sum = 0;
  for (const Surface::Face& f : s.faces)
    for (int i = 1; i + 1 < f.count; ++i) {
      Mat3 sides;
      sides << corner(s, f, 0) - s.vertices[0], corner(s, f, i) - s.vertices[0], corner(s, f, i + 1) - s.vertices[0];
      sum += sides.determinant() / 6;
    }
  return sum;
}

// Closed, the topology of a ball, convex with every point inside, vertices that are points in their order.
void expectHull(const Surface& s, const std::vector<Vec3>& points) {
  const double size = sizeOf(points);
  EXPECT_TRUE(s.closed);
  EXPECT_EQ(s.vertices.size() + s.faces.size(), s.edges.size() + 2) << "Euler";
  for (const Surface::Face& f : s.faces) {
    expectEntries(f.normal.norm(), 1, 1e-15, "unit normal");
    for (const Vec3& p : points)
      ASSERT_LE(f.normal.dot(p - corner(s, f, 0)), 1e-12 * size) << "point " << p.transpose();
    for (int i = 0; i < f.count; ++i)
      EXPECT_LE(std::abs(f.normal.dot(corner(s, f, i) - corner(s, f, 0))), 1e-12 * size);
  }
  double farthest = 0;
  for (const Vec3& p : points) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  for (const Surface::Edge& e : s.edges) {
    const double length =
        (s.vertices[static_cast<std::size_t>(e.to)] - s.vertices[static_cast<std::size_t>(e.from)]).norm();
    EXPECT_GE(length, 1e-13 * size);
    EXPECT_GE(e.bend * length, -std::max(1e-14 * size, 1e-15 * farthest)) << "reflex";
  }
  auto next = points.begin();
  for (const Vec3& v : s.vertices) {
    next = std::find(next, points.end(), v);
    ASSERT_NE(next, points.end()) << "a vertex that is no point, or out of order";
    ++next;
  }
  std::vector<int> faces_at(s.vertices.size(), 0);
  for (int v : s.corners) ++faces_at[static_cast<std::size_t>(v)];
  for (int count : faces_at) EXPECT_GE(count, 3) << "a vertex on an edge";
  expectEntries(s.volume, volumeOf(s), 1e-12, "volume", size * size * size);
}

TEST(ConvexHull, CubeAndPointsInside) {
  Random random(31);
  const std::vector<Vec3> corners = boxTriangles({1, 2, 3}).vertices;
  std::vector<Vec3> points = {{0, 0, 0}};                                                // inside
  for (const Vec3& c : corners) points.insert(points.end(), {c, c / 2});                 // half way to the middle
  points.insert(points.end(), {{0.5, 0, 0}, {0, 1, 0}, {0.5, 1, 0}, {0.5, 0.25, 1.5}});  // on faces and edges
  points.insert(points.end(), corners.begin(), corners.end());                           // all a second time
  for (int i = 0; i < 50; ++i) points.push_back(random.vec(0.5).cwiseProduct(Vec3(1, 2, 3)));
  const auto hull = convexHull(points);
  expectHull(*hull, points);
  EXPECT_EQ(hull->vertices, corners);
  ASSERT_EQ(hull->faces.size(), 6u);
  EXPECT_EQ(hull->edges.size(), 12u);
  for (const Surface::Face& f : hull->faces) {
    EXPECT_EQ(f.count, 4);
    EXPECT_EQ(f.normal.cwiseAbs().maxCoeff(), 1);
  }
  for (const Surface::Edge& e : hull->edges) EXPECT_EQ(e.bend, 1);
  expectEntries(hull->volume, 6, 1e-13, "volume");
  expectEntries(hull->center, Vec3::Zero(), 1e-15, "center");
  expectEntries(hull->unit_inertia, Mat3(Vec3(13. / 12, 10. / 12, 5. / 12).asDiagonal()), 1e-13, "inertia");
}

// A box turned any way has corners that are in one plane but for rounding: its sides are one face each all the same.
TEST(ConvexHull, TurnedBoxesKeepTheirSides) {
  Random random(32);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("seed 32, round " + std::to_string(i));
    const Vec3 size = Vec3(1, 1, 1) + random.vec(0.9);
    const double distance = i % 3 == 0 ? 0 : std::pow(10, random.in(-1, 2));
    const Quat q = random.rotation();
    const auto hull = convexHull(boxTriangles(size).placed(q, distance * random.unit()).vertices);
    EXPECT_EQ(hull->faces.size(), 6u);
    EXPECT_EQ(hull->vertices.size(), 8u);
    // rounding of far corners makes them another box
    expectEntries(hull->volume, size.prod(), 1e-14 * std::max(1., distance) * 10, "volume");
  }
}

TEST(ConvexHull, RandomPoints) {
  Random random(33);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("seed 33, round " + std::to_string(i));
    std::vector<Vec3> points;
    const int count = 4 + random.below(200);
    const double scale = std::pow(10, random.in(-3, 3));
    const Vec3 offset = random.vec(10 * scale);
    for (int k = 0; k < count; ++k) points.push_back(offset + scale * (i % 2 ? random.vec(1) : random.unit()));
    const auto hull = convexHull(points);
    expectHull(*hull, points);
    if (i % 2 == 0) {
      EXPECT_EQ(hull->vertices.size(), points.size()) << "all on a ball";
    }
  }
}

// The same hull whatever the order of the points.
TEST(ConvexHull, OrderOfPointsDoesNotMatter) {
  Random random(34);
  std::vector<Vec3> points;
  for (int k = 0; k < 100; ++k) points.push_back(random.vec(1));
  const auto hull = convexHull(points);
  std::vector<Vec3> reversed(points.rbegin(), points.rend());
  const auto other = convexHull(reversed);
  EXPECT_EQ(std::vector<Vec3>(other->vertices.rbegin(), other->vertices.rend()), hull->vertices);
  EXPECT_EQ(other->faces.size(), hull->faces.size());
  EXPECT_EQ(other->edges.size(), hull->edges.size());
  expectEntries(other->volume, hull->volume, 1e-14, "volume");
}

// Points on a grid, a prism, a ball of rings, off by noise from nothing to a visible amount: merged where flat within
// rounding, and where not, made of slivers.
TEST(ConvexHull, NearlyFlatPoints) {
  Random random(35);
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE("seed 35, round " + std::to_string(i));
    const double noise = i % 4 == 0 ? 0 : std::pow(10, random.in(-17, -5));
    const Quat q = i % 2 ? random.rotation() : Quat::Identity();
    const int count = 12 + random.below(60), kind = random.below(4);
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * random.below(16) / 16, tilt = std::numbers::pi * random.below(9) / 8;
      Vec3 p = kind == 0   ? Vec3(random.below(3), random.below(3), random.below(3))
               : kind == 1 ? Vec3(random.below(5), random.below(5), random.below(2))
               : kind == 2 ? Vec3(std::cos(angle), std::sin(angle), 0.3 * random.below(2))
                           : Vec3(std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), std::cos(tilt));
      points.push_back(q * (p + random.vec(noise)));
    }
    expectHull(*convexHull(points), points);
    if (HasFailure()) return;
  }
}

TEST(ConvexHull, ManyPoints) {
  const auto ball = ballTriangles(1, 5);
  const auto hull = convexHull(ball.vertices);
  EXPECT_EQ(hull->vertices, ball.vertices);
  expectEntries(hull->volume, ball.surface()->volume, 1e-13, "volume");
  expectEntries(hull->unit_inertia, ball.surface()->unit_inertia, 1e-13, "inertia");
}

TEST(ConvexHull, SeveralThreadsAtOnce) {
  std::vector<std::vector<Vec3>> clouds;
  std::vector<std::shared_ptr<const Surface>> alone;
  Random random(36);
  for (int i = 0; i < 4; ++i) {
    clouds.emplace_back();
    for (int k = 0; k < 300; ++k) clouds.back().push_back(random.unit());
    alone.push_back(convexHull(clouds.back()));
  }
  std::vector<int> equal(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      for (int round = 0; round < 20; ++round) {
        const auto hull = convexHull(clouds[i]);
        equal[i] += hull->corners == alone[i]->corners && hull->volume == alone[i]->volume;
        EXPECT_THROW(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), InputError);
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(equal, std::vector<int>(4, 20));
}

struct BadPoints {
  const char* name;
  std::vector<Vec3> points;
  std::vector<const char*> words;  ///< that the message holds
};

std::vector<BadPoints> badPoints() {
  const auto cube = [](int i, const Vec3& p) {
    std::vector<Vec3> points = boxTriangles({1, 1, 1}).vertices;
    points[static_cast<std::size_t>(i)] = p;
    return points;
  };
  std::vector<Vec3> flat, line, nearly;
  Random random(37);
  const Quat q = random.rotation();
  for (int i = 0; i < 30; ++i) {
    flat.push_back(Vec3(5, 5, 5) + q * Vec3(random.in(-1, 1), random.in(-1, 1), 0));
    nearly.push_back(q * Vec3(random.in(-1, 1), random.in(-1, 1), random.in(0, 1e-10)));
    line.push_back(q * Vec3(random.in(-1, 1), 0, 0));
  }
  return {{"none", {}, {"0 points", "four or more"}},
          {"three", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"3 points", "four or more"}},
          {"notANumber", cube(3, {0, kNotANumber, 0}), {"point 3", "nan", "finite"}},
          {"infinite", cube(7, {0, 0, kInf}), {"point 7", "inf", "finite"}},
          {"huge", cube(0, {-1e300, 0, 0}), {"point 0", "e+300", "at most 1e9"}},
          {"equal", std::vector<Vec3>(9, Vec3(1, 2, 3)), {"9 points", "at one place", "span a volume"}},
          {"tiny", boxTriangles({1e-90, 1e-90, 1e-90}).vertices, {"within 1.73e-90 m", "at least 1e-30 m"}},
          {"line", line, {"30 points", "on one line", "span a volume"}},
          {"exactLine", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}, {"on one line"}},
          {"plane", flat, {"30 points", "in one plane", "span a volume"}},
          {"exactPlane", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 2, 0}}, {"in one plane"}},
          {"nearlyPlane", nearly, {"in one plane (within ", "span a volume"}},
          {"threePlacesTwice", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"in one plane"}}};
}

TEST(ConvexHull, BadPointsAreNamed) {
  for (const BadPoints& bad : badPoints()) {
    SCOPED_TRACE(bad.name);
    testing::internal::CaptureStderr();
    try {
      convexHull(bad.points);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      const std::string text = error.what();
      for (const char* word : bad.words)
        EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
      EXPECT_NE(text.find("found "), std::string::npos) << text;
      EXPECT_NE(text.find("expected "), std::string::npos) << text;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

// Thin plates down to the limit are hulls.
TEST(ConvexHull, ThinPlates) {
  Random random(38);
  for (double thickness : {1e-3, 1e-5, 1e-7, 1e-8}) {
    SCOPED_TRACE(thickness);
    const auto points = boxTriangles({1, 1, thickness}).placed(random.rotation(), {0, 0, 0}).vertices;
    const auto hull = convexHull(points);
    expectHull(*hull, points);
    EXPECT_EQ(hull->vertices.size(), 8u);
  }
}

// Needles as thin both ways as a plate may be: a volume all the same.
TEST(ConvexHull, Needles) {
  Random random(39);
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE("seed 39, needle " + std::to_string(i));
    const double length = std::pow(10, random.in(-25, 8.5)), thin = std::pow(10, random.in(-8, -3));
    const auto points =
        boxTriangles({length, thin * length, thin * length}).placed(random.rotation(), Vec3::Zero()).vertices;
    const auto hull = convexHull(points);
    expectHull(*hull, points);
    // rounding of the corners is 1e-16 of the length, of the thickness ever more
    expectEntries(hull->volume / (thin * thin * std::pow(length, 3)), 1, 1e-14 / thin, "volume");
  }
  // a needle whose plain triple products are rounding
  const Vec3 far = Vec3::Constant(1e9), near = far - Vec3::UnitX();
  EXPECT_GT(
      convexHull({far, near, {15, -0.5, 0.5}, {-0.5, 0.5, -0.1}, {-0.5, -0.5, 0}, {0.5, 1, 0}, {2, 0, 0}})->volume, 0);
}

}  // namespace
}  // namespace carom
