// SPDX-License-Identifier: MIT
// Bodies that a belt hands on to a flush floor or to the next belt. Expected values are closed forms, their derivatives those
// along the imaginary axis.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "adjoint/derivative/adjoint.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::belt_to_belt {
namespace {

using namespace test;
using Complex = std::complex<double>;

constexpr double kG = 9.81;
const Vec3 kDown(0, 0, -kG);

// Its top is at height 0, from x to x + length; a speed of 0 is a floor.
Body belt(const char* name, double x, double length, double speed) {
  Body body = fixedBody(makeBox(name, {length, 4, 0.2}, {x + length / 2, 0, -0.1}));
  body.surface_velocity = {speed, 0, 0};
  return body;
}

// A body on feet: one in front at x = front, two behind at x = -back, its centre of mass at height h.
Body onFeet(double front, double back, double height, const Vec3& at, double speed) {
  const double r = 0.01;
  Body body = makeBall("parcel", r, at, {speed, 0, 0});
  body.shape = Compound{{{Sphere{r}, {front, 0, r - height}}, {Sphere{r}, {-back, 0.1, r - height}}, {Sphere{r}, {-back, -0.1, r - height}}}};
  body.center_of_mass = Vec3::Zero();
  body.inertia = Inertia::fromMoments({0.01, 0.012, 0.015});
  body.position.z() = height;
  return body;
}

Scene inOrder(Scene scene, bool reverse) {
  if (reverse) std::ranges::reverse(scene.bodies);
  return scene;
}

const BodyDerivative& of(const Scene& scene, const SceneGradient& g, const char* body) {
  return g.bodies[static_cast<std::size_t>(bodyIndex(scene, body))];
}

// What the closed forms depend on.
struct Inputs {
  Complex x, v, first, second, mu, g = kG;
};

// Against the values and derivatives of a place, from these inputs of a scene with "first", "second" and "parcel".
void expectPlace(const Motion& m, const Scene& scene, double t, const std::function<Complex(const Inputs&)>& place, const Inputs& in, double within) {
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  const int body = bodyIndex(scene, "parcel");
  expectEntries(m.stateAt(body, t).position.x(), place(in).real(), 1e-12, "place");
  expectEntries(m.stateAt(body, t).position.y(), 0, 1e-12, "it goes straight on");
  const SceneGradient d = gradientOf(m, body, t, 0);
  const auto by = [&](Complex Inputs::* number) {
    Inputs moved = in;
    moved.*number += Complex(0, 1e-40);
    return place(moved).imag() / 1e-40;
  };
  expectEntries(of(scene, d, "parcel").position.x(), by(&Inputs::x), within, "by its place");
  expectEntries(of(scene, d, "parcel").velocity.x(), by(&Inputs::v), within, "by its velocity");
  expectEntries(of(scene, d, "first").surface_velocity.x(), by(&Inputs::first), within, "by the first belt's speed");
  if (in.second != 0.0) expectEntries(of(scene, d, "second").surface_velocity.x(), by(&Inputs::second), within, "by the second belt's speed");
  expectEntries(d.materials[0].friction, by(&Inputs::mu), within, "by friction");
  expectEntries(-d.gravity.z(), by(&Inputs::g), within, "by gravity");
}

// v + 2/5 r w stays what it is, so that on a belt of speed b it comes to roll at (v + 2/5 r w + 2/5 b)/(7/5).
Complex ballAt(const Inputs& in, double t) {
  const Complex rolls[] = {(in.v + 0.4 * in.first) / 1.4, (in.v + 0.4 * in.second) / 1.4};
  const auto slides = [&](Complex from, Complex to) { return (to.real() > from.real() ? to - from : from - to) / (in.mu * in.g); };
  const Complex slip = slides(in.v, rolls[0]), rolls_at = in.x + 0.5 * (in.v + rolls[0]) * slip;
  const Complex crosses = slip - rolls_at / rolls[0], then = slides(rolls[0], rolls[1]);
  return 0.5 * (rolls[0] + rolls[1]) * then + rolls[1] * (t - crosses - then);
}

TEST(BeltToBelt, ABallRollsOn) {
  const double mu = 0.3, x = -1, v = 0.4, T = 2.5;
  for (const double second : {2.0, 0.5, 0.0})
    for (const bool reverse : {false, true}) {
      SCOPED_TRACE(second);
      const Scene scene = inOrder(makeScene(kDown, 0, mu, {belt("first", -4, 4, 1.5), belt("second", 0, 8, second), makeBall("parcel", 0.1, {x, 0, 0.1}, {v, 0, 0})}), reverse);
      const Motion m = playLasting(scene, T);
      const Inputs in{x, v, 1.5, second, mu};
      expectPlace(m, scene, T, [&](const Inputs& i) { return ballAt(i, T); }, in, 1e-10);
      if (second != 0) expectTransposed(m, 1, 1e-11);
    }
}

// Its feet behind bear more, and hold it to the first belt until they cross; then friction takes it to the other speed.
Complex heldAt(const Inputs& in, double back, double t) {
  const Complex crosses = (back - in.x) / in.first;
  const Complex slides = (in.second.real() > in.first.real() ? in.second - in.first : in.first - in.second) / (in.mu * in.g);
  return back + 0.5 * (in.first + in.second) * slides + in.second * (t - crosses - slides);
}

TEST(BeltToBelt, AParcelIsHeldByTheFeetThatBearMore) {
  const double mu = 0.3, front = 0.3, back = 0.1, x = -0.8, first = 1, T = 1.8;
  for (const double second : {1.6, 0.4, 0.0})
    for (const bool reverse : {false, true}) {
      SCOPED_TRACE(second);
      const Scene scene = inOrder(makeScene(kDown, 0, mu, {belt("first", -4, 4, first), belt("second", 0, 8, second), onFeet(front, back, 0.05, {x, 0, 0}, first)}), reverse);
      const Motion m = playLasting(scene, T);
      const Inputs in{x, first, first, second, mu};
      expectPlace(m, scene, T, [&](const Inputs& i) { return heldAt(i, back, T); }, in, 1e-8);
      expectEntries(m.stateAt(bodyIndex(scene, "parcel"), T).velocity.x(), second, 1e-12, "as the second");
      EXPECT_EQ(m.world_lines[static_cast<std::size_t>(bodyIndex(scene, "parcel"))].arcs.back().kind(), second == 0 ? ArcKind::rest : ArcKind::ride);
      if (second != 0) expectTransposed(m, 2, 1e-11);
    }
}

// Its foot in front bears more, and pulls it: m a = mu (N_f - N_b), N_f (f + mu h) = N_b (b + mu h), until the feet behind cross;
// then all of mu g does.
Complex pulledAt(const Inputs& in, double front, double back, double height, double t) {
  const Complex pull = in.mu * in.g * (back - front) / (front + back + 2.0 * in.mu * height);
  const Complex meets = (-front - in.x) / in.first, then = std::sqrt(in.first * in.first + 2.0 * pull * (front + back));
  const Complex crosses = meets + (then - in.first) / pull, slides = (in.second - then) / (in.mu * in.g);
  return back + 0.5 * (then + in.second) * slides + in.second * (t - crosses - slides);
}

TEST(BeltToBelt, AParcelIsPulledByTheFootThatBearsMore) {
  const double mu = 0.3, front = 0.1, back = 0.3, height = 0.05, x = -0.8, first = 1, second = 3, T = 1.6;
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(makeScene(kDown, 0, mu, {belt("first", -4, 4, first), belt("second", 0, 8, second), onFeet(front, back, height, {x, 0, 0}, first)}), reverse);
    const Motion m = playLasting(scene, T);
    const Inputs in{x, first, first, second, mu};
    expectPlace(m, scene, T, [&](const Inputs& i) { return pulledAt(i, front, back, height, T); }, in, 1e-8);
    expectTransposed(m, 3, 1e-11);
  }
}

