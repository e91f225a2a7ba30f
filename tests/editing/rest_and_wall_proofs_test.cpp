// SPDX-License-Identifier: MIT
// Rests out of balance and places behind a wall: each condition of their proofs counts, and what a motion meets is
// never called impossible.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/strategy/past_walls.hpp"
#include "editing/strategy/rest_balance.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom::rest_and_wall_proofs_test {

using namespace editing_detail;
using test::Random;

namespace {

Body thing(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity) {
  Body body;
  body.name = name, body.shape = shape, body.material = "m", body.position = position, body.velocity = velocity,
  body.mass = 0.3;
  return body;
}

Body solid(const std::string& name, const Shape& shape, const Vec3& position) {
  Body body = thing(name, shape, position, Vec3::Zero());
  body.fixed = true, body.mass.reset();
  return body;
}

Scene above(std::vector<Body> bodies, double elasticity = 0.3) {
  bodies.insert(bodies.begin(), solid("floor", Plane{}, Vec3::Zero()));
  return test::makeScene({0, 0, -9.81}, elasticity, 0.5, bodies);
}

std::string restProof(const Scene& scene, const Quat& q, const std::vector<Control>& controls) {
  OdeContacts contacts(scene);
  Constraint rest{"a", atRest(), {{"orientation", {q.w(), q.x(), q.y(), q.z()}}}};
  return whyItCannotBalance(EditProblem(scene, contacts, 2, controls, {rest}), 1e-9);
}

Quat turned(double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitX())); }

TEST(RestBalance, ABoxDoesNotRestOnAnEdge) {
  const Scene scene = above({thing("a", Box{{0.1, 0.14, 0.2}}, {0, 0, 1}, Vec3::Zero())});
  const std::vector<Control> thrown{velocity("a"), angularVelocity("a")};
  EXPECT_EQ(restProof(scene, turned(0.8), thrown),
            "'a' cannot rest in that orientation: its centre of mass would be 0.0223 m beside all that it stands on, "
            "and it would topple.");
  EXPECT_NE(restProof(scene, turned(0.1), thrown), "");
  EXPECT_EQ(restProof(scene, turned(0), thrown), "");
  EXPECT_EQ(restProof(scene, turned(M_PI / 2), thrown), "");
  EXPECT_EQ(restProof(scene, turned(std::atan2(0.14, 0.2)), thrown), "") << "in balance on the edge";
}

TEST(RestBalance, EachConditionCounts) {
  const Scene scene = above({thing("a", Box{{0.1, 0.14, 0.2}}, {0, 0, 1}, Vec3::Zero())});
  const std::vector<Control> thrown{velocity("a")};
  ASSERT_NE(restProof(scene, turned(0.8), thrown), "");
  EXPECT_EQ(restProof(scene, turned(0.8), {velocity("a"), gravity()}), "");
  EXPECT_EQ(restProof(scene, turned(0.8), {velocity("a"), size("a")}), "");
  Scene other = scene;
  other.bodies.push_back(solid("wall", Box{{1, 1, 1}}, {2, 0, 0.5}));
  EXPECT_EQ(restProof(other, turned(0.8), thrown), "") << "it may lean on the wall";
  other = scene;
  other.bodies.push_back(thing("b", Sphere{0.1}, {2, 0, 0.5}, Vec3::Zero()));
  EXPECT_EQ(restProof(other, turned(0.8), thrown), "") << "or on a ball";
  other = scene;
  other.gravity.setZero();
  EXPECT_EQ(restProof(other, turned(0.8), thrown), "");
  other = scene;
  other.bodies[0].orientation = turned(0.3);
  ASSERT_NE(restProof(scene, turned(0.3), thrown), "");
  EXPECT_EQ(restProof(other, turned(0.3), thrown), "") << "flat on a slope";
  other = scene;
  other.bodies[1].center_of_mass = Vec3(0, -0.07 + 0.1 * std::tan(0.15), 0);
  EXPECT_EQ(restProof(other, turned(0.15), thrown), "") << "its centre of mass is above the edge";
}

