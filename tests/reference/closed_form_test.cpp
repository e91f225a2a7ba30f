// SPDX-License-Identifier: MIT
// The reference itself against the closed forms of docs/equations.md section 8, before anything is held to it.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/reference/cases.h"
#include "tests/reference/replay.h"

namespace carom::reference {
namespace {

constexpr double kState = 1e-13, kDerivative = 1e-11;  // relative; the figures below are written to 12 digits or more

#define EXPECT_CLOSE(found, expected, tolerance) \
  EXPECT_TRUE(close(found, expected, tolerance)) << #found << " = " << (found) << ", expected " << (expected)

bool close(double found, double expected, double tolerance) {
  return std::abs(found - expected) <= tolerance * std::max(1.0, std::abs(expected));
}

Material smooth(double elasticity) {
  Material m;
  m.name = "smooth", m.elasticity = elasticity, m.friction = 0;
  return m;
}

Body ball(const std::string& name, double radius, const Vec3& position, const Vec3& velocity) {
  Body body = makeBody(name, Sphere{radius}, "smooth");
  body.mass = 1;
  body.position = position, body.velocity = velocity;
  return body;
}

/// A floor with y up; floor and other planes are bodies 1, 2, ...
Scene ballOverFloor(double radius, const Vec3& position, const Vec3& velocity, double elasticity, double gravity) {
  Scene s;
  s.gravity = {0, -gravity, 0};
  s.materials = {smooth(elasticity)};
  s.bodies = {ball("ball", radius, position, velocity), makeFixed("floor", Plane{{0, 1, 0}, 0}, "smooth")};
  return s;
}

double derivative(const Scene& scene, const Reference& reference, const Row& row, const std::string& knob) {
  for (const Knob& k : knobsOf(scene)) {
    if (k.name == knob) return reference.derivative(k, {row})[0];
  }
  ADD_FAILURE() << "no knob " << knob;
  return NAN;
}

TEST(ClosedForm, OneBounceWithoutGravity) {
  const Scene s = ballOverFloor(0.1, {0, 1, 0}, {0, -2, 0}, 1, 0);
  const Reference r(s, scout(s, 1));
  ASSERT_EQ(r.events(), 1);
  const Row y{0, -1, 1, 1};
  EXPECT_CLOSE(r.stateAt(0, 1).position.y(), 1.2, kState);
  EXPECT_CLOSE(derivative(s, r, y, "position[0].1"), -1, kDerivative);
  EXPECT_CLOSE(derivative(s, r, y, "velocity[0].1"), -1, kDerivative);
  EXPECT_CLOSE(derivative(s, r, y, "elasticity[0].0"), 1.1, kDerivative);
  EXPECT_CLOSE(derivative(s, r, y, "size[0].0"), 2, kDerivative);
}

TEST(ClosedForm, FloorAndWall) {
  Scene s = ballOverFloor(0.1, {-0.5, 1, 0}, {5, -5, 0}, 0.92, 9.8);
  s.bodies.push_back(makeFixed("wall", Plane{{-1, 0, 0}, -1.75}, "smooth"));
  const Reference r(s, scout(s, 0.6));
  ASSERT_EQ(r.events(), 2);
  EXPECT_CLOSE(r.stateAt(0, 0.6).position.x(), 0.868, kState);
  EXPECT_CLOSE(r.stateAt(0, 0.6).position.y(), 1.8011886156577, kState);
  EXPECT_CLOSE(derivative(s, r, {0, -1, 0.6, 0}, "velocity[0].0"), -0.552, kDerivative);
  EXPECT_CLOSE(derivative(s, r, {0, -1, 0.6, 1}, "velocity[0].1"), -0.35232000310271, kDerivative);
}

TEST(ClosedForm, TwoEqualElasticBalls) {
  Scene s;
  s.gravity.setZero();
  s.materials = {smooth(1)};
  s.bodies = {ball("first", 0.1, {-0.7, 0, 0}, {1.3, 0, 0}), ball("second", 0.1, {0.4, 0, 0}, {-0.4, 0, 0})};
  const double T = 0.9;
  const Reference r(s, scout(s, T));
  ASSERT_EQ(r.events(), 1);
  const Row x2{1, -1, T, 0};
  EXPECT_CLOSE(derivative(s, r, x2, "position[0].0"), 1, kDerivative);
  EXPECT_CLOSE(derivative(s, r, x2, "position[1].0"), 0, kDerivative);
  EXPECT_CLOSE(derivative(s, r, x2, "velocity[0].0"), T, kDerivative);
  EXPECT_CLOSE(derivative(s, r, x2, "velocity[1].0"), 0, kDerivative);
}

TEST(ClosedForm, PointBall) {
  const double radius = 0.25;
  const Scene s = ballOverFloor(radius, {0, 5 + radius, 0}, {0, 0, 0}, 0.8, 9.8);
  const Reference r(s, scout(s, 2.5));
  const Row y{0, -1, 2.5, 1};
  EXPECT_CLOSE(r.stateAt(0, 2.5).position.y() - radius, 0.922727214752494, kState);
  EXPECT_CLOSE(derivative(s, r, y, "position[0].1"), 1.854772721475249, kDerivative);
  EXPECT_CLOSE(derivative(s, r, y, "velocity[0].1"), 0.6817254198060207, kDerivative);
  EXPECT_CLOSE(-derivative(s, r, y, "gravity[0].1"), -0.8521567747575258, kDerivative);
  EXPECT_CLOSE(derivative(s, r, y, "elasticity[0].0"), 14.74873734152916, kDerivative);
}

TEST(ClosedForm, ManyBouncesAndTheirTimes) {
  const double radius = 0.5, e = 0.8;
  const Scene s = ballOverFloor(radius, {0, 50 + radius, 0}, {0, 0, 0}, e, 9.8);
  const Reference r(s, scout(s, 15));
  ASSERT_EQ(r.events(), 3);
  EXPECT_CLOSE(r.stateAt(0, 15).position.y() - radius, 8.494217007606033, kState);
  EXPECT_CLOSE(derivative(s, r, {0, -1, 15, 1}, "elasticity[0].0"), 314.56883995768555, kDerivative);
  const double t1 = std::sqrt(2 * 50 / 9.8);
  double t = t1, power = 1;
  for (int n = 0; n < r.events(); ++n) {
    EXPECT_CLOSE(r.eventTime(n), t, kState);
    power *= e, t += 2 * t1 * power;
  }
}

TEST(ClosedForm, RodTipOnFloor) {
  Scene s;
  s.materials = {smooth(0.5)};
  Body rod = makeBody("rod", Box{{1, 1e-30, 1e-30}}, "smooth");
  rod.mass = 1;
  rod.inertia = Inertia::fromMoments(Vec3::Constant(1. / 12));
  rod.position = {0, 0, 1};
  rod.orientation = Quat(Eigen::AngleAxisd(0.5, Vec3::UnitY()));
  s.bodies = {rod, makeFloor("smooth")};
  const double T = 0.45;
  const Reference r(s, scout(s, T));
  ASSERT_EQ(r.events(), 1);
  const BodyState before = r.stateBefore(0, 0);
  // v+ and omega+ do not change but for gravity, whose part is known
  const double v_plus = r.stateAt(0, T).velocity.z() + 9.81 * (T - r.eventTime(0));
  const double spin = r.stateAt(0, T).angular_velocity.y();
  EXPECT_CLOSE(before.angular_velocity.norm(), 0, kState);
  EXPECT_CLOSE(v_plus, -2.112215513648, 1e-12);
  EXPECT_CLOSE(std::abs(spin), 9.2147033299731, 1e-12);
  const Row vz{0, -1, T, 8}, wy{0, -1, T, 10};
  EXPECT_CLOSE(derivative(s, r, vz, "inertia[0].1"), 14.656595640472, kDerivative);
  EXPECT_CLOSE(derivative(s, r, wy, "inertia[0].1") * (spin > 0 ? 1 : -1), -33.402203455138, kDerivative);
  EXPECT_CLOSE(derivative(s, r, wy, "elasticity[0].0") * (spin > 0 ? 1 : -1), 6.1431355533154, kDerivative);
}

/// Solid sphere on a plane with friction: K is diagonal, so the law is Coulomb's with 2/7 of the slip to stop.
TEST(ClosedForm, BallWithFriction) {
  const double e = 0.6, et = 0.3, R = 0.2;
  for (const double mu : {0.05, 0.8}) {
    Scene s = ballOverFloor(R, {0, 0.7, 0}, {1, -2, 0.5}, e, 9.81);
    s.materials[0].friction = mu, s.materials[0].tangential_elasticity = et;
    s.bodies[0].angular_velocity = {0.3, 0.2, 4};
    const double T = 0.3;
    const Reference r(s, scout(s, T));
    ASSERT_EQ(r.events(), 1);
    const BodyState at = r.stateBefore(0, 0);
    Vec3 slip = at.velocity + at.angular_velocity.cross(Vec3(0, -R, 0));
    const double un = slip.y();
    slip.y() = 0;
    const Vec3 stick = -(1 + et) * 2 / 7 * slip;
    const double limit = mu * (1 + e) * -un;
    const bool slides = stick.norm() > limit;
    EXPECT_EQ(slides, mu < 0.5);
    EXPECT_EQ(r.mode(0), slides ? ImpactMode::slide : ImpactMode::stick);
    const Vec3 expected = (slides ? Vec3(-limit * slip.normalized()) : stick) + Vec3(0, -(1 + e) * un, 0);
    for (int i = 0; i < 3; ++i) EXPECT_CLOSE(r.impulse(0)[i], expected[i], kState);
  }
}

/// Rows of a Jacobian that need no other source: the map from start to end keeps phase-space volume when e = 1 without
/// friction (in world angular velocity as in momentum, since the two differ by the same factor at both ends).
TEST(ClosedForm, ElasticMotionKeepsVolumeAndEnergy) {
  const Case& c = cases()[1];
  Scene s = c.scene();
  for (Material& m : s.materials) m.elasticity = 1;
  s.tilts.clear();  // a tilted impulse does not come from a potential
  const Body& body = s.bodies[0];
  const double T = 0.55;
  const Reference r(s, scout(s, T));
  ASSERT_GE(r.events(), 1);
  const auto energy = [&](const BodyState& b) {
    const Vec3 w = b.orientation.conjugate() * b.angular_velocity;
    return *body.mass * (b.velocity.squaredNorm() / 2 - s.gravity.dot(b.position)) +
           w.dot(body.inertia.moments.cwiseProduct(w)) / 2;
  };
  EXPECT_CLOSE(energy(r.stateAt(0, T)), energy(r.stateAt(0, 0)), kState);
  std::vector<Row> rows;
  for (int i = 0; i < 12; ++i) rows.push_back({0, -1, T, i});
  const auto determinant = [&](ImpactTimes times) {
    Eigen::Matrix<double, 12, 12> J;
    int column = 0;
    for (const char* kind : {"position[0].", "orientation[0].", "velocity[0].", "angular_velocity[0]."}) {
      for (const Knob& k : knobsOf(s)) {
        if (!k.name.starts_with(kind)) continue;
        const auto d = r.derivative(k, rows, times);
        J.col(column++) = Eigen::Map<const Eigen::Matrix<double, 12, 1>>(d.data());
      }
    }
    return std::abs(J.determinant());
  };
  EXPECT_CLOSE(determinant(ImpactTimes::follow), 1, 1e-11);
}

TEST(ClosedForm, ScaleOfMassesDoesNotMatter) {
  for (const Case& c : cases()) {
    const Scene s = c.scene();
    const int body = s.bodies[0].fixed ? 1 : 0;
    std::vector<Row> rows;
    for (int i = 0; i < 12; ++i) rows.push_back({body, -1, c.duration, i});
    const Reference r(s, scout(s, c.duration));
    std::vector<double> sum(12, 0), size(12, 1);
    for (const Knob& k : knobsOf(s)) {
      double value = 0;
      if (k.name.starts_with("mass")) value = *s.bodies[k.index].mass;
      if (k.name.starts_with("density")) value = *s.bodies[k.index].density;
      if (k.name.starts_with("inertia")) value = s.bodies[k.index].inertia.moments[k.component];
      if (value == 0) continue;
      const auto d = r.derivative(k, rows);
      for (int i = 0; i < 12; ++i) sum[i] += value * d[i], size[i] = std::max(size[i], std::abs(value * d[i]));
    }
    for (int i = 0; i < 12; ++i) EXPECT_NEAR(sum[i] / size[i], 0, 1e-14) << c.name << ", " << describe(rows[i]);
  }
}

TEST(ClosedForm, TwoBodiesKeepTheirMomentum) {
  Scene s = cases()[2].scene();
  s.gravity.setZero();
  const Reference r(s, scout(s, 0.62));
  ASSERT_GE(r.events(), 1);
  const double volume = 0.3 * 0.9 * 0.8, m[2] = {*s.bodies[0].mass, *s.bodies[1].density * volume};
  const Vec3 I[2] = {s.bodies[0].inertia.moments, m[1] / 12 * Vec3(0.81 + 0.64, 0.64 + 0.09, 0.09 + 0.81)};
  const auto momenta = [&](double t) {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (int i = 0; i < 2; ++i) {
      const BodyState b = r.stateAt(i, t);
      const Vec3 L = b.orientation * I[i].cwiseProduct(b.orientation.conjugate() * b.angular_velocity);
      sum.head<3>() += m[i] * b.velocity;
      sum.tail<3>() += L + b.position.cross(m[i] * b.velocity);
    }
    return sum;
  };
  EXPECT_NEAR((momenta(0.62) - momenta(0)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace carom::reference
