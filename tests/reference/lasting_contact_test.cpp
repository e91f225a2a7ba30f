// SPDX-License-Identifier: MIT
// A ball that is thrown onto a table, bounces, is captured, slides, rolls, and leaves the table, against the same in 50
// digits: times of all events, states, and every column of the derivative.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/reference/contact_path.h"
#include "tests/reference/differences.h"
#include "tests/reference/impact.h"
#include "tests/reference/worst.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom::reference::lasting {
namespace {

using test::expectEntries;
using test::makeBall;
using test::makeBox;
using test::makeScene;

/// The numbers of the scene, and the motion in them along the events of another.
struct Numbers {
  RVec gravity, x, v, spin, table_x, table_size;
  RMat R = RMat::identity(), table_R = RMat::identity();
  Real elasticity, friction, tangential, mass, radius;
};

Numbers numbersOf(const Scene& s, const Body& ball, const Body& table) {
  Numbers n;
  n.gravity = RVec(s.gravity);
  n.x = RVec(ball.position), n.v = RVec(ball.velocity), n.spin = RVec(ball.angular_velocity);
  n.R = rotationOf(ball.orientation), n.table_R = rotationOf(table.orientation);
  n.table_x = RVec(table.position), n.table_size = RVec(std::get<Box>(table.shape).size);
  n.elasticity = s.materials[0].elasticity, n.friction = s.materials[0].friction;
  n.tangential = s.materials[0].tangential_elasticity;
  n.mass = *ball.mass, n.radius = std::get<Sphere>(ball.shape).radius;
  return n;
}

class Chain {
 public:
  Chain(const Numbers& numbers, const Motion& like, int ball, double until)
      : n_(numbers), x(n_.x), v(n_.v), spin(n_.spin), R(n_.R) {
    normal_ = n_.table_R.column[2];
    inertia_ = Real(2) / 5 * n_.mass * n_.radius * n_.radius;
    const WorldLine& line = like.world_lines[static_cast<std::size_t>(ball)];
    for (std::size_t k = 0; k < line.events.size(); ++k) {
      const Event& event = like.events[static_cast<std::size_t>(line.events[k])];
      if (event.kind != EventKind::transition)
        bounce(event);
      else if (event.cause == TransitionCause::slip_ends)
        endSlip();
      else
        leave(event);
      times.push_back(now_);
      kind_ = line.arcs[k + 1].kind();
    }
    move(Real(until) - now_);
  }

  std::vector<Real> times;

 private:
  const Numbers n_;

 public:
  RVec x, v, spin;
  RMat R;

 private:
  void bounce(const Event& event) {
    const RVec top = n_.table_x + (n_.table_size[2] / 2) * normal_;
    Real s = Real(event.time) - now_;
    for (int i = 0; i < 8; ++i) {
      const Real gap = dot(normal_, x + s * v + (s * s / 2) * n_.gravity - top) - n_.radius;
      s -= gap / dot(normal_, v + s * n_.gravity);
    }
    move(s);
    Side a{true, 1 / n_.mass, {1 / inertia_, 1 / inertia_, 1 / inertia_}, R, -n_.radius * normal_, v, spin};
    const Contact& c = event.contacts[0];
    ImpactMode mode = event.mode;
    const RVec P =
        impulseOf(a, Side(), normal_, {c.captured ? Real(0) : n_.elasticity, n_.friction, n_.tangential}, mode, false);
    v = v + (1 / n_.mass) * P;
    spin = spin + (1 / inertia_) * cross(a.arm, P);
  }
  void endSlip() {
    ContactPath path = pathHere();
    now_ += path.slideToEnd();
    take(path);
  }
  // The point of contact comes to the side of the table that it is nearest to.
  void leave(const Event& event) {
    Real s = Real(event.time) - now_;
    for (int i = 0; i < 6; ++i) {
      ContactPath path = pathHere();
      path.advance(s);
      const RVec from = path.x - n_.radius * normal_ - n_.table_x;
      int axis = 0, sign = 0;
      Real nearest = 1;
      for (int k = 0; k < 2; ++k) {
        const Real along = dot(n_.table_R.column[k], from), off = abs(abs(along) - n_.table_size[k] / 2);
        if (off < nearest) nearest = off, axis = k, sign = along > 0 ? 1 : -1;
      }
      const RVec out = Real(sign) * n_.table_R.column[axis];
      s -= (dot(out, from) - n_.table_size[axis] / 2) / dot(out, path.v);
    }
    move(s);
  }
  void move(const Real& s) {
    now_ += s;
    if (kind_ != ArcKind::flight) {
      ContactPath path = pathHere();
      path.advance(s);
      take(path);
      return;
    }
    x = x + s * v + (s * s / 2) * n_.gravity;
    v = v + s * n_.gravity;
    R = rotationBy(s * spin) * R;
  }
  ContactPath pathHere() const {
    ContactPath path;
    path.x = x, path.v = v, path.R = R, path.momentum = inertia_ * spin;
    path.gravity = n_.gravity, path.normal = normal_;
    path.friction = n_.friction, path.mass = n_.mass, path.inertia = inertia_, path.reach = n_.radius;
    path.slides = kind_ == ArcKind::slide;
    return path;
  }
  void take(const ContactPath& path) { x = path.x, v = path.v, R = path.R, spin = (1 / inertia_) * path.momentum; }

