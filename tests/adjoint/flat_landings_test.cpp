// SPDX-License-Identifier: MIT
// Derivatives through the landings of a rim that comes to lie flat, and through the settling that ends them. A cup that rocks
// in a plane has a closed law: a pendulum about the point of its rim that is down, and at each landing a share of its rate that is
// kept. It is integrated here in extended precision, and differentiated by differences in it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "adjoint/derivative/adjoint.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::flat_landings {
namespace {

using namespace test;
using Real = long double;

constexpr double kBase = 0.1;  // of the cup's origin above its base, m

// What the motion in the plane depends on.
struct Cup {
  Real tilt, radius, height, mass, inertia, gravity, rate;
  bool sticks;
};
constexpr Cup kCup = {0.17L, 0.032L, 0.045L, 0.2L, 0.0006L, 9.81L, 0.3L, true};

struct Swing {
  Real tilt, rate;
};

// I(tilt) tilt'' = -m g h' - (I'/2) tilt'^2: about the point of the rim, which either stays or goes along without friction.
Real accelerationOf(const Cup& c, const Swing& s) {
  const Real slope = -c.height * std::sin(s.tilt) + c.radius * std::cos(s.tilt);       // h'
  const Real bend = -c.height * std::cos(s.tilt) - c.radius * std::sin(s.tilt);        // h''
  if (c.sticks) return -c.mass * c.gravity * slope / (c.inertia + c.mass * (c.height * c.height + c.radius * c.radius));
  return -c.mass * slope * (c.gravity + bend * s.rate * s.rate) / (c.inertia + c.mass * slope * slope);
}

Swing stepped(const Cup& c, const Swing& s, Real h) {
  const auto slope = [&](const Swing& at) { return Swing{at.rate, accelerationOf(c, at)}; };
  const auto plus = [](const Swing& a, const Swing& b, Real by) { return Swing{a.tilt + by * b.tilt, a.rate + by * b.rate}; };
  const Swing k1 = slope(s), k2 = slope(plus(s, k1, h / 2)), k3 = slope(plus(s, k2, h / 2)), k4 = slope(plus(s, k3, h));
  return {s.tilt + h / 6 * (k1.tilt + 2 * k2.tilt + 2 * k3.tilt + k4.tilt), s.rate + h / 6 * (k1.rate + 2 * k2.rate + 2 * k3.rate + k4.rate)};
}

// Richardson's rule on 160 and 80 steps of Runge and Kutta.
Swing after(const Cup& c, const Swing& from, Real time) {
  std::array<Swing, 2> ends;
  for (const int halves : {0, 1}) {
    const int steps = halves ? 160 : 80;
    Swing s = from;
    for (int i = 0; i < steps; ++i) s = stepped(c, s, time / steps);
    ends[static_cast<std::size_t>(halves)] = s;
  }
  return {(16 * ends[1].tilt - ends[0].tilt) / 15, (16 * ends[1].rate - ends[0].rate) / 15};
}

// Tilts are positive; the sign of the turn is that of the side on which the cup stands.
struct Reading {
  Real turn, rate;  // about the axis of the first tilt
};
Reading readAt(const Cup& c, Real time) {
  const Real arms = c.mass * c.radius * c.radius, own = c.inertia + (c.sticks ? c.mass * c.height * c.height : 0);
  Swing s{c.tilt, c.rate};
  for (Real side = 1;; side = -side) {
    Real lands = std::sqrt(2 * s.tilt * (own + arms) / (c.mass * c.gravity * c.radius)) + 2 * std::max(Real(0), s.rate) * (own + arms) / (c.mass * c.gravity * c.radius);
    for (int i = 0; i < 20; ++i) {
      const Swing there = after(c, s, lands);
      const Real move = -there.tilt / there.rate;
      lands += move;
      if (std::abs(move) < 1e-17L * lands) break;
    }
    if (lands >= time) {
      const Swing end = after(c, s, time);
      return {side * end.tilt, side * end.rate};
    }
    const Real rate = after(c, s, lands).rate;
    s = {0, -rate * (own - arms) / (own + arms)};
    time -= lands;
  }
}

Scene sceneOf(const Cup& c, double heading, double about_axis, bool floor_first) {
  const auto radius = static_cast<double>(c.radius), tilt = static_cast<double>(c.tilt), height = static_cast<double>(c.height);
  Body body = makeBall("cup", 1, Vec3::Zero());
  body.shape = Cylinder{radius, 2 * kBase};
  body.mass = static_cast<double>(c.mass);
  body.center_of_mass = Vec3(0, 0, height - kBase);
  const auto inertia = static_cast<double>(c.inertia);
  body.inertia = Inertia::fromMoments({inertia, inertia, 0.00012});
  const Eigen::AngleAxisd turned(heading, Vec3::UnitZ()), tilted(tilt, Vec3::UnitX());
  body.orientation = turned * tilted * Eigen::AngleAxisd(about_axis, Vec3::UnitZ());
  body.position.z() = kBase * std::cos(tilt) + radius * std::sin(tilt);
  const auto rate = static_cast<double>(c.rate);
  // about the point that is down, or of that which goes along beneath the centre of mass
  const Vec3 arm = tilted * Vec3(0, radius, height), moves = rate * Vec3::UnitX().cross(arm);
  body.velocity = turned * (c.sticks ? moves : Vec3(0, 0, moves.z()));
  body.angular_velocity = turned * Vec3(rate, 0, 0);
  const Body floor = makePlane("floor", Vec3::UnitZ(), 0);
  const Vec3 gravity(0, 0, -static_cast<double>(c.gravity));
  return floor_first ? makeScene(gravity, 0, c.sticks ? 2 : 0, {floor, body}) : makeScene(gravity, 0, c.sticks ? 2 : 0, {body, floor});
}

// The scene by one number of the cup: what sceneOf makes of it.
struct Control {
  const char* name;
  Real Cup::* number;
};
constexpr Control kControls[] = {{"tilt", &Cup::tilt}, {"radius", &Cup::radius}, {"mass", &Cup::mass},
                                 {"inertia", &Cup::inertia}, {"gravity", &Cup::gravity}, {"rate", &Cup::rate}};

SceneTangent directionOf(const Scene& scene, const Cup& c, const Control& control, double heading, bool floor_first) {
  SceneTangent d(scene);
  BodyDerivative& body = d.bodies[floor_first ? 1 : 0];
  const Eigen::AngleAxisd turned(heading, Vec3::UnitZ()), tilted(static_cast<double>(c.tilt), Vec3::UnitX());
  const auto radius = static_cast<double>(c.radius), tilt = static_cast<double>(c.tilt), rate = static_cast<double>(c.rate);
  const Vec3 x = Vec3::UnitX(), arm = tilted * Vec3(0, radius, static_cast<double>(c.height));
  Vec3 velocity = Vec3::Zero();
  if (control.number == &Cup::tilt) {
    body.orientation = turned * x;
    body.position.z() = -kBase * std::sin(tilt) + radius * std::cos(tilt);
    velocity = rate * x.cross(x.cross(arm));
  } else if (control.number == &Cup::radius) {
    body.size = Vec2(1, 0);
    body.position.z() = std::sin(tilt);
    velocity = rate * x.cross(Vec3(tilted * Vec3::UnitY()));
  } else if (control.number == &Cup::rate) {
    body.angular_velocity = turned * x;
    velocity = x.cross(arm);
  } else if (control.number == &Cup::mass) {
    body.mass = 1;
  } else if (control.number == &Cup::inertia) {
    body.inertia = Vec3(1, 1, 0);
  } else {
    d.gravity = Vec3(0, 0, -1);
  }
  body.velocity = turned * (c.sticks ? velocity : Vec3(0, 0, velocity.z()));
  return d;
}

// Differences of order 8.
template <class F>
double rateBy(const F& of, const Cup& c, Real Cup::* number) {
  constexpr std::array<Real, 4> weights = {4 / 5.0L, -1 / 5.0L, 4 / 105.0L, -1 / 280.0L};
  const Real h = 1e-4L * std::abs(c.*number);
  Real sum = 0;
  for (int k = 1; k <= 4; ++k)
    for (const int sign : {1, -1}) {
      Cup there = c;
      there.*number += sign * k * h;
      sum += sign * weights[static_cast<std::size_t>(k - 1)] * of(there);
    }
  return static_cast<double>(sum / h);
}

// Turned by 0 about its axis a mark of the rim comes down itself.
TEST(FlatLandings, OfACupHaveTheDerivativesOfItsSwings) {
  for (const bool sticks : {true, false}) {
    Cup c = kCup;
    c.sticks = sticks;
    for (const bool floor_first : {false, true}) {
      const double heading = floor_first ? 0.4 : 0, about_axis = floor_first ? 0.3 : 0;
      SCOPED_TRACE(std::string(sticks ? "sticks" : "slides") + (floor_first ? ", heading 0.4" : ""));
      const double duration = sticks ? 0.4 : 0.24;
      const Motion m = playLasting(sceneOf(c, heading, about_axis, floor_first), duration);
      ASSERT_GE(m.end, 0.8 * duration) << m.message;
      const int body = floor_first ? 1 : 0;
      const Vec3 axis(std::cos(heading), std::sin(heading), 0);
      DerivativeTape tape(m);
      for (const double share : {0.3, 0.8}) {
        const double t = share * duration;
        const Reading here = readAt(c, t);
        EXPECT_NEAR(m.stateAt(body, t).angular_velocity.dot(axis), static_cast<double>(here.rate), 1e-11);
        for (const Control& control : kControls) {
          SCOPED_TRACE(std::string(control.name) + " at " + std::to_string(t));
          const MotionTangent found = tangent(tape, directionOf(*m.scene, c, control, heading, floor_first));
          const BodyStateRate r = found.at(body, Instant::at(t));
          const double turn = rateBy([&](const Cup& there) { return readAt(there, t).turn; }, c, control.number);
          const double rate = rateBy([&](const Cup& there) { return readAt(there, t).rate; }, c, control.number);
          const double scale = std::max(std::abs(turn), 1e-2 * std::abs(rate));
          expectEntries(r.orientation, Vec3(turn * axis), 1e-9 * scale, "turn");
          expectEntries(r.angular_velocity, Vec3(rate * axis), 1e-9 * std::max(100 * scale, std::abs(rate)), "rate");
        }
      }
    }
  }
}

// Without friction the centre of mass comes straight down.
TEST(FlatLandings, OfACupThatComesToRestAreThoseOfWhereItStands) {
  Cup c = kCup;
  c.sticks = false, c.rate = 0;
  for (const bool floor_first : {false, true}) {
    const double heading = floor_first ? 0.4 : 0;
    const Scene scene = sceneOf(c, heading, 0.3, floor_first);
    OdeContacts contacts(scene);
    SimulateOptions options;
    options.lowest_bounce = 1e-9;  // of less, more of these end in rounding
    const Motion m = simulate(scene, contacts, 1, options);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const int body = floor_first ? 1 : 0;
    const Vec3 across(-std::sin(heading), std::cos(heading), 0);
    const double arm = kBase - static_cast<double>(c.height), tilt = static_cast<double>(c.tilt);
    expectEntries(m.stateAt(body, 1).position, Vec3(arm * std::sin(tilt) * across + kBase * Vec3::UnitZ()), 1e-9, "place");
    DerivativeTape tape(m);
    for (const Control& control : kControls) {
      SCOPED_TRACE(control.name);
      const BodyStateRate r = tangent(tape, directionOf(scene, c, control, heading, floor_first)).at(body, Instant::at(1));
      const double moves = control.number == &Cup::tilt ? arm * std::cos(tilt) : 0;
      expectEntries(r.position, Vec3(moves * across), 1e-9, "place");
      expectEntries(r.orientation, Vec3(Vec3::Zero()), 1e-9, "orientation");
      EXPECT_EQ(r.velocity, Vec3::Zero());
      EXPECT_EQ(r.angular_velocity, Vec3::Zero());
    }
  }
}

TEST(FlatLandings, TangentAndAdjointAreTransposed) {
  for (const bool sticks : {true, false})
    for (const bool floor_first : {false, true})
      for (const double about_axis : {0.0, 0.3}) {
        SCOPED_TRACE(std::string(sticks ? "sticks" : "slides") + ", turned by " + std::to_string(about_axis));
        Cup c = kCup;
        c.sticks = sticks;
        // a few landings: what has none of its own directions grows by the inverse of the rate that is kept at each
        const Motion m = playLasting(sceneOf(c, 0.4, about_axis, floor_first), sticks ? 0.3 : 0.15);
        for (std::uint64_t seed = 1; seed <= 2; ++seed) expectTransposed(m, seed);
      }
}

// Motions beside one that lands flat go round: there is a derivative along those alone that land flat as well.
TEST(FlatLandings, SayThatTheyHoldForMotionsThatLandFlat) {
  const Motion m = playLasting(sceneOf(kCup, 0, 0, false), 0.3);
  StateSeed seed;
  seed.body = 0, seed.at = Instant::at(0.3), seed.position = Vec3::UnitX();
  Reliability reliability;
  adjoint(m, std::span<const StateSeed>(&seed, 1), &reliability);
  EXPECT_FALSE(reliability.reliable);
  EXPECT_NE(reliability.message.find("lie flat"), std::string::npos) << reliability.message;
}

}  // namespace
}  // namespace carom::flat_landings
