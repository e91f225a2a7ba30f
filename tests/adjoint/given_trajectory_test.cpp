// SPDX-License-Identifier: MIT
// A trajectory that the library does not know: a body on an accelerating spline, which strikes others. It is simulated,
// differentiated and replayed by what Trajectory asks of it alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/flight/trajectory.hpp"
#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/simulate/simulate.h"
#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace adjoint_detail;
using test::Random;

/// Heights of the bodies of a lift at equal intervals, joined by a cubic spline whose acceleration is continuous: one
/// spline for several bodies, each at its slot's place beside it.
class Spline final : public Trajectory {
 public:
  Spline(std::vector<double> heights, double step, std::vector<Vec3> places)
      : z_(std::move(heights)), m_(z_.size(), 0.0), h_(step), places_(std::move(places)) {
    // second derivatives, 0 at both ends
    const std::size_t n = z_.size();
    std::vector<double> c(n, 0.0), d(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double w = 4 - c[i - 1];
      c[i] = 1 / w;
      d[i] = (6 * (z_[i + 1] - 2 * z_[i] + z_[i - 1]) / (h_ * h_) - d[i - 1]) / w;
    }
    for (std::size_t i = n - 1; i-- > 1;) m_[i] = d[i] - c[i] * m_[i + 1];
  }

  struct At {
    double z, v, a;
  };
  At at(double t) const {
    const auto last = static_cast<double>(z_.size() - 2);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(t / h_), 0.0, last));
    const double s = t - static_cast<double>(i) * h_, slope = (z_[i + 1] - z_[i]) / h_ - h_ / 6 * (2 * m_[i] + m_[i + 1]);
    const double jerk = (m_[i + 1] - m_[i]) / h_;
    return {z_[i] + s * (slope + s * (m_[i] / 2 + s * jerk / 6)), slope + s * (m_[i] + s * jerk / 2), m_[i] + s * jerk};
  }

  ArcKind kind() const override { return ArcKind::flight; }
  bool isGiven() const override { return true; }
  Vec3 positionAt(const Arc& arc, double t) const override { return place(arc) + at(t).z * Vec3::UnitZ(); }
  Vec3 velocityAt(const Arc&, double t) const override { return at(t).v * Vec3::UnitZ(); }
  State stateAt(const Arc& arc, double t) const override {
    return {positionAt(arc, t), Quat::Identity(), velocityAt(arc, t), Vec3::Zero()};
  }
  StateDerivative rateAt(const Arc&, double t, const State&) const override {
    StateDerivative rate;
    rate.x = at(t).v * Vec3::UnitZ(), rate.v = at(t).a * Vec3::UnitZ();
    return rate;
  }
  TrajectoryBounds bounds(const Arc& arc) const override {
    const double here = at(arc.start()).a;
    double variation = 0;
    for (const double a : m_) variation = std::max(variation, std::abs(a - here));
    return {here * Vec3::UnitZ(), variation, false, 0, 0};
  }
  std::shared_ptr<const TrajectoryLinearization> linearise(const Motion&, int, int, double) const override {
    return std::make_shared<Nothing>();
  }

 private:
  // Nothing that varies moves it.
  class Nothing final : public TrajectoryLinearization {
    StateDerivative tangent(const StateDerivative&, const SceneTangent&, const BodyModelDerivative&) const override { return {}; }
    StateDerivative pullback(const StateDerivative&, SceneGradient&, BodyModelDerivative&) const override { return {}; }
  };
  Vec3 place(const Arc& arc) const { return places_[static_cast<std::size_t>(arc.slot())]; }

  std::vector<double> z_, m_;
  double h_;
  std::vector<Vec3> places_;
};

struct Lift {
  std::shared_ptr<Spline> spline;
  Scene scene;
  double height, elasticity, duration = 2;
};

constexpr double kThickness = 0.1, kBallRadius = 0.1, kGravity = 9.81;

