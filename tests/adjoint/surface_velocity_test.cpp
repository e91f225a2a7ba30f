// SPDX-License-Identifier: MIT
// Surfaces that move beside their bodies, belts and turntables: closed forms of impacts with them, the same motion seen from
// a frame that moves, and the work that they do.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

constexpr double kState = 1e-12, kDerivative = 1e-9;

void expectNear(double found, double expected, double tolerance, const std::string& what) {
  EXPECT_TRUE(std::abs(found - expected) <= tolerance * std::max(1.0, std::abs(expected)))
      << what << ": " << found << ", expected " << expected;
}
void expectNear(const Vec3& found, const Vec3& expected, double tolerance, const std::string& what) {
  for (int i = 0; i < 3; ++i) expectNear(found[i], expected[i], tolerance, what + "." + "xyz"[i]);
}

Body kinematic(Body body) {
  body.fixed = false, body.kinematic = true;
  body.mass.reset();
  return body;
}

Scene inOrder(Scene scene, bool belt_first) {
  if (belt_first) std::swap(scene.bodies[0], scene.bodies[1]);
  return scene;
}

Body tumblingBox(double height) {
  Body box = makeBox("box", {0.3, 0.2, 0.1}, {0, 0, height}, {0.4, 0.2, 0.5});
  box.orientation = Quat(0.9, 0.2, 0.3, -0.1).normalized();
  box.angular_velocity = {3, -2, 1};
  return box;
}

// A ball of a uniform solid (k = 2/5) falls on a belt. With slip s = v - beta an impact that sticks changes v by
// -s k/(1 + k), one that slides by -mu (1 + e) w s/|s|.
struct Falling {
  double r = 0.1, h = 0.6, g = 9.8, e = 0.5, mu = 3;
  Vec3 v{0.7, -0.2, 0}, beta{-1.1, 0.5, 0};  // the belt runs against the ball
  Quat turned = Quat::Identity();            // of the whole scene
  static constexpr double k = 0.4;

  double tau() const { return std::sqrt(2 * (h - r) / g); }
  double meets() const { return g * tau(); }
  Scene scene() const {
    Body ball = makeBall("ball", r, turned * Vec3(0.3, -0.2, h), turned * v);
    Body belt = fixedBody(makeBox("belt", {20, 20, 1}, turned * Vec3(0, 0, -0.5)));
    belt.orientation = turned;
    belt.surface_velocity = beta;
    return makeScene(turned * Vec3(0, 0, -g), e, mu, {ball, belt});
  }
};

TEST(SurfaceVelocity, BallThatSticksTakesItsShareOfTheBelt) {
  for (const Quat& turned : {Quat::Identity(), Quat(0.8, 0.3, -0.4, 0.2).normalized()})
    for (const bool belt_first : {false, true}) {
      Falling c;
      c.turned = turned;
      const Scene scene = inOrder(c.scene(), belt_first);
      const int ball = bodyIndex(scene, "ball"), belt = bodyIndex(scene, "belt");
      const double T = c.tau() + 0.2, share = c.k / (1 + c.k);
      const Motion m = play(scene, T);
      ASSERT_EQ(m.events.size(), 1u);
      EXPECT_EQ(m.events[0].mode, ImpactMode::stick);
      const double sign = m.events[0].contacts[0].a == ball ? -1 : 1;
      expectNear(m.events[0].contacts[0].surface_velocity, sign * (turned * c.beta), kState, "of the contact");
      const Vec3 v = c.v + share * (c.beta - c.v) + Vec3(0, 0, c.e * c.meets());
      const BodyState after = m.stateAfter(0, ball);
      expectNear(turned.conjugate() * after.velocity, v, kState, "velocity");
      expectNear(turned.conjugate() * (after.velocity + after.angular_velocity.cross(turned * Vec3(0, 0, -c.r))),
                 c.beta + Vec3(0, 0, v.z()), kState, "velocity of its lowest point");
      for (int i = 0; i < 3; ++i) {
        const Vec3 row = turned.conjugate().toRotationMatrix().transpose().row(i).transpose();  // of world in the belt's axes
        const SceneGradient d = gradientOf(m, ball, T, 6 + i), at = gradientOf(m, ball, T, i);
        const Vec3 along(share * row.x(), share * row.y(), 0);
        expectNear(d.bodies[static_cast<std::size_t>(belt)].surface_velocity, along, kDerivative, "velocity by the belt's");
        expectNear(at.bodies[static_cast<std::size_t>(belt)].surface_velocity, 0.2 * along, kDerivative, "position by the belt's");
        EXPECT_TRUE(at.bodies[static_cast<std::size_t>(ball)].surface_velocity.isZero(0));
      }
    }
}

