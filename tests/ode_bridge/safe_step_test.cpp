// SPDX-License-Identifier: MIT
// A safe step ends before the pieces touch, whatever they spin about; and bodies that glide along each other or spin in
// place at a tiny gap are followed in a few of them.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "adjoint/flight/flight_symmetric.hpp"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "ode_bridge/separation.hpp"
#include "tests/support/scenes.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using namespace test;

enum class Spin { none, along_normal, along_axis, nearly_along_normal, any };

Body bodyOf(int kind, Random& random) {
  Body body = makeBall("", 0.5, random.vec(1));
  const double r = random.in(0.1, 0.4), h = random.in(0.1, 1);
  switch (kind) {
    case 0:
      body.shape = Box{{h, 0.5, 0.3}};
      break;
    case 1:
      body.shape = Box{{0.5, 0.5, 0.5}};  // every axis is steady
      break;
    case 2:
      body.shape = Cylinder{r, h};
      break;
    case 3:
      body.shape = Capsule{r, h};
      break;
    case 4:
      body.shape = Hull{convexHull({{0, 0, 0}, {1, 0, 0}, {0, 0.7, 0}, {0.1, 0, 0.5}, {0.5, 0.4, 0.3}}), 1, ""};
      break;
    default:
      body.shape = Cylinder{r, h};
      body.inertia = Inertia::fromMoments({0.02, 0.03, 0.04});  // round, yet triaxial
  }
  body.orientation = random.below(2) ? random.rotation() : Quat::Identity();
  return body;
}

void setSpin(Body& body, Spin spin, const Vec3& n, double speed, Random& random) {
  switch (spin) {
    case Spin::none:
      break;
    case Spin::along_normal:
      body.angular_velocity = speed * n;
      break;
    case Spin::along_axis:
      body.angular_velocity = speed * (body.orientation * Vec3::UnitZ());
      break;
    case Spin::nearly_along_normal:
      body.angular_velocity = speed * (n + random.vec(std::pow(10, random.in(-9, -1))));
      break;
    case Spin::any:
      body.angular_velocity = speed * random.unit();
  }
}

struct Longest {
  int steps = 0, whole = 0;
  double shortest_room = std::numeric_limits<double>::infinity();
};

// Follows the witness's own bound over its step against the separation that the pieces really have.
void expectSafe(std::uint64_t seed, Longest& longest) {
  Random random(seed);
  Body body_a = bodyOf(random.below(6), random), body_b = bodyOf(random.below(6), random);
  const Solid solid_a = solidOf(body_a), solid_b = solidOf(body_b);
  const auto placedAt = [](const Solid& solid, const Body& b) {
    return Placed(solid, b.position, b.orientation.toRotationMatrix());
  };
  // along the witness the bodies are put at a chosen gap
  Placed pa = placedAt(solid_a, body_a), pb = placedAt(solid_b, body_b);
  const Witness far = findWitness({&pa, &solid_a.pieces[0]}, {&pb, &solid_b.pieces[0]});
  const double gap = std::pow(10, random.in(-10, -1));
  body_a.position += (gap - far.separation) * far.n;
  for (Body* body : {&body_a, &body_b}) {
    setSpin(*body, static_cast<Spin>(random.below(5)), far.n, std::pow(10, random.in(-1, 2)), random);
    body->velocity = random.below(2) ? random.vec(1) : Vec3::Zero();
    if (random.below(3) == 0) body->velocity -= far.n * far.n.dot(body->velocity);
  }
  const BodyModel model_a = modelOf(body_a), model_b = modelOf(body_b);
  const auto tierOf = [](const BodyModel& m) {
    const Vec3& I = m.inertia;
    if (I[0] == I[1] && I[1] == I[2]) return Tier::spherical;
    return I[0] == I[1] || I[1] == I[2] || I[0] == I[2] ? Tier::symmetric : Tier::triaxial;
  };
  const Vec3 gravity = random.below(2) ? Vec3(0, 0, -10) : Vec3::Zero();
  Arc arc_a(model_a, tierOf(model_a), gravity, 0, startState(body_a, model_a));
  Arc arc_b(model_b, tierOf(model_b), gravity, 0, startState(body_b, model_b));
  const double limit = 2;
  arc_a.extendTo(limit), arc_b.extendTo(limit);
  pa = Placed(solid_a, arc_a, 0), pb = Placed(solid_b, arc_b, 0);
  const PlacedPiece a{&pa, &solid_a.pieces[0]}, b{&pb, &solid_b.pieces[0]};
  const Witness witness = findWitness(a, b);
  if (!(witness.separation > 1e-12)) return;
  const double h = safeStep(a, b, witness, 0, limit);
  ASSERT_TRUE(h > 0 && h <= limit) << h;
  ++longest.steps;
  longest.whole += h == limit;
  for (int i = 1; i <= 40; ++i) {
    const double t = h * i / 40;
    const Placed qa(solid_a, arc_a, t), qb(solid_b, arc_b, t);
    const Witness then = findWitness({&qa, a.piece}, {&qb, b.piece});
    ASSERT_TRUE(then.separation >= -1e-12) << "at " << t << " of " << h << ", gap " << gap << ", frame "
                                           << static_cast<int>(witness.frame);
    longest.shortest_room = std::min(longest.shortest_room, then.separation);
  }
}

TEST(SafeStep, EndsBeforeAnythingTouches) {
  Longest longest;
  for (std::uint64_t seed = 1; seed <= 4000 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectSafe(seed, longest);
  }
  std::printf("%d steps, %d of them to the end; nearest at their ends %.1e m\n", longest.steps, longest.whole,
              longest.shortest_room);
  EXPECT_GT(longest.steps, 3000);
}

