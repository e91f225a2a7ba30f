// SPDX-License-Identifier: MIT
// Kinematic bodies and gravity factors: closed forms, and what impacts with something that nothing moves keep.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "adjoint/base/errors.h"
#include "adjoint/impact/impact_pass.hpp"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

constexpr double kState = 1e-12, kDerivative = 1e-9;

Body kinematic(Body body) {
  body.kinematic = true;
  body.mass.reset();
  return body;
}

void expectNear(double found, double expected, double tolerance, const char* what) {
  EXPECT_TRUE(std::abs(found - expected) <= tolerance * std::max(1.0, std::abs(expected)))
      << what << ": " << found << ", expected " << expected;
}

// A ball of radius r falls from height h on a plate whose top rises from 0 at the speed V:
// h - r - g tau^2/2 = V tau, v+ = V + e (g tau + V).
struct Rising {
  double h = 1.3, r = 0.1, g = 9.8, V = 0.7, e = 0.6, T = 0.6;
  double tau() const { return (-V + std::sqrt(V * V + 2 * g * (h - r))) / g; }
  double after() const { return V + e * (g * tau() + V); }
  double heightAtEnd() const {
    const double s = T - tau();
    return r + V * tau() + s * after() - 0.5 * g * s * s;
  }
  Scene scene(bool plate_first) const {
    const Body ball = makeBall("ball", r, {0.1, 0.2, h});
    const Body plate = kinematic(makeBox("plate", {2, 2, 0.2}, {0, 0, -0.1}, {0, 0, V}));
    Scene s = makeScene({0, 0, -g}, e, 0, plate_first ? std::vector{plate, ball} : std::vector{ball, plate});
    return s;
  }
};

TEST(Kinematic, RisingPlate) {
  const Rising c;
  for (const bool plate_first : {false, true}) {
    const Scene scene = c.scene(plate_first);
    const int ball = bodyIndex(scene, "ball"), plate = bodyIndex(scene, "plate");
    const Motion m = play(scene, c.T);
    ASSERT_EQ(m.events.size(), 1u);
    expectNear(m.events[0].time, c.tau(), kState, "time");
    expectNear(m.stateAt(ball, c.T).position.z(), c.heightAtEnd(), kState, "height");
    expectNear(m.stateAt(ball, c.T).velocity.z(), c.after() - c.g * (c.T - c.tau()), kState, "velocity");
    expectNear(m.stateAt(plate, c.T).position.z(), -0.1 + c.V * c.T, kState, "plate");
    EXPECT_EQ(m.stateAt(plate, c.T).velocity, Vec3(0, 0, c.V));
    EXPECT_TRUE(m.stateAt(plate, c.T).angular_velocity.isZero(0));

    const SceneGradient d = gradientOf(m, ball, c.T, 2);
    const double tau = c.tau(), s = c.T - tau, closing = c.g * tau + c.V;
    const double by_tau = c.V - c.after() + s * c.e * c.g + c.g * s;  // dz(T)/dtau, V held
    const double tau_h = 1 / closing, tau_V = -tau / closing, tau_g = -0.5 * tau * tau / closing;
    const auto of = [](int body, const SceneGradient& g) { return g.bodies[static_cast<std::size_t>(body)]; };
    expectNear(of(ball, d).position.z(), by_tau * tau_h, kDerivative, "by the ball's height");
    expectNear(of(plate, d).position.z(), 1 - by_tau * tau_h, kDerivative, "by the plate's height");
    expectNear(of(plate, d).velocity.z(), tau + s * (1 + c.e) + by_tau * tau_V, kDerivative, "by the plate's velocity");
    expectNear(-d.gravity.z(), s * c.e * tau - 0.5 * s * s + by_tau * tau_g, kDerivative, "by gravity");
    expectNear(d.materials[0].elasticity, s * closing, kDerivative, "by e");
    EXPECT_EQ(of(plate, d).mass, 0);
    EXPECT_TRUE(of(plate, d).inertia.isZero(0));
  }
}

