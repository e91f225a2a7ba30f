// SPDX-License-Identifier: MIT
// Drags and edits against answers written down by hand: nothing of the solvers is used to check them.

#include <gtest/gtest.h>

#include <cmath>

#include "editing/problem/controls/natural_scales.hpp"
#include "editing/session.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace testing_scenes;

constexpr double kTime = 0.8, kPlaceWeight = 2, kSpeedWeight = 0.5;

// A ball in flight far above its floor.
Scene flight() {
  Scene scene;
  scene.materials = {material("felt", 0.8, 0.3)};
  scene.bodies = {fixedPlane("floor", "felt", Vec3::UnitZ(), -100),
                  ball("ball", "felt", 0.1, {0.2, -0.1, 1}, {1.5, 0.4, 2})};
  return scene;
}

Body ballOf(const Scene& scene) { return scene.bodies[static_cast<std::size_t>(bodyIndex(scene, "ball"))]; }

// The start moves by a and the throw by b per component. What is minimised is a^2/A + b^2/B, and the place at the time t
// moves by a + t b: the least change that moves it by d is a = A l, b = B t l with l = d / (A + B t^2).
struct Least {
  double A, B;
  explicit Least(const Scene& scene) {
    const NaturalScales scales = naturalScales(scene, bodyIndex(scene, "ball"));
    A = std::pow(scales.length / kPlaceWeight, 2), B = std::pow(scales.velocity / kSpeedWeight, 2);
  }
  Vec3 place(const Vec3& d) const { return A / (A + B * kTime * kTime) * d; }
  Vec3 speed(const Vec3& d) const { return B * kTime / (A + B * kTime * kTime) * d; }
};

void expectNear(const Vec3& found, const Vec3& expected, double tolerance, const char* what) {
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(std::abs(found[i] - expected[i]) <= tolerance)
        << what << ", " << "xyz"[i] << ": found " << found[i] << ", expected " << expected[i];
}

std::vector<Control> placeAndThrow() {
  return {position("ball").weighted(kPlaceWeight), velocity("ball").weighted(kSpeedWeight)};
}

TEST(ClosedForm, ADragChangesStartAndThrowAsLittleAsCanBe) {
  const Scene scene = flight();
  const Least least(scene);
  const Body before = ballOf(scene);
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 1.2, placeAndThrow(), {});
  session.grab("ball", kTime);
  const Vec3 from = session.grabbedPlace();
  for (const Vec3& d : {Vec3(0.1, 0, 0), Vec3(0.3, -0.2, 0.1), Vec3(-0.7, 0.5, 0.6), Vec3(2, 1, -0.5)}) {
    const SessionUpdate update = session.dragTo(from + d);
    EXPECT_TRUE(update.reached) << update.message;
    EXPECT_TRUE(update.distance <= 1e-9) << update.distance;
    expectNear(ballOf(update.scene()).position - before.position, least.place(d), 1e-9, "start");
    expectNear(ballOf(update.scene()).velocity - before.velocity, least.speed(d), 1e-9, "throw");
  }
  const SessionUpdate end = session.release();
  expectNear(ballOf(end.scene()).position - before.position, least.place({2, 1, -0.5}), 1e-7, "start at the end");
  expectNear(ballOf(end.scene()).velocity - before.velocity, least.speed({2, 1, -0.5}), 1e-7, "throw at the end");
}

// A nail at another time leaves one throw: a + t1 b = 0 and a + t2 b = d.
TEST(ClosedForm, ADragTurnsAboutANail) {
  const Scene scene = flight();
  const Body before = ballOf(scene);
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 1.2, placeAndThrow(), {});
  session.nailAsItIs("ball", 0.3);
  session.grab("ball", kTime);
  const Vec3 d(0.2, -0.3, 0.15), from = session.grabbedPlace();
  const SessionUpdate update = session.dragTo(from + d);
  EXPECT_TRUE(update.reached) << update.message;
  expectNear(ballOf(update.scene()).velocity - before.velocity, d / 0.5, 1e-8, "throw");
  expectNear(ballOf(update.scene()).position - before.position, -0.3 / 0.5 * d, 1e-8, "start");
}

