// SPDX-License-Identifier: MIT
// Every kind of control: set and get, gather and scatter, scales, bounds, and everything a person can get wrong.

#include "editing/problem/controls/control_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/scene/body_model.h"
#include "editing/problem/controls/natural_scales.hpp"
#include "editing/problem/controls/validity_rows.hpp"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

Eigen::VectorXd irregular(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd v(n);
  for (double& x : v) x = uniform(random);
  return v;
}

SceneDerivative irregularDerivative(const Scene& scene, unsigned seed) {
  SceneDerivative d(scene);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto fill = [&](auto& vector) {
    for (double& x : vector) x = uniform(random);
  };
  fill(d.gravity);
  for (BodyDerivative& b : d.bodies) {
    fill(b.position), fill(b.orientation), fill(b.velocity), fill(b.angular_velocity), fill(b.inertia), fill(b.size);
    b.mass = uniform(random), b.density = uniform(random);
    fill(b.surface_velocity), fill(b.surface_angular_velocity);
  }
  for (MaterialDerivative& m : d.materials) {
    m.elasticity = uniform(random), m.friction = uniform(random), m.tangential_elasticity = uniform(random);
  }
  for (Vec2& t : d.tilts) fill(t);
  return d;
}

class EachControl : public testing::TestWithParam<int> {
 protected:
  Scene scene = thrownBox();
  Control control = everyControl()[static_cast<std::size_t>(GetParam())];
};

TEST_P(EachControl, StartsAtTheScene) {
  const ControlSet set(scene, {control});
  const Eigen::VectorXd start = set.startValues();
  ASSERT_GT(set.size(), 0);
  EXPECT_EQ(set.valuesOf(Eigen::VectorXd::Zero(set.size())), start);
  EXPECT_FALSE(set.startMoved());
  const BodyModel before = modelOf(scene.bodies[1]), after = modelOf(set.startScene().bodies[1]);
  EXPECT_NEAR(after.mass, before.mass, 1e-15 * before.mass);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(after.inertia[i], before.inertia[i], 1e-15 * before.inertia[i]);
  EXPECT_NO_THROW(validate(set.startScene()));
}

TEST_P(EachControl, ReadsBackWhatItWrote) {
  const ControlSet set(scene, {control});
  const Eigen::VectorXd values = set.valuesOf(0.1 * irregular(set.size(), 1));
  const Scene changed = set.sceneAt(values);
  EXPECT_NO_THROW(validate(changed));
  if (control.vary == "orientation") {
    const Quat turn = changed.bodies[1].orientation * scene.bodies[1].orientation.conjugate();
    EXPECT_LE((logSO3(turn) - Vec3(values)).norm(), 1e-15 * 4);
    return;
  }
  const ControlSet again(changed, {control});
  ASSERT_EQ(again.size(), set.size());
  EXPECT_EQ(again.startValues(), values);
}

// <gather(G), r> = <G, scatter(r)>, also away from the start.
TEST_P(EachControl, GatherIsTheAdjointOfScatter) {
  const ControlSet set(scene, {control});
  const Eigen::VectorXd values = set.valuesOf(irregular(set.size(), 2)), rates = irregular(set.size(), 3);
  const SceneGradient gradient = irregularDerivative(set.startScene(), 4);
  const double expected = gradient.dot(set.scatter(rates, values));
  EXPECT_NE(expected, 0);
  EXPECT_NEAR(set.gather(gradient, values).dot(rates), expected, 1e-15 * 10);
}

// d(values)/d(changes) against differences of valuesOf (a test may).
TEST_P(EachControl, ValueRatesAreTheDerivativeOfValues) {
  const ControlSet set(scene, {control});
  const Eigen::VectorXd at = 0.2 * irregular(set.size(), 5), rates = set.valueRates(at);
  for (int i = 0; i < set.size(); ++i) {
    Eigen::VectorXd up = at, down = at;
    up[i] += 1e-5, down[i] -= 1e-5;
    const double difference = (set.valuesOf(up)[i] - set.valuesOf(down)[i]) / 2e-5;
    EXPECT_NEAR(rates[i], difference, 1e-8 * std::abs(difference)) << set.describeVariable(i);
  }
}