TEST(RestBalance, WhereAHiddenMotionEndsIsNeverCalledImpossible) {
  int rests = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double a = random.in(0.05, 0.2), b = random.in(0.05, 0.2), c = random.in(0.05, 0.2);
    const Shape shapes[] = {Box{{a, b, c}}, Box{{c, a, b}}, Cylinder{a, 2 * b}, Cone{a, b}};
    Scene scene =
        above({thing("a", shapes[seed % 4], {0, 0, 0.6}, {random.in(-1, 1), random.in(-1, 1), 0})}, random.in(0, 0.3));
    const double slope = random.in(-0.2, 0.2);
    scene.bodies[0].orientation = turned(slope);
    const double x = random.in(-1, 1), y = random.in(-1, 1), z = random.in(-1, 1), w = random.in(-1, 1);
    scene.bodies[1].orientation = Quat(w, x, y, z).normalized();
    const Motion motion = test::play(scene, 5);
    if (motion.status != MotionStatus::complete) continue;
    const BodyState end = motion.stateAt("a", 5);
    if (!end.velocity.isZero(0) || !end.angular_velocity.isZero(0)) continue;
    ++rests;
    EXPECT_EQ(restProof(scene, end.orientation, {velocity("a"), angularVelocity("a")}), "");
  }
  EXPECT_GE(rests, 5);
}

std::string wallProof(const Scene& scene, const Constraint& constraint, const std::vector<Control>& controls) {
  OdeContacts contacts(scene);
  return whyItStaysBefore(EditProblem(scene, contacts, 2, controls, {constraint}), 1e-9);
}

const Control kSlow = velocity("a").within(-3, 3);

Constraint at(double t, double x) { return {"a", t, {{"position", {x, any, any}}}}; }

TEST(PastWalls, NeitherOverNorRound) {
  const Body ball = thing("a", Sphere{0.1}, {0, 0, 1}, Vec3::Zero());
  const Scene scene = above({ball, solid("wall", Box{{0.4, 40, 8}}, {1, 0, 4})});
  EXPECT_EQ(wallProof(scene, at(1.8, 2), {kSlow}),
            "'a' does not get past 'wall', behind which it is to be ('a' at 1.8 s): it has energy for a height of 2.38 "
            "m and for 6.83 m/s "
            "at most, which takes it neither over nor round it by 1.8 s.");
  EXPECT_EQ(wallProof(scene, at(1.8, 0.9), {kSlow}), "");
  EXPECT_EQ(wallProof(scene, at(1.8, 2), {velocity("a")}), "") << "thrown at any speed";
  EXPECT_EQ(wallProof(scene, {"a", 1.8, {{"position", {2, any, any}}}, "wall"}, {kSlow}), "");
  const auto with = [&](const Vec3& size, const Vec3& place) {
    return wallProof(above({ball, solid("wall", Box{size}, place)}), at(1.8, 2), {kSlow});
  };
  EXPECT_NE(with({0.4, 40, 2.5}, {1, 0, 1.25}), "");
  EXPECT_EQ(with({0.4, 40, 2.3}, {1, 0, 1.15}), "") << "over it";
  EXPECT_EQ(with({0.4, 24, 8}, {1, 0, 4}), "") << "round it";
  EXPECT_EQ(with({0.4, 40, 8}, {1, 0, 4.1}), "") << "under it";
  EXPECT_EQ(with({0.4, 40, 8}, {2, 0, 4}), "") << "it ends within the wall";
  Scene other = scene;
  other.bodies[2].orientation = turned(0.1);
  EXPECT_EQ(wallProof(other, at(1.8, 2), {kSlow}), "");
  other = scene;
  other.bodies[2].fixed = false, other.bodies[2].mass = 100;
  EXPECT_EQ(wallProof(other, at(1.8, 2), {kSlow}), "");
  other = scene;
  other.bodies[1].center_of_mass = Vec3(0.01, 0, 0);
  EXPECT_EQ(wallProof(other, at(1.8, 2), {kSlow}), "");
}

TEST(PastWalls, WhereAHiddenMotionGetsIsNeverCalledImpossible) {
  int past = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double wide = random.in(0.2, 3), high = random.in(0.2, 1.5), x = random.in(0.4, 1);
    const Vec3 v(random.in(1, 3), random.in(-3, 3), random.in(-3, 3));
    Scene scene = above({thing("a", seed % 2 ? Shape(Sphere{0.1}) : Shape(Box{{0.1, 0.2, 0.15}}), {0, 0, 0.5}, v),
                         solid("wall", Box{{0.1, wide, high}}, {x, 0, 0.5 * high})},
                        0.8);
    const Motion motion = test::play(scene, 2);
    if (motion.status != MotionStatus::complete) continue;
    const double reached = motion.stateAt("a", 1.8).position.x();
    past += reached > x + 0.05;
    EXPECT_EQ(wallProof(scene, at(1.8, reached), {kSlow}), "");
  }
  EXPECT_GE(past, 50);
}

}  // namespace
}  // namespace carom::rest_and_wall_proofs_test
