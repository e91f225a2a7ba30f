// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "tests/pairs/encounter.h"
#include "tests/support/throws.h"

// The brute-force answer against what is known of it: closed forms, its own proofs, bodies in reverse order.

namespace carom::pairs {
namespace {

constexpr Real kExact = 1e-15L;

Body body(const Shape& shape, const Vec3& position, const Vec3& velocity = Vec3::Zero()) {
  Body b;
  b.shape = shape, b.position = position, b.velocity = velocity, b.mass = 1;
  return b;
}
Body fixed(const Shape& shape, const Vec3& position = Vec3::Zero()) {
  Body b = body(shape, position);
  b.fixed = true, b.mass.reset();
  return b;
}
Quat turn(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis)); }

struct Expected {
  Real time;
  Vec3 normal, point;
};

/// The bodies in both orders.
void expectImpact(const std::string& what, const Body& a, const Body& b, const Vec3& gravity,
                  const Expected& expected) {
  for (const bool swapped : {false, true}) {
    SCOPED_TRACE(what + (swapped ? ", swapped" : ""));
    Scene scene;
    scene.gravity = gravity;
    scene.bodies = swapped ? std::vector{b, a} : std::vector{a, b};
    Encounter encounter(scene);
    const auto impact = encounter.firstImpact(5);
    ASSERT_TRUE(impact);
    EXPECT_EQ(impact->doubt, "");
    EXPECT_LE(std::abs(impact->time - expected.time), kExact);
    const Vector n(swapped ? Vec3(-expected.normal) : expected.normal);
    EXPECT_LE(norm(impact->touch.normal - n), kExact) << impact->touch.normal.rounded().transpose();
    EXPECT_LE(norm(impact->touch.point - Vector(expected.point)), kExact) << impact->touch.point.rounded().transpose();
  }
}

const Vec3 kNone = Vec3::Zero(), kUp = Vec3::UnitZ();

TEST(Oracle, ballsHeadOn) {
  // |(3 - 2 t, 0.3)| = 0.5
  const Real t = (3 - 0.4L) / 2;
  expectImpact("balls", body(Sphere{0.25}, {3, 0.3, 0}, {-2, 0, 0}), body(Sphere{0.25}, kNone), kNone,
               {t, {0.8, 0.6, 0}, {0.2, 0.15, 0}});
}

TEST(Oracle, fallOntoAPlane) {
  const Vec3 g(0, 0, -8);
  const Real a = 0.5L, s = std::sin(a), c = std::cos(a);
  const auto fall = [](Real height) { return std::sqrt(height / 4); };
  Body capsule = body(Capsule{0.1, 0.6}, {0, 0, 2});
  capsule.orientation = turn(0.5, Vec3::UnitY());  // axis to (sin, 0, cos)
  expectImpact("capsule", capsule, fixed(Plane{}), g, {fall(2 - 0.3L * c - 0.1L), kUp, {double(-0.3L * s), 0, 0}});
  Body cylinder = body(Cylinder{0.125, 0.5}, {0, 0, 2});
  cylinder.orientation = capsule.orientation;
  expectImpact("cylinder", cylinder, fixed(Plane{}), g,
               {fall(2 - 0.25L * c - 0.125L * s), kUp, {double(-0.25L * s + 0.125L * c), 0, 0}});
  Body cone = body(Cone{0.125, 0.5}, {0, 0, 2});  // positions are those of the shape's origin, half way up
  cone.orientation = capsule.orientation;
  expectImpact("rim of a cone", cone, fixed(Plane{}), g,
               {fall(2 - 0.25L * c - 0.125L * s), kUp, {double(-0.25L * s + 0.125L * c), 0, 0}});
  cone.orientation = turn(0.5, Vec3::UnitY()) * turn(std::acos(-1.), Vec3::UnitX());
  expectImpact("apex of a cone", cone, fixed(Plane{}), g, {fall(2 - 0.25L * c), kUp, {double(-0.25L * s), 0, 0}});
  Body box = body(Box{{0.5, 1, 0.25}}, {0, 0, 2});
  box.orientation = turn(0.5, Vec3::UnitY()) * turn(0.25, Vec3::UnitX());
  const Mat3 R = box.orientation.toRotationMatrix();
  const Vec3 corner =
      R * Vec3(std::copysign(0.25, -R(2, 0)), std::copysign(0.5, -R(2, 1)), std::copysign(0.125, -R(2, 2)));
  Encounter encounter({g, {}, {box, fixed(Plane{})}, {}});
  EXPECT_NEAR(double(encounter.firstImpact(1)->time), double(fall(2 + corner.z())), 1e-15);
}

