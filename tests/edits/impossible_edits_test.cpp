// SPDX-License-Identifier: MIT
// Edits that no motion meets, of each kind: proven at once, in words; and a sweep of edits that a motion meets, none of which is
// called infeasible.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/strategy/kept_coordinates.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/edits/document_edits.h"
#include "tests/support/scenes.h"

namespace carom::test {
namespace {

using editing_detail::EditProblem;

/// Solved within 0.3 s of CPU time on a machine that is idle; the limit here leaves room for unoptimised tests.
EditResult provenAtOnce(const std::string& name) {
  const Document document = editDocument(name);
  const double before = cpuSeconds();
  EditResult r = solveDocument(document);
  testing::Test::RecordProperty(name, std::to_string(cpuSeconds() - before));
  EXPECT_EQ(r.status, EditStatus::infeasible) << name << ": " << r.message;
  EXPECT_LE(r.iterations, 0) << name << ": it was searched";
  for (const WhyNot::Help& help : r.why_not.would_help) EXPECT_FALSE(help.tried) << name << ": " << help.name;
  return r;
}

TEST(ImpossibleEdits, OfTheDocumentsAreProven) {
  EXPECT_EQ(provenAtOnce("bounds-0").message,
            "Position.x of 'ball' at 1 s comes to 1.51 m at most; 3 m is asked: velocity.x of 'ball' lies between 0 and 2.5 m/s, and "
            "nothing that it meets changes it.");
  EXPECT_EQ(provenAtOnce("infeasible-locked-y-no-hint").message,
            "'ball' and 'other' never meet: along y they stay 1.5 m apart, and would have to come within 0.1 m. Velocity.y of "
            "'ball' is locked at 0 m/s, and nothing that it meets turns it aside; velocity.y of 'other' is locked at 0 m/s, and nothing "
            "that it meets turns it aside.");
  EXPECT_EQ(provenAtOnce("infeasible-filters-0-m").message,
            "'ball' and 'other' never collide: their collision filters keep them apart.");
  EXPECT_EQ(provenAtOnce("infeasible-rest-99-cpu-s").message,
            "'die' cannot rest there: it reaches 0.026 m from its origin at most, and the nearest that can carry it, 'floor', is 0.3 m "
            "away.");
  EXPECT_EQ(provenAtOnce("energy-0").message,
            "'ball' has energy for a height of 0.945 m at most; 1.25 m is asked (position.z of 'ball' at 1.3 s).");
}

Body solid(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity) {
  Body body;
  body.name = name, body.shape = shape, body.material = "m", body.position = position, body.velocity = velocity, body.mass = 0.3;
  return body;
}

Scene playground(double friction, const std::vector<Body>& bodies) {
  Body floor = solid("floor", Plane{}, Vec3::Zero(), Vec3::Zero());
  floor.fixed = true, floor.mass.reset();
  std::vector<Body> all{floor};
  all.insert(all.end(), bodies.begin(), bodies.end());
  return makeScene({0, 0, -9.81}, 0.7, friction, all);
}

std::string proof(const Scene& scene, const std::vector<Control>& controls, const Constraint& constraint) {
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 2, controls, {constraint});
  return editing_detail::whyItStaysAway(problem, 1e-9);
}

Constraint hit(const std::string& body, const std::string& other) {
  Constraint c{body, 0.0, {}};
  c.hits = Hit{other};
  return c;
}

// Each condition of the proof, left out, leaves none.
TEST(ImpossibleEdits, EachConditionOfAKeptCoordinateCounts) {
  const Body ball = solid("ball", Sphere{0.05}, {-1, 0, 1}, {2, 0, 0.9}), other = solid("other", Sphere{0.05}, {1, 0.5, 0.05}, Vec3::Zero());
  const Scene scene = playground(0.3, {ball, other});
  const std::vector<Control> xz{velocity("ball").only({"x", "z"})};
  const auto without = [&](const auto& change, std::vector<Control> controls) {
    Scene changed = scene;
    change(changed);
    return proof(changed, controls, hit("ball", "other"));
  };
  const auto same = [](Scene&) {};
  EXPECT_NE(without(same, xz), "");
  EXPECT_EQ(without(same, {velocity("ball")}), "") << "y varies";
  EXPECT_NE(without(same, {velocity("ball").only({"x", "z"}), velocity("other").only({"x"})}), "");
  EXPECT_EQ(without(same, {velocity("ball").only({"x"}), velocity("other").only({"y"})}), "");
  EXPECT_EQ(without(same, {velocity("ball").only({"x"}), angularVelocity("ball")}), "") << "spin about x leads aside";
  EXPECT_NE(without(same, {velocity("ball").only({"x"}), angularVelocity("ball").only({"y"})}), "");
  EXPECT_EQ(without(same, {velocity("ball").only({"x"}), orientation("floor")}), "");
  EXPECT_EQ(without(same, {velocity("ball").only({"x"}), gravity()}), "");
  EXPECT_EQ(without(same, {velocity("ball").only({"x"}), tilt("ball", 1)}), "");
  EXPECT_EQ(without([](Scene& s) { s.bodies[1].shape = Box{{0.1, 0.1, 0.1}}; }, xz), "") << "a box turns aside by friction";
  EXPECT_EQ(without([](Scene& s) { s.bodies[1].angular_velocity.x() = 1; }, xz), "");
  EXPECT_EQ(without([](Scene& s) { s.bodies[1].center_of_mass = Vec3(0, 0, 0.01); }, xz), "");
  EXPECT_EQ(without([](Scene& s) { s.bodies[1].inertia = Inertia::fromMoments({1e-3, 2e-3, 2.5e-3}); }, xz), "");
  EXPECT_EQ(without([](Scene& s) { s.gravity.y() = 0.1; }, xz), "");
  EXPECT_EQ(without([](Scene& s) { s.bodies[2].velocity.y() = -0.3; }, xz), "");
  EXPECT_EQ(without([](Scene& s) { s.bodies.push_back(solid("third", Sphere{0.1}, {0, 1, 1}, {0, -1, 0})); }, xz), "");
  EXPECT_EQ(without([](Scene& s) { s.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitX())); }, xz), "");
  EXPECT_NE(without([](Scene& s) { s.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitY())); }, xz), "");
}