TEST(SurfaceVelocity, BallThatSlidesIsPulledAlongTheSlip) {
  Falling c;
  c.mu = 0.08;
  const Scene scene = c.scene();
  const Motion m = play(scene, c.tau() + 0.1);
  ASSERT_EQ(m.events.size(), 1u);
  EXPECT_EQ(m.events[0].mode, ImpactMode::slide);
  const Vec3 slip = c.v - c.beta;
  const double pull = c.mu * (1 + c.e) * c.meets();
  expectNear(m.stateAfter(0, 0).velocity, Vec3(c.v - pull * slip.normalized() + Vec3(0, 0, c.e * c.meets())), kState, "velocity");
  // by beta: pull (1 - d d^T)/|s|
  const Vec3 d = slip.normalized();
  const SceneGradient gradient = gradientOf(m, 0, m.end, 6);
  expectNear(gradient.bodies[1].surface_velocity, Vec3(pull / slip.norm() * (Vec3::UnitX() - d.x() * d)).cwiseProduct(Vec3(1, 1, 0)),
             kDerivative, "by the belt's");
}

TEST(SurfaceVelocity, BeltAtRestHasADerivative) {
  Falling c;
  c.beta.setZero();
  const Motion m = play(c.scene(), c.tau() + 0.2);
  const double share = c.k / (1 + c.k);
  expectNear(gradientOf(m, 0, m.end, 6).bodies[1].surface_velocity, Vec3(share, 0, 0), kDerivative, "by the belt's");
  const double across = m.events[0].contacts[0].at.point.y();  // of the plate's origin, which is half a metre lower
  expectNear(gradientOf(m, 0, m.end, 6).bodies[1].surface_angular_velocity, share * Vec3(0, 0.5, -across), kDerivative,
             "by the table's");
}

// At the radius rho of a plate that turns at Omega the surface runs at Omega rho; its middle is where the plate's origin is.
TEST(SurfaceVelocity, TurntableDragsAcrossTheRadius) {
  Falling c;
  c.v.setZero();
  Scene scene = c.scene();
  const double Omega = 3.5;
  scene.bodies[1].surface_velocity.setZero();
  scene.bodies[1].surface_angular_velocity = {0, 0, Omega};
  scene.bodies[1].position.head<2>() = Vec2(0.1, 0.05);
  const Motion m = play(scene, c.tau() + 0.3);
  ASSERT_EQ(m.events.size(), 1u);
  const Vec2 radius = scene.bodies[0].position.head<2>() - scene.bodies[1].position.head<2>();
  const double share = c.k / (1 + c.k);
  const Vec3 along = share * Vec3(-radius.y(), radius.x(), 0);
  expectNear(m.stateAfter(0, 0).velocity, Vec3(Omega * along + Vec3(0, 0, c.e * c.meets())), kState, "velocity");
  const SceneGradient d = gradientOf(m, 0, m.end, 0);
  expectNear(d.bodies[1].surface_angular_velocity.z(), 0.3 * along.x(), kDerivative, "by Omega");
  expectNear(d.bodies[1].position.y(), 0.3 * share * Omega, kDerivative, "by where the plate is");
  expectNear(d.bodies[0].position.y(), -0.3 * share * Omega, kDerivative, "by where the ball is");
}

// A belt and a plate that moves along its own face are the same to what falls on them.
TEST(SurfaceVelocity, IsThatOfAPlateThatMovesAlong) {
  Scene belt = makeScene({0, 0, -9.81}, 0.7, 0.3, {tumblingBox(0.8), fixedBody(makeBox("belt", {40, 40, 1}, {0, 0, -0.5}))});
  Scene plate = belt;
  belt.bodies[1].surface_velocity = {0.9, -0.6, 0};
  plate.bodies[1] = kinematic(plate.bodies[1]);
  plate.bodies[1].velocity = {0.9, -0.6, 0};
  const Motion a = play(belt, 0.8), b = play(plate, 0.8);
  ASSERT_GT(a.events.size(), 2u);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (double t = 0; t <= 0.8; t += 0.1)
    EXPECT_TRUE((flatten(a.stateAt(0, t)) - flatten(b.stateAt(0, t))).norm() <= 1e-12) << t;
}

// Seen from a frame that moves at -V: all bodies move by V more, belts with them.
TEST(SurfaceVelocity, IsTheSameInAMovingFrame) {
  const Vec3 V(0.7, -1.1, 0.4);
  Scene still = makeScene({0, 0, -9.81}, 0.7, 0.3, {tumblingBox(0.9), kinematic(makeBox("belt", {8, 8, 1}, {0, 0, -0.5}))});
  still.bodies[1].orientation = Quat(0.99, 0.05, -0.04, 0.1).normalized();
  still.bodies[1].surface_velocity = {0.9, -0.6, 0.3}, still.bodies[1].surface_angular_velocity = {0.5, 0.4, 2};
  Scene moving = still;
  for (Body& b : moving.bodies) b.velocity += V;
  const Motion a = play(still, 0.9), b = play(moving, 0.9);
  ASSERT_GT(a.events.size(), 1u);
  ASSERT_EQ(a.signature(), b.signature());
  for (double t = 0; t <= 0.9; t += 0.1) {
    const BodyState s = a.stateAt(0, t), u = b.stateAt(0, t);
    EXPECT_TRUE((s.position + t * V - u.position).norm() <= 1e-12) << t;
    EXPECT_TRUE((s.velocity + V - u.velocity).norm() <= 1e-12) << t;
    EXPECT_TRUE((s.angular_velocity - u.angular_velocity).norm() <= 1e-11) << t;
  }
}

