// SPDX-License-Identifier: MIT
// A ball that glides off a round table without friction, against closed forms: with u = p - c + v t the time t at which
// |u| is the radius of the table, and the height g (T - t)^2 / 2 that the ball has fallen at T; their first and second
// derivatives by those of F(t, q) = u.u - R^2 = 0.

#include <gtest/gtest.h>

#include "adjoint/second_order/second_order.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom::round_border {
namespace {

using namespace test;

constexpr double kPull = 9.81, kRadius = 1.0, kEnd = 0.8;
const Vec3 kStart(-0.2, 0.15, 0.1), kSpeed(2, 0.3, 0), kTable(0.1, 0.05, -0.25);

/// A direction in the space of starts, speeds, places and radii of the table.
struct Change {
  Vec3 start = Vec3::Zero(), speed = Vec3::Zero(), table = Vec3::Zero();
  double radius = 0;
};

Scene roundTable(bool ball_first) {
  Body table = fixedBody(makeBox("table", {1, 1, 1}, kTable));
  table.shape = Cylinder{kRadius, 0.5};
  Body ball = makeBall("ball", 0.1, kStart, kSpeed);
  ball.angular_velocity = {1, 2, 3};
  return ball_first ? makeScene({0, 0, -kPull}, 0, 0, {ball, table}) : makeScene({0, 0, -kPull}, 0, 0, {table, ball});
}

class Closed {
 public:
  Closed() {
    const Vec3 d = inPlane(kStart - kTable);
    const double a = kSpeed.squaredNorm(), b = d.dot(kSpeed), c = d.squaredNorm() - kRadius * kRadius;
    t = (-b + std::sqrt(b * b - a * c)) / a;
    u = d + t * kSpeed;
    by_time = 2 * u.dot(kSpeed);
  }
  double time(const Change& q) const { return -(2 * u.dot(moved(q)) - 2 * kRadius * q.radius) / by_time; }
  double time(const Change& p, const Change& q) const {
    const double fixed = 2 * moved(p).dot(moved(q)) - 2 * p.radius * q.radius;
    const double with_time = rateBy(p) * time(q) + rateBy(q) * time(p) + 2 * kSpeed.squaredNorm() * time(p) * time(q);
    return -(fixed + with_time) / by_time;
  }
  double height(const Change& q) const { return kPull * (kEnd - t) * time(q) + own(q); }
  double height(const Change& p, const Change& q) const {
    return kPull * ((kEnd - t) * time(p, q) - time(p) * time(q));
  }

  double t = 0;

 private:
  static Vec3 inPlane(const Vec3& d) { return {d.x(), d.y(), 0}; }
  // The table's own height carries the ball; where the ball was written above it does not.
  static double own(const Change& q) { return q.table.z(); }
  Vec3 moved(const Change& q) const { return inPlane(q.start - q.table) + t * inPlane(q.speed); }
  double rateBy(const Change& q) const { return 2 * moved(q).dot(kSpeed) + 2 * u.dot(inPlane(q.speed)); }

  Vec3 u;
  double by_time = 0;
};

std::vector<Change> changes() {
  std::vector<Change> all(6);
  all[0].start = {1, 0, 0};
  all[1].start = {0.3, 1, 0.5};
  all[2].speed = {0.2, 1, 0};
  all[3].speed = {1, 0, 0};
  all[4].table = {0.4, -0.7, 0.6};
  all[5].radius = 1;
  return all;
}

TEST(RoundBorder, BallLeavesARoundTable) {
  const Closed closed;
  for (const bool ball_first : {true, false}) {
    SCOPED_TRACE(ball_first ? "ball first" : "table first");
    const Scene scene = roundTable(ball_first);
    const int ball = ball_first ? 0 : 1;
    const auto b = static_cast<std::size_t>(ball), other = static_cast<std::size_t>(1 - ball);
    OdeContacts contacts(scene);
    const Motion m = simulate(scene, contacts, kEnd);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2U);
    ASSERT_EQ(m.events[1].cause, TransitionCause::leaves);
    expectEntries(m.events[1].time, closed.t, 1e-13, "time");
    const double fallen = 0.5 * kPull * (kEnd - closed.t) * (kEnd - closed.t);
    expectEntries(m.stateAt(ball, kEnd).position.z(), kStart.z() - fallen, 1e-13, "height");
    ASSERT_TRUE(hasSecondOrder(m));

    StateSeed seed;
    seed.body = ball;
    seed.at = Instant::at(kEnd);
    seed.position = Vec3::UnitZ();
    const std::vector<Change> all = changes();
    std::vector<ReadingDirection> directions;
    for (const Change& c : all) {
      SceneTangent& t = directions.emplace_back(ReadingDirection{SceneTangent(scene), {}}).scene;
      t.bodies[b].position = c.start;
      t.bodies[b].velocity = c.speed;
      t.bodies[other].position = c.table;
      t.bodies[other].size[0] = c.radius;
    }
    DerivativeTape tape(m);
    const SecondOrder second = secondOrder(tape, std::span(&seed, 1), {}, directions);
    for (std::size_t i = 0; i < all.size(); ++i) {
      SCOPED_TRACE("change " + std::to_string(i));
      expectEntries(second.gradient.dot(directions[i].scene), closed.height(all[i]), 1e-11, "first");
      for (std::size_t j = 0; j < all.size(); ++j)
        expectEntries(second.gradient_rates[i].dot(directions[j].scene), closed.height(all[i], all[j]), 1e-10,
                      "second by " + std::to_string(j));
    }
  }
}

}  // namespace
}  // namespace carom::round_border
