// SPDX-License-Identifier: MIT
// Derivatives by a coefficient of friction that is 0: those of a contact that slides, as the coefficient grows; and where
// there is none, a mark.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/second_order/second_order.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/adjoint/tolerances.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom {
namespace {

using namespace test;

/// A ball of mass 1 that meets the floor z = -1 after 0.9 m of fall, g = 10.
Scene slipping(const Vec3& velocity, double friction = 0) {
  return makeScene({0, 0, -10}, 0.5, friction,
                   {makeBall("ball", 0.1, {0, 0, 0}, velocity), makePlane("floor", Vec3::UnitZ(), -1)});
}
constexpr double kEnd = 0.6;
const double kNormal = 1.5 * std::sqrt(18.0), kAfter = kEnd - std::sqrt(0.18);  // impulse, time left

SceneTangent byFriction(const Scene& scene) {
  SceneTangent d(scene);
  d.materials[0].friction = 1;
  return d;
}

TEST(FrictionFromZero, PushesASlippingBallBack) {
  const Motion m = play(slipping({3, 4, 0}), kEnd);
  ASSERT_EQ(m.events.size(), 1u);
  EXPECT_EQ(m.events[0].mode, ImpactMode::frictionless);
  const Vec3 back(-0.6, -0.8, 0);
  DerivativeTape tape(m);
  const BodyStateRate rate = tangent(tape, byFriction(*m.scene)).at(0, Instant::at(kEnd));
  expectEntries(rate.position, Vec3(kNormal * kAfter * back), kDerivative, "dx/dmu");
  expectEntries(rate.velocity, Vec3(kNormal * back), kDerivative, "dv/dmu");
  const Vec3 spin = Vec3(0, 0, -0.1).cross(kNormal * back) / (0.4 * 0.01);
  expectEntries(rate.angular_velocity, spin, kDerivative, "dw/dmu");
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::abs(gradientOf(m, 0, kEnd, i).materials[0].friction - rate.position[i]) <= kDerivative);
    EXPECT_TRUE(std::abs(gradientOf(m, 0, kEnd, 9 + i).materials[0].friction - rate.angular_velocity[i]) <= 1e-7);
  }
}

// A ball whose orientation nobody asks for is not turned in flight; the spin that friction would give it counts for the
// next impact.
TEST(FrictionFromZero, SpinsABallThatNobodyTurns) {
  const auto at = [](double friction) {
    Scene scene = slipping({3, 0, 0}, friction);
    scene.bodies.push_back(makePlane("wall", -Vec3::UnitX(), -1.6));
    OdeContacts contacts(scene);
    SimulateOptions options;
    options.asked.assign(scene.bodies.size(), Asked{false, false});
    return simulate(scene, contacts, 0.8, options);
  };
  const Motion m = at(0), near = at(1e-7);
  ASSERT_EQ(m.events.size(), 2u);
  ASSERT_EQ(near.signature(), m.signature());
  EXPECT_EQ(m.plan.bodies[0].tier, Tier::none);
  for (int i : {0, 2, 6, 8, 10})
    expectEntries(gradientOf(m, 0, 0.8, i).materials[0].friction, gradientOf(near, 0, 0.8, i).materials[0].friction, 1e-4,
                  "number " + std::to_string(i));
  EXPECT_GT(std::abs(gradientOf(m, 0, 0.8, 10).materials[0].friction), 1);
}