// A kinematic body goes its way to the last digit but rounding, however often it is struck.
TEST(Kinematic, KeepsItsMotion) {
  Body paddle = kinematic(makeBox("paddle", {0.8, 0.8, 0.1}, {0, 0, 0}, {0.1, 0.05, 0.02}));
  paddle.angular_velocity = {0.2, -0.1, 0.4};
  paddle.orientation = Quat(0.9, 0.1, -0.2, 0.3).normalized();
  Scene scene = makeScene({0, 0, -9.81}, 0.8, 0.3, {paddle});
  for (int i = 0; i < 5; ++i)
    scene.bodies.push_back(makeBall("ball" + std::to_string(i), 0.05, {0.15 * i - 0.3, 0.1, 0.5 + 0.1 * i}));
  const Motion m = play(scene, 1.2);
  ASSERT_GT(m.world_lines[0].events.size(), 3u);
  const BodyState end = m.stateAt(0, m.end);
  EXPECT_TRUE((end.position - m.end * paddle.velocity).norm() <= 1e-13);
  const Quat turned = Quat(Eigen::AngleAxisd(m.end * paddle.angular_velocity.norm(), paddle.angular_velocity.normalized()));
  EXPECT_TRUE((end.orientation.toRotationMatrix() - (turned * paddle.orientation).toRotationMatrix()).norm() <= 1e-12);
  EXPECT_EQ(end.velocity, paddle.velocity);
  EXPECT_TRUE((end.angular_velocity - paddle.angular_velocity).norm() <= 1e-15);
}

TEST(Kinematic, DifferentiatingChangesNothing) {
  const Scene scene = Rising().scene(false);
  const Motion m = play(scene, 0.6);
  const auto before = flatten(m.stateAt(0, m.end));
  const std::string signature = m.signature();
  (void)gradientOf(m, 0, m.end, 2);
  (void)gradientOf(m, 1, m.end, 0);
  EXPECT_EQ(m.signature(), signature);
  const auto after = flatten(m.stateAt(0, m.end)), again = flatten(play(scene, 0.6).stateAt(0, 0.6));
  EXPECT_EQ(std::memcmp(before.data(), after.data(), sizeof before), 0);
  EXPECT_EQ(std::memcmp(before.data(), again.data(), sizeof before), 0);
}

TEST(Kinematic, TwoThatNothingMovesNeverCollide) {
  Scene scene = makeScene({0, 0, -9.81}, 0.5, 0.5,
                          {kinematic(makeBox("a", {1, 1, 1}, {0, 0, 2}, {0, 0, -1})),
                           kinematic(makeBox("b", {1, 1, 1}, {0, 0, 1.5})), makePlane("floor", Vec3::UnitZ(), 0)});
  const Motion m = play(scene, 3);
  EXPECT_TRUE(m.events.empty());
  EXPECT_TRUE(m.overlaps.empty());
  EXPECT_EQ(m.status, MotionStatus::complete);
}

TEST(Kinematic, IsNotFixedAtOnce) {
  Scene scene = makeScene(Vec3::Zero(), 0.5, 0.5, {kinematic(makeBall("a", 0.1, Vec3::Zero()))});
  scene.bodies[0].fixed = true;
  EXPECT_THROW(validate(scene), InputError);
}

TEST(GravityFactor, ScalesGravity) {
  const double T = 0.8, factor = -0.35;
  Scene scene = makeScene({0.4, -0.2, -9.81}, 0.5, 0, {makeBall("balloon", 0.1, {1, 2, 3}, {0.5, 0, 1})});
  scene.bodies[0].gravity_factor = factor;
  const Motion m = play(scene, T);
  const Vec3 expected = scene.bodies[0].position + T * scene.bodies[0].velocity + 0.5 * T * T * factor * scene.gravity;
  EXPECT_TRUE((m.stateAt(0, T).position - expected).norm() <= 1e-14);
  for (int i = 0; i < 3; ++i) {
    expectNear(gradientOf(m, 0, T, i).gravity[i], 0.5 * T * T * factor, 1e-14, "d(position)/d(gravity)");
    expectNear(gradientOf(m, 0, T, 6 + i).gravity[i], T * factor, 1e-14, "d(velocity)/d(gravity)");
  }
}