// A ball that bounces on a table whose height is the spline's.
Lift randomLift(unsigned seed, bool reversed) {
  Random random(seed);
  std::vector<double> heights;
  for (int i = 0; i < 11; ++i) heights.push_back(random.in(-0.03, 0.03));
  Lift lift;
  lift.scene.gravity = {0, 0, -kGravity};
  lift.spline = std::make_shared<Spline>(heights, 0.2, std::vector<Vec3>{Vec3::Zero()});
  lift.height = random.in(0.6, 1.2), lift.elasticity = random.in(0.8, 0.95);
  Body table{.name = "table", .kinematic = true, .shape = Box{Vec3(2, 2, kThickness)}};
  Body ball{.name = "ball", .shape = Sphere{kBallRadius}, .mass = 1.0};
  ball.position = Vec3(0, 0, lift.height);
  for (Body* body : {&table, &ball}) body->material = "rubber";
  lift.scene.materials = {{.name = "rubber", .elasticity = lift.elasticity, .friction = 0}};
  lift.scene.bodies = reversed ? std::vector<Body>{ball, table} : std::vector<Body>{table, ball};
  return lift;
}

Motion played(const Lift& lift) {
  OdeContacts contacts(lift.scene);
  SimulateOptions options;
  options.given[bodyIndex(lift.scene, "table")] = lift.spline;
  return simulate(lift.scene, contacts, lift.duration, options);
}

// The height of the ball at the end, and its derivative by the height of the start and by the elasticity, in long
// double: from each bounce to the next by bisection after small steps.
struct Bounced {
  long double z, by_height, by_elasticity;
  std::vector<double> times;
};
Bounced bounced(const Lift& lift) {
  using Real = long double;
  const Real g = kGravity, e = lift.elasticity;
  Real t0 = 0, z0 = lift.height, v0 = 0;
  std::array<Real, 2> dz{1, 0}, dv{0, 0};  // at the start of a flight, at its fixed time
  Bounced out{};
  const auto gap = [&](Real t) {
    const Real s = t - t0;
    return z0 + s * (v0 - g * s / 2) - kBallRadius - kThickness / 2 - Real(lift.spline->at(static_cast<double>(t)).z);
  };
  for (;;) {
    Real low = t0 + 1e-9L, high = low;
    while (high < lift.duration && gap(high) > 0) low = high, high += 1e-4L;
    if (!(high < lift.duration)) break;
    for (int i = 0; i < 200; ++i) (gap((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    const Real s = low - t0, before = v0 - g * s;
    const Spline::At table = lift.spline->at(static_cast<double>(low));
    out.times.push_back(static_cast<double>(low));
    const Real after = Real(table.v) - e * (before - Real(table.v));
    for (int k = 0; k < 2; ++k) {
      const Real z = dz[k] + s * dv[k], dt = -z / (before - Real(table.v));
      const Real rate_after = (1 + e) * Real(table.a) + e * g;  // d(after)/dt of the instant
      dv[k] = -e * dv[k] + (rate_after + g) * dt + (k == 1 ? -(before - Real(table.v)) : 0);
      dz[k] = z + (before - after) * dt;
    }
    z0 += s * (v0 - g * s / 2), v0 = after, t0 = low;
  }
  const Real s = lift.duration - t0;
  out.z = z0 + s * (v0 - g * s / 2), out.by_height = dz[0] + s * dv[0], out.by_elasticity = dz[1] + s * dv[1];
  return out;
}

TEST(GivenTrajectory, ABallBouncesOnASplineAsByBisection) {
  int bounces = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Lift lift = randomLift(seed, seed % 2 == 0);
    const Motion motion = played(lift);
    ASSERT_EQ(motion.status, MotionStatus::complete) << "seed " << seed << ": " << motion.message;
    const Bounced want = bounced(lift);
    ASSERT_EQ(motion.events.size(), want.times.size()) << "seed " << seed;
    double steepest = 1;
    for (std::size_t k = 0; k < want.times.size(); ++k, ++bounces) {
      steepest = std::max(steepest, 1 / std::abs(motion.events[k].contacts[0].approach));
      EXPECT_TRUE(std::abs(motion.events[k].time - want.times[k]) <= 1e-12 * steepest) << "seed " << seed << ", bounce " << k;
    }
    const double z = motion.stateAt("ball", lift.duration).position.z();
    EXPECT_TRUE(std::abs(z - static_cast<double>(want.z)) <= 1e-11 * steepest) << "seed " << seed;
    const BodyState table = motion.stateAt("table", 0.77);
    EXPECT_TRUE(std::abs(table.position.z() - lift.spline->at(0.77).z) <= 1e-15) << "seed " << seed;
  }
  EXPECT_GT(bounces, 100);
}

TEST(GivenTrajectory, DerivativesGoThroughItsImpacts) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Lift lift = randomLift(seed, seed % 2 == 0);
    const Motion motion = played(lift);
    const int ball = bodyIndex(lift.scene, "ball");
    StateSeed seed_z;
    seed_z.body = ball, seed_z.at = Instant::at(lift.duration), seed_z.position = Vec3::UnitZ();
    DerivativeTape tape(motion);
    const SceneGradient gradient = adjoint(tape, std::vector<StateSeed>{seed_z});
    const Bounced want = bounced(lift);
    const double by_height = gradient.bodies[static_cast<std::size_t>(ball)].position.z();
    const double by_elasticity = gradient.materials[0].elasticity;
    const auto close = [](double got, long double right) {
      return std::abs(got - static_cast<double>(right)) <= 1e-9 * std::max(1.0, std::abs(static_cast<double>(right)));
    };
    EXPECT_TRUE(close(by_height, want.by_height)) << "seed " << seed << ": " << by_height;
    EXPECT_TRUE(close(by_elasticity, want.by_elasticity)) << "seed " << seed << ": " << by_elasticity;
    SceneTangent direction(lift.scene);
    direction.bodies[static_cast<std::size_t>(ball)].position.z() = 0.7;
    direction.materials[0].elasticity = -0.3;
    const double along = tangent(tape, direction).at(ball, seed_z.at).position.z(), by = 0.7 * by_height - 0.3 * by_elasticity;
    EXPECT_TRUE(std::abs(along - by) <= 1e-13 * (0.7 * std::abs(by_height) + 0.3 * std::abs(by_elasticity))) << "seed " << seed;
    EXPECT_EQ(motion.signature(), played(lift).signature());
  }
}