// Energy grows by no more than the work of the surface, P . (V + W x (p - X) + beta).
TEST(SurfaceVelocity, EnergyGrowsByItsWorkAlone) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Body slab = kinematic(makeBox("slab", {4, 4, 0.4}, Vec3::Zero(), random.vec(0.5)));
    slab.orientation = Quat(1, 0.1 * random.in(-1, 1), 0.1 * random.in(-1, 1), 0.3).normalized();
    slab.angular_velocity = random.vec(0.8);
    slab.surface_velocity = random.vec(3), slab.surface_angular_velocity = random.vec(4);
    Body box = makeBox("box", {0.5, 0.3, 0.2}, {0.2, -0.1, 1.5}, random.vec(1));
    box.orientation = random.rotation(), box.angular_velocity = random.vec(4);
    Scene scene = makeScene({0, 0, -9.81}, random.in(0, 1), 0, {slab, box});
    scene.materials[0].friction = random.in(0, 1.5);
    const Motion m = play(scene, 1.5, 6);
    ASSERT_FALSE(m.events.empty());
    double grown = 0;
    for (std::size_t e = 0; e < m.events.size(); ++e) {
      const Event& event = m.events[e];
      const BodyState s = m.stateAfter(static_cast<int>(e), 0);
      double work = 0;
      for (const Contact& c : event.contacts) {
        const Vec3 point = s.velocity + s.angular_velocity.cross(c.at.point - s.position) + (c.a == 0 ? 1 : -1) * c.surface_velocity;
        work += (c.a == 1 ? 1.0 : -1.0) * c.impulse.dot(point);
      }
      const Participant* p = event.find(1);
      ASSERT_NE(p, nullptr);
      const State& after = m.world_lines[1].arcs[static_cast<std::size_t>(p->next())].startState();
      const double change = kineticEnergy((*m.models)[1], after) - kineticEnergy((*m.models)[1], p->before);
      EXPECT_TRUE(change <= work + 1e-12 * (1 + std::abs(work))) << "event " << e << ": " << change << ", work " << work;
      grown = std::max(grown, change);
    }
  }
}

// A parcel that is put on a belt, or bounces on it, is carried in the end.
TEST(SurfaceVelocity, CarriesWhatComesToLieOnIt) {
  for (const bool belt_first : {false, true})
    for (const double drop : {0.0, 0.3}) {
      const Body parcel = makeBox("parcel", {0.3, 0.2, 0.1}, {0, 0, 0.05 + drop});
      Scene scene = makeScene({0, 0, -9.81}, 0.2, 0.4, {parcel, makePlane("belt", Vec3::UnitZ(), 0)});
      scene.bodies[1].surface_velocity = {1.5, 0, 0};
      scene = inOrder(scene, belt_first);
      OdeContacts contacts(scene);
      const Motion m = simulate(scene, contacts, 5.0);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      const BodyState end = m.stateAt("parcel", 5);
      expectNear(end.velocity, Vec3(1.5, 0, 0), kState, "velocity");
      EXPECT_TRUE(end.angular_velocity.norm() <= kState);
    }
}

TEST(SurfaceVelocity, BelongsToWhatImpactsDoNotMove) {
  for (Vec3 Body::* member : {&Body::surface_velocity, &Body::surface_angular_velocity}) {
    const std::string name = member == &Body::surface_velocity ? "surface_velocity" : "surface_angular_velocity";
    Scene scene = makeScene(Vec3::Zero(), 0.5, 0.5, {makePlane("floor", Vec3::UnitZ(), 0), makeBall("ball", 0.1, {0, 0, 1})});
    scene.bodies[0].*member = {1, 2, 3};
    EXPECT_NO_THROW(validate(scene));
    const auto expectRefused = [&](const std::string& where) {
      try {
        validate(scene);
        FAIL() << name;
      } catch (const InputError& error) {
        EXPECT_EQ(error.where(), where);
      }
    };
    scene.bodies[1].*member = {0, 0, 1e-3};
    expectRefused("/bodies/1/" + name);
    scene.bodies[1] = kinematic(scene.bodies[1]);
    EXPECT_NO_THROW(validate(scene));
    (scene.bodies[0].*member)[1] = std::nan("");
    expectRefused("/bodies/0/" + name + "/1");
  }
}

}  // namespace
}  // namespace carom