// One body that strikes several others that nothing moves and that move each in its own way. Their normals point upwards,
// so the body can part from all of them: after the impact none approaches more slowly than its e says.
TEST(Kinematic, JointImpactsPartEveryContact) {
  int wedged = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = 2 + random.below(5);
    const Mat3 R = random.rotation().toRotationMatrix();
    const double heavy = std::exp(random.in(-2, 2)), lever = random.in(0.05, 0.4);
    const Mat3 A = R * Vec3(random.in(1, 2), random.in(1, 2), random.in(1, 2)).asDiagonal() * R.transpose() / (heavy * lever * lever);
    const Vec3 v(random.in(-1, 1), random.in(-1, 1), -random.in(0, 2)), w = random.vec(2);
    ImpactProblem p;
    p.driven = true;
    p.u.resize(3 * n);
    p.K.resize(3 * n, 3 * n);
    const bool flat = seed % 2 == 0;  // corners of a face: redundant
    std::vector<Vec3> arms;
    for (int k = 0; k < n; ++k) {
      const double side = lever * (k % 2 ? 1 : -1), other = lever * ((k / 2) % 2 ? 1 : -1);
      arms.push_back(flat ? Vec3(side, other, -lever) : random.vec(lever));
      p.normal.push_back(flat ? Vec3(0, 0, 1) : Vec3(random.in(-1, 1), random.in(-1, 1), random.in(0.2, 1)).normalized());
      p.pair.push_back({random.in(0, 1), seed % 3 ? random.in(0, 1) : 0, random.in(-1, 1)});
      Vec3 u = v + w.cross(arms.back()) - random.vec(1);
      const double closing = p.normal.back().dot(u);
      if (closing > 0) u -= (closing + random.in(0, 1)) * p.normal.back();  // its surface comes towards the body
      p.u.segment<3>(3 * k) = u;
    }
    for (int k = 0; k < n; ++k)
      for (int l = 0; l < n; ++l)
        p.K.block<3, 3>(3 * k, 3 * l) =
            Mat3::Identity() / heavy - skew(arms[static_cast<std::size_t>(k)]) * A * skew(arms[static_cast<std::size_t>(l)]);
    ImpactSolution solution;
    try {
      solution = solveLaw(p);
    } catch (const NotComputable& error) {  // normals that oppose each other across the body, and friction
      EXPECT_NE(std::string(error.what()).find("wedges what it strikes"), std::string::npos) << error.what();
      ++wedged;
      continue;
    }
    const Eigen::VectorXd after = p.u + p.K * solution.P;
    for (int k = 0; k < n; ++k) {
      const auto kk = static_cast<std::size_t>(k);
      const double was = p.normal[kk].dot(p.u.segment<3>(3 * k)), is = p.normal[kk].dot(after.segment<3>(3 * k));
      EXPECT_TRUE(is >= -p.pair[kk].elasticity * was - 1e-8 * (1 + p.u.norm())) << k << ": " << was << " -> " << is;
      EXPECT_TRUE(p.normal[kk].dot(solution.P.segment<3>(3 * k)) >= -1e-9 * (1 + solution.P.norm())) << k;
    }
  }
  std::printf("%d of 4000 wedged\n", wedged);
  EXPECT_LT(wedged, 400);
}

TEST(Kinematic, WhatIsSqueezedIsNotComputable) {
  ImpactProblem p;  // a ball between two jaws that close
  p.driven = true;
  p.u = Eigen::VectorXd::Zero(6);
  p.u[2] = -1, p.u[5] = 1;
  p.normal = {Vec3::UnitZ(), -Vec3::UnitZ()};
  p.pair = {{0.5, 0, 0}, {0.5, 0, 0}};
  p.K.resize(6, 6);
  p.K << Mat3::Identity(), Mat3::Identity(), Mat3::Identity(), Mat3::Identity();
  EXPECT_THROW(solveLaw(p), NotComputable);
}

}  // namespace
}  // namespace carom