TEST(GivenTrajectory, IsReplayed) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Lift lift = randomLift(seed, false);
    const Motion motion = played(lift);
    lift.scene.bodies[1].position.z() += 1e-7;
    const MotionAlong along = simulateAlong(motion, lift.scene, motion.geometry, lift.duration);
    ASSERT_TRUE(along.complete) << "seed " << seed << ": " << along.why_not;
    const double replayed = along.motion.stateAt("ball", lift.duration).position.z();
    const double again = played(lift).stateAt("ball", lift.duration).position.z();
    EXPECT_TRUE(std::abs(replayed - again) <= 1e-11) << "seed " << seed;
  }
}

TEST(GivenTrajectory, OfABodyThatIsNotKinematicIsRefused) {
  const Lift lift = randomLift(1, false);
  OdeContacts contacts(lift.scene);
  SimulateOptions options;
  options.given[bodyIndex(lift.scene, "ball")] = lift.spline;
  EXPECT_THROW(simulate(lift.scene, contacts, lift.duration, options), InputError);
}

// Two platforms of one spline, a ball on each: the arcs of both share it.
TEST(GivenTrajectory, MovesSeveralBodies) {
  const Lift one = randomLift(3, false);
  Scene scene = one.scene;
  const Motion alone = played(one);
  for (Body body : one.scene.bodies) {
    body.name += " 2", body.position.x() += 5;
    scene.bodies.push_back(body);
  }
  OdeContacts contacts(scene);
  SimulateOptions options;
  const auto beside = std::make_shared<Spline>(*one.spline);
  options.given[bodyIndex(scene, "table")] = one.spline;
  options.given[bodyIndex(scene, "table 2")] = beside;
  const Motion both = simulate(scene, contacts, one.duration, options);
  ASSERT_EQ(both.status, MotionStatus::complete) << both.message;
  EXPECT_EQ(both.stateAt("ball", 2).position.z(), alone.stateAt("ball", 2).position.z());
}

}  // namespace
}  // namespace carom