TEST(Oracle, crossedCylindersAndEdges) {
  Body bar = body(Cylinder{0.125, 2}, {0, 0, 1}, {0, 0, -1}), beam = body(Cylinder{0.25, 2}, kNone);
  bar.orientation = turn(std::acos(-1.) / 2, Vec3::UnitX());   // along y
  beam.orientation = turn(std::acos(-1.) / 2, Vec3::UnitY());  // along x
  expectImpact("sides", bar, beam, kNone, {0.625L, kUp, {0, 0, 0.25}});
  Body rail = body(Capsule{0.125, 2}, {0, 0, 1}, {0, 0, -1});
  rail.orientation = bar.orientation;
  expectImpact("side of a capsule", rail, beam, kNone, {0.625L, kUp, {0, 0, 0.25}});

  const double quarter = std::acos(-1.) / 4;
  Body above = body(Box{{1, 1, 1}}, {0, 0, 3}, {0, 0, -1}), below = body(Box{{1, 1, 1}}, kNone);
  above.orientation = turn(quarter, Vec3::UnitX()), below.orientation = turn(quarter, Vec3::UnitY());
  const Real half = std::sqrt(Real(0.5L));
  expectImpact("edges", above, below, kNone, {3 - 2 * half, kUp, {0, 0, double(half)}});
}

// Cones of slope 3/5 (radius 3, height 4): tangent planes through the apex.
TEST(Oracle, sidesOfCones) {
  const Body cone = fixed(Cone{0.75, 1});  // apex at (0, 0, 1/2), normals (4/5, 0, 3/5)
  // a ball at height 1/4 comes along x: 4/5 x + 3/5 (z - 1/2) = radius
  const Real at_x = (0.25L + 0.15L) / 0.8L;
  expectImpact("ball on side", body(Sphere{0.25}, {2, 0, 0.25}, {-1, 0, 0}), cone, kNone,
               {2 - at_x, {0.8, 0, 0.6}, {double(at_x - 0.2L), 0, 0.1}});
  // a rod along y does the same, at the same height
  Body rod = body(Capsule{0.25, 3}, {2, 0, 0.25}, {-1, 0, 0});
  rod.orientation = turn(std::acos(-1.) / 2, Vec3::UnitX());
  expectImpact("rod on side", rod, cone, kNone, {2 - at_x, {0.8, 0, 0.6}, {double(at_x - 0.2L), 0, 0.1}});
  // an upright cylinder's low rim falls past the apex onto the side: 4/5 (1/2 - 1/4) + 3/5 (z - 1/2) = 0
  expectImpact("rim on side", body(Cylinder{0.25, 0.5}, {0.5, 0, 1.25}, {0, 0, -1}), cone, kNone,
               {1 - (0.5L - 0.2L / 0.6L), {0.8, 0, 0.6}, {0.25, 0, double(0.5L - 0.2L / 0.6L)}});
  // another cone, apex down, beside it: apex on side
  Body down = body(Cone{0.25, 0.5}, {0.25, 0, 1.25}, {0, 0, -1});
  down.orientation = turn(std::acos(-1.), Vec3::UnitX());
  expectImpact("apex on side", down, cone, kNone, {1 - (0.5L - 0.2L / 0.6L), {0.8, 0, 0.6}, {0.25, 0, double(0.5L - 0.2L / 0.6L)}});
}