  RVec normal_;
  Real inertia_, now_ = 0;
  ArcKind kind_ = ArcKind::flight;
};

/// One number of the scene: how it is nudged, and where its derivative stands.
struct Column {
  std::string name;
  std::function<void(Numbers&, const Real&)> nudge;
  std::function<double(const SceneGradient&)> entry;
};

std::vector<Column> columns(std::size_t ball, std::size_t table) {
  std::vector<Column> all;
  for (int c = 0; c < 3; ++c) {
    const std::string at = "." + std::string(1, "xyz"[c]);
    all.push_back({"gravity" + at, [=](Numbers& n, const Real& h) { n.gravity[c] += h; },
                   [=](const auto& g) { return g.gravity[c]; }});
    all.push_back({"position" + at, [=](Numbers& n, const Real& h) { n.x[c] += h; },
                   [=](const auto& g) { return g.bodies[ball].position[c]; }});
    all.push_back({"velocity" + at, [=](Numbers& n, const Real& h) { n.v[c] += h; },
                   [=](const auto& g) { return g.bodies[ball].velocity[c]; }});
    all.push_back({"spin" + at, [=](Numbers& n, const Real& h) { n.spin[c] += h; },
                   [=](const auto& g) { return g.bodies[ball].angular_velocity[c]; }});
    all.push_back({"orientation" + at, [=](Numbers& n, const Real& h) { n.R = rotationBy(axisVector(c, h)) * n.R; },
                   [=](const auto& g) { return g.bodies[ball].orientation[c]; }});
    all.push_back({"table's position" + at, [=](Numbers& n, const Real& h) { n.table_x[c] += h; },
                   [=](const auto& g) { return g.bodies[table].position[c]; }});
    all.push_back({"table's orientation" + at,
                   [=](Numbers& n, const Real& h) { n.table_R = rotationBy(axisVector(c, h)) * n.table_R; },
                   [=](const auto& g) { return g.bodies[table].orientation[c]; }});
    all.push_back({"table's size" + at, [=](Numbers& n, const Real& h) { n.table_size[c] += h; },
                   [=](const auto& g) { return g.bodies[table].size[c]; }});
  }
  all.push_back({"elasticity", [](Numbers& n, const Real& h) { n.elasticity += h; },
                 [](const auto& g) { return g.materials[0].elasticity; }});
  all.push_back({"friction", [](Numbers& n, const Real& h) { n.friction += h; },
                 [](const auto& g) { return g.materials[0].friction; }});
  all.push_back(
      {"mass", [](Numbers& n, const Real& h) { n.mass += h; }, [=](const auto& g) { return g.bodies[ball].mass; }});
  all.push_back({"radius", [](Numbers& n, const Real& h) { n.radius += h; },
                 [=](const auto& g) { return g.bodies[ball].size[0]; }});
  return all;
}

Scene scene(double tilt, bool reversed) {
  Scene s = makeScene(
      {0.3, 0.2, -9.81}, 0.3, 0.15,
      {makeBall("ball", 0.1, {-1.5, 0.1, 0.5}, {3, 0.3, -0.2}), makeBox("table", {4, 2.4, 0.5}, {0, 0, -0.25})});
  s.bodies[0].orientation = Quat(0.8, 0.3, -0.4, 0.2).normalized();
  s.bodies[0].angular_velocity = {3, -5, 2};
  s.bodies[1].fixed = true;
  s.bodies[1].orientation = Quat(Eigen::AngleAxisd(tilt, Vec3(0.3, 0.9, 0.2).normalized()));
  if (reversed) std::swap(s.bodies[0], s.bodies[1]);
  return s;
}

// Of the columns each `stride`-th: one takes a fifth of a second.
void expectChain(double tilt, bool reversed, double until, std::size_t stride) {
  const Scene s = scene(tilt, reversed);
  const int ball = reversed ? 1 : 0;
  const std::size_t b = reversed ? 1 : 0, table = reversed ? 0 : 1;
  OdeContacts contacts(s);
  SimulateOptions options;
  options.lowest_bounce = 1e-3;
  const Motion m = simulate(s, contacts, until, options);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  const auto has = [&](EventKind kind, TransitionCause cause) {
    return std::ranges::any_of(m.events, [&](const Event& e) { return e.kind == kind && e.cause == cause; });
  };
  ASSERT_TRUE(has(EventKind::impact, TransitionCause::none) && has(EventKind::capture, TransitionCause::none));
  ASSERT_TRUE(has(EventKind::transition, TransitionCause::slip_ends) &&
              has(EventKind::transition, TransitionCause::leaves));

  const Numbers numbers = numbersOf(s, s.bodies[b], s.bodies[table]);
  const Chain chain(numbers, m, ball, until);
  for (std::size_t e = 0; e < m.events.size(); ++e)
    expectEntries(m.events[e].time, static_cast<double>(chain.times[e]), 1e-12, "time of event " + std::to_string(e));
  const BodyState end = m.stateAt(ball, until);
  expectEntries(end.position, chain.x.rounded(), 1e-11, "place");
  expectEntries(end.velocity, chain.v.rounded(), 1e-11, "velocity");
  expectEntries(end.angular_velocity, chain.spin.rounded(), 1e-10, "spin");
  expectEntries(Mat3(end.orientation.toRotationMatrix()), rounded(chain.R), 1e-10, "orientation");

  DerivativeTape tape(m);
  std::vector<SceneGradient> rows;
  const auto add = [&](const Instant& at, int component) {
    StateSeed seed;
    seed.body = ball, seed.at = at;
    Vec3* const parts[] = {&seed.position, &seed.orientation, &seed.velocity, &seed.angular_velocity};
    (component == 12 ? seed.time : (*parts[component / 3])[component % 3]) = 1;
    rows.push_back(adjoint(tape, std::span(&seed, 1)));
  };
  for (int c = 0; c < 12; ++c) add(Instant::at(until), c);
  for (std::size_t e = 0; e < m.events.size(); ++e) add(Instant::before(static_cast<int>(e)), 12);
  const std::vector<Column> all = columns(b, table);
  for (std::size_t k = 0; k < all.size(); k += stride) {
    const Column& column = all[k];
    Numbers nudged = numbers;
    column.nudge(nudged, kNudge);
    const Chain there(nudged, m, ball, until);
    const Real over = 1 / kNudge;
    Eigen::VectorXd expected(rows.size()), found(rows.size());
    expected.head<12>() << (over * (there.x - chain.x)).rounded(), (over * rotationBetween(chain.R, there.R)).rounded(),
        (over * (there.v - chain.v)).rounded(), (over * (there.spin - chain.spin)).rounded();
    for (std::size_t e = 0; e < m.events.size(); ++e)
      expected[12 + static_cast<Eigen::Index>(e)] = static_cast<double>(over * (there.times[e] - chain.times[e]));
    for (std::size_t i = 0; i < rows.size(); ++i) found[static_cast<Eigen::Index>(i)] = column.entry(rows[i]);
    expectEntries(found, expected, kGradientTolerance, column.name, std::max(expected.norm(), kSmallestScale));
  }
}

TEST(LastingContact, OnALevelTable) { expectChain(0, false, 1.7, 2); }
TEST(LastingContact, OnATiltedTable) { expectChain(0.06, false, 1.7, 1); }
TEST(LastingContact, WithBodiesInReverseOrder) { expectChain(0.06, true, 1.7, 3); }

}  // namespace
}  // namespace carom::reference::lasting