TEST(FrictionFromZero, HasTheSecondDerivativesOfSliding) {
  const Motion m = play(slipping({3, 4, 0}), kEnd);
  DerivativeTape tape(m);
  StateSeed seed;
  seed.body = 0;
  seed.at = Instant::at(kEnd);
  seed.position = Vec3::UnitX();
  ReadingDirection mu{byFriction(*m.scene), {}}, speed{SceneTangent(*m.scene), {}};
  speed.scene.bodies[0].velocity = Vec3::UnitY();
  const std::vector<ReadingDirection> along{mu, speed};
  const SecondOrder second = secondOrder(tape, std::span(&seed, 1), {}, along);
  // x = -mu P T v_x/|v|: d/dv_y = mu P T v_x v_y/|v|^3; linear in mu
  const double mixed = kNormal * kAfter * 12 / 125;
  expectEntries(second.gradient_rates[0].bodies[0].velocity.y(), mixed, kDerivative, "d2x/dmu dv_y");
  expectEntries(second.gradient_rates[1].materials[0].friction, mixed, kDerivative, "d2x/dv_y dmu");
  expectEntries(second.gradient_rates[0].materials[0].friction, 0, kDerivative, "d2x/dmu2");
  expectEntries(second.gradient_rates[0].materials[0].elasticity, -0.6 * std::sqrt(18.0) * kAfter, kDerivative,
                "d2x/dmu de");
  expectEntries(flatten(second.gradient), flatten(adjoint(m, std::span(&seed, 1))), 1e-13, "gradient");
}

// Friction of 0 is the limit of little friction, in every number, and the passes are each other's transpose.
TEST(FrictionFromZero, IsTheLimitOfLittleFriction) {
  int compared = 0;
  for (std::uint64_t number = 1; number <= 60; ++number) {
    SCOPED_TRACE("seed " + std::to_string(number));
    RandomScene options;
    options.friction = false;
    options.lowest_elasticity = 0.4;
    Scene scene = randomScene(number, options);
    const Motion m = play(scene, 1, 3);
    for (Material& material : scene.materials) material.friction = 1e-9;
    const Motion near = play(scene, 1, 3);
    const bool joint = std::any_of(m.events.begin(), m.events.end(), [](const Event& e) {
      return e.contacts.size() > 1 || e.margins.grazing < 1e-2;
    });
    if (m.events.empty() || joint || near.signature() != m.signature()) continue;
    ++compared;
    Random random(number);
    const int body = m.events[0].participants[0].body;
    StateSeed seed = randomSeed(body, Instant::at(0.97 * std::min(m.end, near.end)), random);
    const Eigen::VectorXd found = flatten(adjoint(m, std::span(&seed, 1)));
    const Eigen::VectorXd expected = flatten(adjoint(near, std::span(&seed, 1)));
    expectEntries(found, expected, 1e-5, "gradient", expected.cwiseAbs().maxCoeff());
    expectTransposed(m, number);
  }
  EXPECT_GE(compared, 20);
}

TEST(FrictionFromZero, IsMarkedWhereNothingSlips) {
  for (double speed : {0.0, 1e-9}) {
    const Motion m = play(slipping({speed, 0, 0}), kEnd);
    StateSeed seed = seedOf(0, Instant::at(kEnd), 2);
    Reliability r;
    const SceneGradient g = adjoint(m, std::span(&seed, 1), &r);
    EXPECT_TRUE(std::abs(g.materials[0].friction) <= 1e-9);
    EXPECT_TRUE(r.reliable) << r.message;  // friction may be no question
    ASSERT_EQ(r.frictions, std::vector<int>{0});
    r.askFriction(0);
    EXPECT_FALSE(r.reliable);
    EXPECT_NE(r.message.find("does not slip"), std::string::npos) << r.message;
  }
  const Motion m = play(slipping({1e-3, 0, 0}), kEnd);
  StateSeed seed = seedOf(0, Instant::at(kEnd), 2);
  Reliability r;
  adjoint(m, std::span(&seed, 1), &r);
  EXPECT_TRUE(r.frictions.empty());
}

Scene sliding(const Vec3& velocity) {
  return makeScene({0, 0, -10}, 0.5, 0,
                   {makeBox("box", {0.4, 0.4, 0.2}, {0, 0, 0}, velocity), makePlane("floor", Vec3::UnitZ(), -1)});
}