// Two rims that touch at P: tangents y and (1, 0, 1), normals between those of cap and side on both.
TEST(Oracle, rimsThatCross) {
  const Vec3 P(0.25, 0.5, 0.75), n(-std::sqrt(0.5), 0, std::sqrt(0.5)), t(std::sqrt(0.5), 0, std::sqrt(0.5));
  const double half = std::sqrt(0.5);
  Body a = body(Cylinder{0.5, 1}, P + Vec3(-0.5, 0, 0.5) + 0.25 * n, -n);  // its low rim at P
  Body b = body(Cylinder{0.25, 0.5}, kNone);
  const Vec3 cap = half * (n + Vec3::UnitY()), out = half * (n - Vec3::UnitY());
  Mat3 axes;
  axes << out, cap.cross(out), cap;
  b.orientation = Quat(axes);
  b.position = P - 0.25 * out - 0.25 * cap;
  Encounter encounter({kNone, {}, {a, b}, {}});
  const auto impact = encounter.firstImpact(1);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->features, "rim 0 on rim 1");
  EXPECT_NEAR(double(impact->time), 0.25, 1e-15);
  EXPECT_LE((impact->touch.normal.rounded() - n).norm(), 1e-15);
  EXPECT_LE((impact->touch.point.rounded() - P).norm(), 1e-15);
}

TEST(Oracle, ballIntoACup) {
  test::Random random(7);
  Mesh cup = test::cupMesh(random, 6, 0);
  const Body standing = fixed(cup);
  // its floor is the second lowest level of its corners
  double low = 1, floor = 1;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& v : cup.surface->vertices) low = std::min(low, v.z()), middle += v / cup.surface->vertices.size();
  for (const Vec3& v : cup.surface->vertices)
    if (v.z() > low + 1e-6) floor = std::min(floor, v.z());
  middle *= cup.scale, floor *= cup.scale;
  const Vec3 start(middle.x() + 0.002, middle.y() + 0.001, 2);
  Encounter encounter({kNone, {}, {body(Sphere{0.03125}, start, {0, 0, -4}), standing}, {}});
  const auto impact = encounter.firstImpact(2);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(double(impact->time), (2 - 0.03125 - floor) / 4, 1e-15);
  EXPECT_LE((impact->touch.normal.rounded() - kUp).norm(), 1e-15);
}

class OraclePairs : public testing::TestWithParam<test::ShapePair> {};

// The distance is proven by separating slabs at every step; longer steps change nothing, nor does the order of the
// bodies.
TEST_P(OraclePairs, proofsStepsAndOrder) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const test::Throw thrown = test::randomThrow(*GetParam().a, *GetParam().b, seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + test::describe(thrown));
    Encounter quick(thrown.scene), patient(thrown.scene);
    const auto impact = quick.firstImpact(thrown.duration), checked = patient.firstImpact(thrown.duration, true);
    ASSERT_EQ(impact.has_value(), checked.has_value());
    EXPECT_LE(patient.worstProof(), 1e-12L);
    Scene swapped = thrown.scene;
    std::swap(swapped.bodies[0], swapped.bodies[1]);
    const auto reversed = Encounter(swapped).firstImpact(thrown.duration);
    ASSERT_EQ(impact.has_value(), reversed.has_value());
    if (!impact || !impact->doubt.empty() || !checked->doubt.empty()) continue;
    EXPECT_LE(std::abs(impact->time - checked->time), kExact);
    EXPECT_LE(norm(impact->touch.normal - checked->touch.normal), 1e-12L);
    EXPECT_LE(std::abs(impact->time - reversed->time), kExact);
    EXPECT_LE(norm(impact->touch.normal + reversed->touch.normal), 1e-12L);
    EXPECT_LE(norm(impact->touch.point - reversed->touch.point), 1e-12L);
  }
}
INSTANTIATE_TEST_SUITE_P(Kinds, OraclePairs, testing::ValuesIn(test::pairsThatMeet()),
                         [](const auto& row) { return row.param.name(); });

}  // namespace
}  // namespace carom::pairs