// Where bounds keep the target out of reach each component ends as near as its bounds let it.
TEST(ClosedForm, ADragEndsAtTheBoundsThatAreNearest) {
  const Scene scene = flight();
  const Body before = ballOf(scene);
  OdeContacts contacts(scene);
  Control bounded = velocity("ball");
  bounded.min = {1, 0, 1.9}, bounded.max = {2, 0.6, 3};
  EditSession session(scene, contacts, 1.2, {bounded}, {});
  session.grab("ball", kTime);
  const Vec3 from = session.grabbedPlace();
  const SessionUpdate update = session.dragTo(from + Vec3(1, -0.1, -0.5));
  EXPECT_FALSE(update.reached);
  const Vec3 change(0.5, -0.125, -0.1);  // by the bound, as asked for, by the bound
  expectNear(ballOf(update.scene()).velocity - before.velocity, change, 1e-9, "throw");
  EXPECT_TRUE(std::abs(update.distance - (Vec3(1, -0.1, -0.5) - kTime * change).norm()) <= 1e-9) << update.distance;
}

TEST(ClosedForm, AnEditChangesStartAndThrowAsLittleAsCanBe) {
  const Scene scene = flight();
  const Least least(scene);
  const Body before = ballOf(scene);
  const Vec3 d(0.8, -0.3, 0.4);
  const Vec3 there = before.position + kTime * before.velocity + 0.5 * kTime * kTime * scene.gravity + d;
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.2);
  edit.vary(position("ball").weighted(kPlaceWeight), velocity("ball").weighted(kSpeedWeight));
  edit.nail("ball", kTime).position(there);
  for (const SecondDerivatives source :
       {SecondDerivatives::exact, SecondDerivatives::secant, SecondDerivatives::limited_memory}) {
    EditOptions options;
    options.second_derivatives = source;
    const EditResult result = edit.solve(options);
    EXPECT_EQ(result.status, EditStatus::solved) << result.message;
    expectNear(ballOf(result.scene).position - before.position, least.place(d), 1e-8, "start");
    expectNear(ballOf(result.scene).velocity - before.velocity, least.speed(d), 1e-8, "throw");
    const double objective = 0.5 * d.squaredNorm() / (least.A + least.B * kTime * kTime);
    EXPECT_TRUE(std::abs(result.objective - objective) <= 1e-8 * objective) << result.objective << ", " << objective;
  }
}

// A ball that is dropped from the height h is back at the height y, at the time t after its impact, where
// y = e u t - g t^2/2, u^2 = 2 g h: one elasticity does that.
TEST(ClosedForm, AnEditFindsTheElasticityOfABounce) {
  Scene scene;
  scene.materials = {material("felt", 0.8, 0)};
  const double h = 1, r = 0.1, g = 9.81;
  scene.bodies = {fixedPlane("floor", "felt", Vec3::UnitZ(), 0), ball("ball", "felt", r, {0, 0, h + r}, Vec3::Zero())};
  const double u = std::sqrt(2 * g * h), fall = u / g;
  OdeContacts contacts(scene);
  for (const double e : {0.5, 0.7, 0.95}) {
    const double t = 0.3, y = e * u * t - 0.5 * g * t * t;
    Edit edit(scene, contacts, 2);
    edit.vary(elasticity("felt"));
    edit.nail("ball", fall + t).position(any, any, y + r);
    const EditResult result = edit.solve();
    EXPECT_TRUE(result.solved()) << result.message;
    EXPECT_TRUE(std::abs(result.scene.materials[0].elasticity - e) <= 1e-9) << result.scene.materials[0].elasticity;
  }
}

}  // namespace
}  // namespace carom