// All four corners rub as friction grows from 0, and share the load.
TEST(FrictionFromZero, PushesABoxBackThatLandsFlat) {
  const Motion m = play(sliding({3, 4, 0}), kEnd);
  ASSERT_EQ(m.events[0].mode, ImpactMode::joint);
  DerivativeTape tape(m);
  const BodyStateRate rate = tangent(tape, byFriction(*m.scene)).at(0, Instant::at(kEnd));
  const Vec3 back(-0.6, -0.8, 0);
  expectEntries(rate.position, Vec3(kNormal * kAfter * back), kDerivative, "dx/dmu");
  expectEntries(rate.velocity, Vec3(kNormal * back), kDerivative, "dv/dmu");
  expectEntries(rate.angular_velocity, Vec3::Zero().eval(), kDerivative, "dw/dmu");
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(std::abs(gradientOf(m, 0, kEnd, i).materials[0].friction - rate.position[i]) <= kDerivative);
  StateSeed seed = seedOf(0, Instant::at(kEnd), 0);
  Reliability r;
  adjoint(tape, std::span(&seed, 1), &r);
  EXPECT_TRUE(r.frictions.empty()) << r.friction_message;
}

TEST(FrictionFromZero, IsMarkedWhereContactsJoinAndDoNotSlip) {
  const Motion m = play(sliding({0, 0, 0}), kEnd);
  ASSERT_EQ(m.events[0].mode, ImpactMode::joint);
  StateSeed seed = seedOf(0, Instant::at(kEnd), 0);
  Reliability r;
  adjoint(m, std::span(&seed, 1), &r);
  ASSERT_EQ(r.frictions, std::vector<int>{0});
  EXPECT_NE(r.friction_message.find("does not slip"), std::string::npos) << r.friction_message;
}

// A box that lands flat and spins: corners slip in several directions, and which of them rub friction chooses. Nor does
// the order of bodies matter, nor which number of an equal load they have.
TEST(FrictionFromZero, IsMarkedWhereItChoosesWhoBearsTheLoad) {
  const auto marks = [](const Scene& scene, int body) {
    const Motion m = play(scene, kEnd);
    EXPECT_EQ(m.events.at(0).mode, ImpactMode::joint);
    EXPECT_EQ(m.events.at(0).contacts.size(), 4u);
    StateSeed seed = seedOf(body, Instant::at(kEnd), 0);
    Reliability r;
    adjoint(m, std::span(&seed, 1), &r);
    if (!r.frictions.empty())
      EXPECT_NE(r.friction_message.find("redundant contacts"), std::string::npos) << r.friction_message;
    return r.frictions == std::vector<int>{0};
  };
  for (std::uint64_t number = 1; number <= 20; ++number) {
    SCOPED_TRACE("seed " + std::to_string(number));
    Random random(number);
    Scene scene = sliding(random.vec(2));
    scene.bodies[0].velocity.z() = 0;
    scene.bodies[0].angular_velocity = Vec3(0, 0, random.in(0.2, 3));
    EXPECT_TRUE(marks(scene, 0));
    Scene straight = scene;
    straight.bodies[0].angular_velocity.setZero();
    EXPECT_FALSE(marks(straight, 0));
    std::reverse(scene.bodies.begin(), scene.bodies.end());
    EXPECT_TRUE(marks(scene, 1));
  }
}

// Where there is a mark the limit is another one: with the least friction other corners bear the load.
TEST(FrictionFromZero, HasAnotherLimitWhereItChooses) {
  const auto atEnd = [](double friction) {
    Scene scene = sliding({1, 0.3, 0});
    scene.bodies[0].angular_velocity = {0, 0, 2};
    scene.materials[0].friction = friction;
    return play(scene, kEnd);
  };
  const Motion none = atEnd(0), little = atEnd(1e-6);
  ASSERT_EQ(none.events.size(), 1u);
  ASSERT_EQ(little.events.size(), 1u);
  DerivativeTape tape(none);
  const Vec3 claimed = tangent(tape, byFriction(*none.scene)).at(0, Instant::at(kEnd)).velocity;
  const Vec3 found = 1e6 * (little.stateAt(0, kEnd).velocity - none.stateAt(0, kEnd).velocity);
  EXPECT_GT((claimed - found).norm(), 1e-2 * found.norm());
}

}  // namespace
}  // namespace carom