Body turning(Body body, const Vec3& spin, const Quat& orientation = Quat::Identity()) {
  body.angular_velocity = spin;
  body.orientation = orientation;
  return body;
}
Body shaped(const Shape& shape, const Vec3& position) {
  Body body = makeBall("body", 1, position);
  body.shape = shape;
  return body;
}

// Each of these took from seconds to minutes when a spin counted in full.
TEST(Gliding, CostsWhatItsCurvatureAsksFor) {
  const Quat lying(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
  const Body floor = makePlane("floor", Vec3::UnitZ(), 0);
  const Body slab = fixedBody(makeBox("slab", {20, 20, 2}, {0, 0, -1}));
  const double gap = 1e-8;
  const struct {
    const char* name;
    std::vector<Body> bodies;
  } scenes[] = {
      {"cube on cube", {makeBox("low", {1, 1, 1}, {0, 0, 5}), turning(makeBox("top", {1, 1, 1}, {0, 0, 6 + 1e-12}, {0.3, 0, 0}), {0, 0, 1})}},
      {"cube on cube, both turn", {turning(makeBox("low", {1, 1, 1}, {0, 0, 5}), {0, 0, -20}), turning(makeBox("top", {1, 1, 1}, {0, 0, 6 + 1e-12}, {0.3, 0, 0}), {0, 0, 30})}},
      {"cube flush on a plane", {floor, turning(makeBox("cube", {1, 1, 1}, {0, 0, 0.5}), {0, 0, 100})}},
      {"cube flush on a slab", {slab, turning(makeBox("cube", {1, 1, 1}, {0, 0, 0.5}), {0, 0, 100})}},
      {"cube slides and turns", {slab, turning(makeBox("cube", {1, 1, 1}, {0, 0, 0.5 + 1e-12}, {3, 0, 0}), {0, 0, 7})}},
      {"brick about its largest moment", {slab, turning(makeBox("brick", {1, 1.5, 0.3}, {0, 0, 0.15 + gap}), {0, 0, 100})}},
      {"brick about its smallest moment", {slab, turning(makeBox("brick", {1, 1.5, 4}, {0, 0, 2 + gap}), {0, 0, 100})}},
      {"capsule about its axis", {floor, turning(shaped(Capsule{0.1, 1}, {0, 0, 0.1 + gap}), {0, 100, 0}, lying)}},
      {"cylinder about its axis", {slab, turning(shaped(Cylinder{0.1, 1}, {0, 0, 0.1 + gap}), {0, 100, 0}, lying)}},
      {"cylinder on its end", {slab, turning(shaped(Cylinder{0.1, 1}, {0, 0, 0.5 + gap}), {0, 0, 100})}},
      {"cube at 1e9 rad/s", {floor, turning(makeBox("cube", {1, 1, 1}, {0, 0, 0.5 + gap}), {0, 0, 1e9})}},
  };
  for (const auto& scene : scenes) {
    SCOPED_TRACE(scene.name);
    const Motion m = play(makeScene(Vec3::Zero(), 0.5, 0.3, scene.bodies), 1);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.events.size(), 0u);
    EXPECT_LE(m.steps, 100u);
  }
}

// At 1e9 rad/s about the axis that it falls along, a slow approach is still an approach.
TEST(Gliding, SpinAboutTheNormalHidesNoApproach) {
  const Motion m = play(makeScene({0, 0, -9.81}, 0.5, 0.3,
                                  {makePlane("floor", Vec3::UnitZ(), 0),
                                   turning(shaped(Capsule{0.1, 1}, {0, 0, 1}), {0, 0, 1e9})}),
                        1);
  EXPECT_EQ(m.status, MotionStatus::not_computable) << m.message;  // each of its turns would take steps
  EXPECT_NE(m.message.find("it rotates too fast"), std::string::npos) << m.message;
  EXPECT_GE(m.events.size(), 18u);
}

// Of an acceleration only a mean and how far it may be from it are known: whatever it is, the step ends before.
TEST(SafeStep, WhereTheAccelerationVaries) {
  int stopped = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Body body = bodyOf(random.below(4), random), other = fixedBody(makeBox("", {1, 1, 1}, Vec3::Zero()));
    body.angular_velocity = random.below(2) ? random.vec(5) : Vec3::Zero();
    body.position = 2 * random.unit(), body.velocity = -random.in(0, 3) * body.position + random.vec(1);
    const Solid a = solidOf(body), b = solidOf(other);
    const BodyModel ma = modelOf(body), mb = modelOf(other);
    const Vec3 pull = random.vec(20), off = random.vec(20);
    const int axis = adjoint_detail::symmetryAxis(ma.inertia);
    const Tier tier = axis < 0 ? Tier::spherical : axis < 3 && random.below(2) ? Tier::symmetric : Tier::triaxial;
    const Arc arc_a(ma, tier, pull, 0, startState(body, ma));
    Arc path = arc_a;
    path.extendTo(2);
    const Arc arc_b(mb, Tier::none, Vec3::Zero(), 0, startState(other, mb));
    Placed pa(a, path, 0);
    const Placed pb(b, arc_b, 0);
    pa.acceleration += off, pa.variation = off.norm();
    const PlacedPiece p{&pa, &a.pieces[0]}, q{&pb, &b.pieces[0]};
    const Witness w = findWitness(p, q);
    if (!(w.separation > 0)) continue;
    const double h = safeStep(p, q, w, 0, 1);
    ASSERT_GT(h, 0);
    stopped += h < 1;
    for (int i = 1; i <= 20; ++i) {
      const Placed then(a, path, h * i / 20);
      EXPECT_TRUE(findWitness({&then, &a.pieces[0]}, q).separation >= -1e-13) << i;
    }
  }
  EXPECT_GT(stopped, 500);
}

}  // namespace
}  // namespace carom