// A box on four corners: the same mirrored, and in either order.
TEST(BeltToBelt, ABoxGoesOnInAnyOrder) {
  const double T = 3;
  for (const double second : {0.0, 0.6, 1.0, 2.0}) {
    SCOPED_TRACE(second);
    const auto play = [&](bool reverse, double across) {
      const Scene scene = inOrder(makeScene(kDown, 0, 0.4, {belt("first", -4, 4, 1), belt("second", 0, 8, second), makeBox("parcel", {0.3, 0.3, 0.2}, {-0.8, across, 0.1}, {1, 0, 0})}), reverse);
      const Motion m = playLasting(scene, T);
      EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
      return m.stateAt(bodyIndex(scene, "parcel"), T);
    };
    const BodyState a = play(false, 0.3), b = play(true, 0.3), mirrored = play(false, -0.3);
    expectEntries(b.position, a.position, 1e-11, "the other order");
    expectEntries(mirrored.position, Vec3(a.position.x(), -a.position.y(), a.position.z()), 1e-11, "the mirror image");
    expectEntries(a.velocity, Vec3(second, 0, 0), 1e-11, "as the second");
    expectEntries(a.position.y(), 0.3, 1e-11, "straight on");
  }
}

}  // namespace
}  // namespace carom::belt_to_belt