// Without friction a box keeps its speed, whatever it turns.
TEST(ImpossibleEdits, FrictionlessBodiesKeepTheirSpeed) {
  const Scene scene = playground(0, {solid("box", Box{{0.1, 0.2, 0.3}}, {-1, 0, 1}, {1, 0, 0})});
  Constraint place{"box", 1.0, {Target{"position", {1.6, any, any}}}};
  const Control x = velocity("box").only({"x"}).within(0, 2.5);
  EXPECT_NE(proof(scene, {x}, place), "");
  place.targets[0].value[0] = 1.49;
  EXPECT_EQ(proof(scene, {x}, place), "");
  place.targets[0].value[0] = -1.1;
  EXPECT_NE(proof(scene, {x}, place), "");
  EXPECT_EQ(proof(scene, {x, friction("m")}, place), "");
  EXPECT_NE(proof(scene, {x, elasticity("m"), mass("box")}, place), "");
  place.at = nthImpact(2);
  place.targets[0].value[0] = 4.1;
  EXPECT_NE(proof(scene, {x}, place), "") << "within 2 s";
  place.targets[0].value[0] = 3.9;
  EXPECT_EQ(proof(scene, {x}, place), "");
}

// Places and hits of a hidden motion, asked of a start that differs: never called impossible.
TEST(ImpossibleEdits, WhatAHiddenMotionMeetsIsNot) {
  int hits = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const bool slippery = random.below(2) == 0, box = slippery && random.below(2) == 0;
    const double vy = random.below(2) == 0 ? 0 : random.in(-1, 1);
    Scene hidden = playground(slippery ? 0 : random.in(0, 0.6),
                              {solid("a", box ? Shape(Box{{0.1, 0.14, 0.2}}) : Shape(Sphere{0.1}), {-0.5, 0, random.in(0.2, 1)},
                                     {random.in(0.5, 2), vy, random.in(-1, 2)}),
                               solid("b", Sphere{0.1}, {0.4, random.in(-0.25, 0.25), random.in(0.11, 1)}, {random.in(-1, 0), 0, 0})});
    if (random.below(2) == 0) hidden.bodies[1].angular_velocity = Vec3(random.in(-3, 3), random.in(-3, 3), random.in(-3, 3));
    const Motion motion = play(hidden, 2);
    if (motion.status != MotionStatus::complete) continue;
    Scene start = hidden;
    start.bodies[1].velocity.x() = random.in(0, 2.5);
    const std::vector<Control> controls{velocity("a").only({"x"}).within(0, 2.5)};
    const double t = random.in(0.1, 2);
    const Vec3 p = motion.stateAt("a", t).position;
    EXPECT_EQ(proof(start, controls, {"a", t, {Target{"position", {p.x(), p.y(), any}}}}), "");
    if (!motion.findImpact(1, 1, 2)) continue;
    ++hits;
    EXPECT_EQ(proof(start, controls, hit("a", "b")), "");
  }
  EXPECT_GE(hits, 60);
}

}  // namespace
}  // namespace carom::test