// The scenes that scatter says: the fields of sceneAt move as the tangent claims.
TEST_P(EachControl, ScatterIsTheDerivativeOfTheScene) {
  const ControlSet set(scene, {control});
  const Eigen::VectorXd values = set.valuesOf(0.3 * irregular(set.size(), 6));
  const Eigen::VectorXd rates = irregular(set.size(), 7).cwiseProduct(set.valueRates(values * 0));
  const double h = 1e-5;
  const Scene up = set.sceneAt(values + h * rates), down = set.sceneAt(values - h * rates);
  const SceneTangent tangent = set.scatter(rates, values);
  const BodyDerivative& d = tangent.bodies[1];
  const Body &a = up.bodies[1], &b = down.bodies[1];
  const auto expectRate = [&](double top, double bottom, double rate) {
    EXPECT_NEAR((top - bottom) / (2 * h), rate, 1e-8 * (1 + std::abs(rate)));
  };
  const Vec3 turn = logSO3(a.orientation * b.orientation.conjugate());
  const Vec3 size_a = kindOf(a.shape).dimensions(a.shape), size_b = kindOf(b.shape).dimensions(b.shape);
  const BodyDerivative& of_floor = tangent.bodies[0];
  for (int i = 0; i < 3; ++i) {
    expectRate(up.bodies[0].surface_velocity[i], down.bodies[0].surface_velocity[i], of_floor.surface_velocity[i]);
    expectRate(up.bodies[0].surface_angular_velocity[i], down.bodies[0].surface_angular_velocity[i], of_floor.surface_angular_velocity[i]);
    expectRate(a.position[i], b.position[i], d.position[i]);
    expectRate(turn[i], 0, d.orientation[i]);
    expectRate(a.velocity[i], b.velocity[i], d.velocity[i]);
    expectRate(a.angular_velocity[i], b.angular_velocity[i], d.angular_velocity[i]);
    expectRate(size_a[i], size_b[i], d.size[i]);
    expectRate(up.gravity[i], down.gravity[i], tangent.gravity[i]);
    if (control.vary == "inertia") expectRate(a.inertia.moments[i], b.inertia.moments[i], d.inertia[i]);
  }
  if (control.vary == "mass") expectRate(*a.mass, *b.mass, d.mass);
  expectRate(up.materials[0].elasticity, down.materials[0].elasticity, tangent.materials[0].elasticity);
  expectRate(up.materials[0].friction, down.materials[0].friction, tangent.materials[0].friction);
  expectRate(up.materials[0].tangential_elasticity, down.materials[0].tangential_elasticity,
             tangent.materials[0].tangential_elasticity);
  for (std::size_t t = 0; t < up.tilts.size(); ++t) {
    for (int i = 0; i < 2; ++i) expectRate(up.tilts[t].value[i], down.tilts[t].value[i], tangent.tilts[t][i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, EachControl, testing::Range(0, 14),
                         [](const auto& row) { return everyControl()[static_cast<std::size_t>(row.param)].vary; });

TEST(ControlKinds, EveryKindIsTested) {
  const std::vector<Control> controls = everyControl();
  ASSERT_EQ(controls.size(), controlKinds().size());
  for (std::size_t i = 0; i < controls.size(); ++i) {
    EXPECT_NE(findControlKind(controls[i].vary), nullptr) << controls[i].vary;
  }
}

TEST(ControlSet, AllKindsTogether) {
  const ControlSet set(thrownBox(), everyControl());
  EXPECT_EQ(set.size(), 3 + 3 + 3 + 3 + 3 + 3 + 1 + 1 + 1 + 1 + 3 + 3 + 2 + 3);
  EXPECT_TRUE(set.startScene().bodies[1].mass.has_value());
  EXPECT_FALSE(set.startScene().bodies[1].density.has_value());
  EXPECT_EQ(set.startScene().bodies[1].inertia.source, Inertia::Source::moments);
  EXPECT_EQ(set.startScene().tilts.size(), 1u);
  EXPECT_EQ(set.describeVariable(0), "position.x of 'box'");
  EXPECT_EQ(set.describeVariable(12), "surface_velocity.x of 'floor'");
  EXPECT_EQ(set.describeVariable(18), "elasticity of 'felt'");
}

TEST(ControlSet, ScalesFollowTheEquations) {
  const Scene scene = thrownBox();
  const double size = Vec3(0.3, 0.2, 0.1).norm(), g = 9.81;
  const ControlSet set(scene, {position("box"), velocity("box"), angularVelocity("box").weighted(4), gravity()});
  EXPECT_NEAR(set.variables()[0].scale, size, 1e-15);
  EXPECT_NEAR(set.variables()[3].scale, std::sqrt(g * size), 1e-15);
  EXPECT_NEAR(set.variables()[6].scale, std::sqrt(g / size) / 4, 1e-14);
  EXPECT_NEAR(set.variables()[9].scale, g, 1e-15);
}

// docs/editing.md, "What a change costs": a natural scale is 25 % of a speed of which 7 % are just noticed, and as much of
// the others. An elasticity is noticed by a tenth of it, and no finer below 1/8; the others follow from what they do to
// speeds.
TEST(ControlSet, WhatBodiesAreMadeOfIsWeighedByWhatIsNoticed) {
  Scene scene = thrownBox();
  const auto scalesOf = [&](const Control& control) {
    const ControlSet set(scene, {control});
    return set.variables()[0].scale;
  };
  for (double elasticity : {0.0, 0.1, 0.125, 0.5, 1.0}) {
    scene.materials[0].elasticity = elasticity;
    const double noticed = 0.1 * std::max(elasticity, 0.125);
    EXPECT_NEAR(scalesOf(carom::elasticity("felt")), 0.25 / 0.07 * noticed, 1e-15) << elasticity;
  }
  // v_t loses mu (1 + e) v_n; at 45 degrees and e = 1/2 a quarter of v_t
  EXPECT_NEAR(scalesOf(friction("felt")) * (1 + 0.5), 0.25, 1e-15);
  // the rim of a uniform ball gains 5/7 (1 + b) v_t
  EXPECT_NEAR(scalesOf(tangentialElasticity("felt")) * 5 / 7, 0.25, 1e-15);
  // d log(v) / d log(m) = -1/2 for what is hit by a body as heavy
  EXPECT_NEAR(scalesOf(mass("box")) / 2, 0.25, 1e-15);
  EXPECT_NEAR(scalesOf(inertia("box")) / 2, 0.25, 1e-15);
  EXPECT_NEAR(scalesOf(mass("box").weighted(4)), 0.125, 1e-15);
  const ControlSet set(scene, {mass("box")});
  const double mass_of_box = set.startValues()[0];
  EXPECT_NEAR(set.valuesOf(Eigen::VectorXd::Ones(1))[0], mass_of_box * std::exp(0.5), 1e-14 * mass_of_box);
}

TEST(NaturalScales, WithoutGravity) {
  Scene scene = thrownBox();
  scene.gravity.setZero();
  EXPECT_NEAR(naturalScales(scene, 1).velocity, scene.bodies[1].velocity.norm(), 1e-15);
  EXPECT_NEAR(naturalScales(scene, 1).angular_velocity, scene.bodies[1].angular_velocity.norm(), 1e-15);
  scene.bodies[1].velocity.setZero(), scene.bodies[1].angular_velocity.setZero();
  const NaturalScales still = naturalScales(scene, 1);
  EXPECT_EQ(still.velocity, still.length);
  EXPECT_EQ(still.angular_velocity, 1);
  EXPECT_EQ(still.time, 1);
  EXPECT_EQ(naturalScales(scene, 0).length, still.length);  // a plane takes the box's
  EXPECT_EQ(gravityScale(scene), 9.81);
}

TEST(ControlSet, ComponentsOfOneOwnerInTwoControls) {
  const Scene scene = thrownBox();
  for (const auto& make : {&orientation, &velocity, &position}) {
    const ControlSet whole(scene, {make("box")});
    const ControlSet parts(scene, {make("box").only({"z"}), make("box").only({"x", "y"}).weighted(3)});
    const Vec3 values = Vec3(0.3, -0.4, 0.5) + Vec3(whole.startValues());
    const Eigen::VectorXd turned = Vec3(values.z(), values.x(), values.y());
    const Scene a = whole.sceneAt(values), b = parts.sceneAt(turned);
    EXPECT_EQ(a.bodies[1].orientation.coeffs(), b.bodies[1].orientation.coeffs());
    EXPECT_EQ(a.bodies[1].velocity, b.bodies[1].velocity);
    EXPECT_EQ(a.bodies[1].position, b.bodies[1].position);
    const SceneGradient gradient = irregularDerivative(scene, 8);
    const Vec3 all = whole.gather(gradient, values), split = parts.gather(gradient, turned);
    EXPECT_LE((Vec3(all.z(), all.x(), all.y()) - split).norm(), 1e-15);
  }
}

TEST(ControlSet, BoundsOfThePersonStayInsideThePhysicalOnes) {
  const ControlSet set(thrownBox(), {elasticity("felt").within(0.2, 7), friction("felt").within(-3, 0.8),
                                     mass("box").atLeast(0.5), velocity("box").within(-10, 20)});
  const auto& v = set.variables();
  EXPECT_EQ(v[0].lower, 0.2);
  EXPECT_EQ(v[0].upper, 1);
  EXPECT_EQ(v[1].lower, 0);
  EXPECT_EQ(v[1].upper, 0.8);
  EXPECT_EQ(v[2].lower, 0.5);
  EXPECT_TRUE(std::isinf(v[2].upper));
  EXPECT_EQ(v[5].upper, 20);
  const Eigen::VectorXd lower = set.valuesOf(set.lowerChanges().cwiseMax(-1e3));
  for (int i = 0; i < set.size(); ++i) EXPECT_NEAR(lower[i], v[i].lower, 1e-12 * (1 + std::abs(v[i].lower)));
}

TEST(ControlSet, StartsOutsideTheirBoundsMoveInside) {
  const Scene scene = thrownBox();
  const ControlSet set(scene, {elasticity("felt").within(0.7, 0.9), orientation("box").only({"x"}).within(0.1, 0.2)});
  EXPECT_TRUE(set.startMoved());
  EXPECT_EQ(set.notes().size(), 2u);
  EXPECT_EQ(set.startScene().materials[0].elasticity, 0.7);
  EXPECT_EQ(set.variables()[0].before, 0.5);
  const Quat turn = set.startScene().bodies[1].orientation * scene.bodies[1].orientation.conjugate();
  EXPECT_LE((logSO3(turn) - Vec3(0.1, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(set.sceneAt(set.startValues()).bodies[1].orientation.coeffs(),
            set.startScene().bodies[1].orientation.coeffs());
}

TEST(ControlSet, ANumberWithoutRoomStaysWhereItsBoundsAre) {
  const ControlSet set(thrownBox(), {elasticity("felt").within(0.4, 0.4), friction("felt")});
  EXPECT_EQ(set.size(), 1);
  EXPECT_EQ(set.sceneAt(set.startValues()).materials[0].elasticity, 0.4);
}

TEST(ControlSet, ATiltOutsideItsConeIsShortened) {
  Scene scene = thrownBox();
  scene.tilts = {{"box", 2, Vec2(0.3, 0.4)}};
  const ControlSet set(scene, {tilt("box", 2).atMost(0.25), tilt("box", 1)});
  EXPECT_NEAR(set.startScene().tilts[0].value.norm(), 0.25, 1e-16);
  EXPECT_EQ(set.startScene().tilts.size(), 2u);
  EXPECT_EQ(set.controls()[1].cone, kDefaultTiltCone);
}

TEST(ValidityRows, SayWhatPhysicsAllows) {
  const ControlSet set(thrownBox(), {inertia("box"), tilt("box", 1).atMost(0.2)});
  const ValidityRows rows(set);
  ASSERT_EQ(rows.size(), 4);
  EXPECT_GT(rows.evaluate(set, set.startValues()).minCoeff(), 0);
  Eigen::VectorXd values = set.startValues();
  values[0] = 3 * (values[1] + values[2]);
  values[3] = 0.2, values[4] = 0.1;
  const Eigen::VectorXd h = rows.evaluate(set, values);
  EXPECT_LT(h[0], 0);
  EXPECT_NEAR(h[3], -0.25, 1e-15);
}

TEST(ValidityRows, JacobianIsTheirDerivative) {
  const ControlSet set(thrownBox(), {tilt("box", 1), inertia("box").only({"x", "z"}), velocity("box")});
  const ValidityRows rows(set);
  const Eigen::VectorXd at = set.valuesOf(0.1 * irregular(set.size(), 9));
  const Eigen::MatrixXd J = rows.jacobian(set, at);
  for (int j = 0; j < set.size(); ++j) {
    const double step = 1e-4 * (at[j] == 0 ? 1 : std::abs(at[j]));
    Eigen::VectorXd up = at, down = at;
    up[j] += step, down[j] -= step;
    const Eigen::VectorXd difference = (rows.evaluate(set, up) - rows.evaluate(set, down)) / (2 * step);
    for (int i = 0; i < rows.size(); ++i) EXPECT_NEAR(J(i, j), difference[i], 1e-9 * (1 + std::abs(J(i, j))));
  }
}

struct BadControl {
  const char* name;
  std::function<std::vector<Control>()> make;
  const char* where;
  const char* says;
};

const BadControl kBadControls[] = {
    {"word",
     [] {
       Control c;
       c.vary = "speed";
       return std::vector{c};
     },
     "/controls/0/vary", "expected one of position"},
    {"body", [] { return std::vector{velocity("bix")}; }, "/controls/0/body", "bix"},
    {"material",
     [] {
       return std::vector{gravity(), elasticity("velvet")};
     },
     "/controls/1/material", "velvet"},
    {"fixed", [] { return std::vector{velocity("floor")}; }, "/controls/0/body", "fixed"},
    {"fixed_mass", [] { return std::vector{mass("floor")}; }, "/controls/0/body", "fixed"},
    {"fixed_tilt", [] { return std::vector{tilt("floor", 1)}; }, "/controls/0/body", "fixed"},
    {"plane_size", [] { return std::vector{size("floor")}; }, "/controls/0", "floor"},
    {"impact", [] { return std::vector{tilt("box", 0)}; }, "/controls/0/impact", "expected 1 or more"},
    {"component", [] { return std::vector{velocity("box").only({"w"})}; }, "/controls/0/components", "x, y and z"},
    {"upside_down", [] { return std::vector{elasticity("felt").within(0.9, 0.1)}; }, "/controls/0", "min 0.9 above"},
    {"impossible", [] { return std::vector{elasticity("felt").within(2, 3)}; }, "/controls/0", "physically"},
    {"no_mass", [] { return std::vector{mass("box").within(-2, 0)}; }, "/controls/0", "physically"},
    {"nan_bound", [] { return std::vector{mass("box").atLeast(kNaN)}; }, "/controls/0/min", "NaN"},
    {"weight", [] { return std::vector{mass("box").weighted(0)}; }, "/controls/0/weight", "from 1e-12 to 1e"},
    {"nan_weight", [] { return std::vector{mass("box").weighted(kNaN)}; }, "/controls/0/weight", "from 1e-12 to 1e"},
    {"cone", [] { return std::vector{tilt("box", 1).atMost(0)}; }, "/controls/0/max", "greater than 0"},
    {"twice",
     [] {
       return std::vector{velocity("box"), velocity("box").only({"y"})};
     },
     "/controls/1", "/controls/0"},
    {"owner",
     [] {
       Control c = gravity();
       c.body = "box";
       return std::vector{c};
     },
     "/controls/0/body", "not belong"},
    {"two_bounds",
     [] {
       Control c = velocity("box");
       c.min = {0, 1};
       return std::vector{c};
     },
     "/controls/0/min", "expected 1 or 3"},
};

class ControlMistake : public testing::TestWithParam<BadControl> {};

TEST_P(ControlMistake, IsNamed) {
  try {
    const ControlSet set(thrownBox(), GetParam().make());
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), GetParam().where);
    EXPECT_NE(error.message().find(GetParam().says), std::string::npos) << error.message();
  }
}

INSTANTIATE_TEST_SUITE_P(Table, ControlMistake, testing::ValuesIn(kBadControls),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace carom
