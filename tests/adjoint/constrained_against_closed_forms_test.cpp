// SPDX-License-Identifier: MIT
// Integrated paths in lasting contact against the closed forms, where both apply: the same states all along, and the same
// end. What has no closed form in the library is held to formulae of its own.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adjoint/contact/contact_path.hpp"
#include "adjoint/simulate/path_arc.hpp"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::held_against_closed_forms {
namespace {

using namespace test;
using namespace adjoint_detail;

constexpr double kSame = 1e-12;
const Vec3 kDown(0, 0, -9.81);

Body floorAt(double height = 0) { return makePlane("floor", Vec3::UnitZ(), height); }
Body ballAt(const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  Body ball = makeBall("ball", 0.1, {0, 0, 0.1}, velocity);
  ball.angular_velocity = spin;
  return ball;
}
Body axleAt(const Shape& shape, double speed) {
  Body body = makeBall("axle", 0.1, {0, 0, 0.1}, {speed, 0, 0});
  body.shape = shape;
  body.angular_velocity = {0, 10 * speed, 0};
  body.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());
  return body;
}
Body table(const Shape& shape) {
  Body body = fixedBody(makeBox("table", {1, 1, 1}, {0, 0, -0.25}));
  body.shape = shape;
  return body;
}

void expectSame(const Kinematics& found, const Kinematics& expected, const std::string& what) {
  expectEntries(found.x, expected.x, kSame, what + ", place");
  expectEntries(found.R, expected.R, kSame, what + ", orientation");
  expectEntries(found.v, expected.v, kSame, what + ", velocity");
  expectEntries(found.w, expected.w, kSame, what + ", spin", std::max(1.0, expected.w.norm()));
}

// The path of body 0 that contacts hold from the start of its arc number k on.
PathArc constrainedInstead(const Motion& m, std::size_t k) {
  const WorldLine& line = m.world_lines[0];
  const Event& event = m.events[static_cast<std::size_t>(line.events[k - 1])];
  std::vector<Contact> lasting;
  for (const Contact& c : event.contacts) {
    if (!c.lasts) continue;
    lasting.push_back(c);
    lasting.back().pair = combine(m.scene->materials[0], m.scene->materials[0]);
  }
  const std::vector<const Contact*> closed = pointersTo(lasting);
  const State& start = line.arcs[k].startState();
  const std::vector<PersistentContact> any(closed.size());
  const ContactChoice candidates = constrainedPathOf(m, 0, start, closed, any, line.arcs[k].start());
  const ConstrainedModes modes = chooseModes(candidates.scene, candidates.modes.contacts, start, {}, 1e-9);
  EXPECT_EQ(modes.unresolved, "");
  EXPECT_EQ(modes.held.size(), closed.size());
  return makePathArc(m, constrainedPathOf(m, 0, start, closed, modes.contacts, line.arcs[k].start()), line.arcs[k].start());
}

void checkArcs(const Motion& m, std::size_t arcs) {
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  const WorldLine& line = m.world_lines[0];
  std::size_t checked = 0;
  for (std::size_t k = 1; k < line.arcs.size(); ++k) {
    const Arc& closed_form = line.arcs[k];
    if (!closed_form.closedForm() || closed_form.kind() == ArcKind::rest) continue;
    ASSERT_FALSE(closed_form.trajectory().constrained());
    SCOPED_TRACE("arc " + std::to_string(k));
    ++checked;
    const bool last = k + 1 == line.arcs.size();
    const double from = closed_form.start(), until = last ? m.end : line.arcs[k + 1].start();
    PathArc held = constrainedInstead(m, k);
    held.arc.extendTo(until);
    if (last) {
      EXPECT_GE(held.arc.knownUntil(), until);
    } else {
      held.arc.extendTo(until + 1e-3);
      expectEntries(held.arc.knownUntil(), until, kSame, "end");
    }
    for (int i = 0; i <= 100; ++i) {
      const double t = std::min(from + (until - from) * i / 100, held.arc.knownUntil());
      expectSame(held.arc.kinematicsAt(t), closed_form.kinematicsAt(t), "at " + std::to_string(t));
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_EQ(checked, arcs);
}
void checkScene(const Vec3& gravity, double friction, std::vector<Body> bodies, double duration, std::size_t arcs) {
  checkArcs(playLasting(makeScene(gravity, 0, friction, std::move(bodies)), duration), arcs);
}

TEST(ConstrainedAgainstClosedForms, BallsThatSlideStraight) {
  checkScene(kDown, 0.3, {ballAt({3, 0, 0}), floorAt()}, 1, 2);
  checkScene(kDown, 0.3, {ballAt({2, 0, 0}, {0, -80, 7}), floorAt()}, 1.5, 2);
  checkScene(downSlope(45), 0.2, {ballAt(Vec3::Zero()), floorAt()}, 1, 1);
}

TEST(ConstrainedAgainstClosedForms, BallsThatSlideRoundABend) {
  checkScene(downSlope(10), 0.1, {ballAt({0, 2, 0}), floorAt()}, 1.2, 2);
  checkScene(downSlope(40), 0.15, {ballAt({-1, 1, 0}, {5, 3, 1}), floorAt()}, 1.2, 1);
}

TEST(ConstrainedAgainstClosedForms, BallsThatRoll) {
  checkScene(downSlope(15), 0.4, {ballAt({0.5, 0, 0}, {0, 5, 2}), floorAt()}, 1, 1);
  checkScene(downSlope(15), 0.4, {ballAt({0, 0.5, 0}, {-5, 0, 20}), floorAt()}, 1, 1);
}

TEST(ConstrainedAgainstClosedForms, BallsThatRollOffTables) {
  for (const Shape& top : {Shape(Box{{2, 2, 0.5}}), Shape(Cylinder{1, 0.5})})
    checkScene(kDown, 0.2, {ballAt({2, 0.2, 0}), table(top), floorAt(-2)}, 0.9, 2);
}

TEST(ConstrainedAgainstClosedForms, AxlesThatRoll) {
  for (const Shape& shape : {Shape(Cylinder{0.1, 0.3}), Shape(Capsule{0.1, 0.3})})
    checkScene(downSlope(15), 0.4, {axleAt(shape, 0.5), floorAt()}, 1, 1);
}

TEST(ConstrainedAgainstClosedForms, BlocksThatDoNotTurn) {
  const Body block = makeBox("block", {.4, .3, .2}, {0, 0, .1}, {1, 0, 0});
  checkScene(kDown, 0.3, {block, floorAt()}, 1, 1);
  Body across = block;
  across.velocity = {0, 2, 0};
  checkScene(downSlope(20), 0.5, {across, floorAt()}, 1.5, 1);
  Body starts = block;
  starts.velocity.setZero();
  checkScene(downSlope(30), 0.3, {starts, floorAt()}, 1, 1);
}

// Moments that are written vary one by one, and so the ball is held by collocation; where that is not asked for, not.
TEST(ConstrainedAgainstClosedForms, ABallWithWrittenMoments) {
  for (const double degrees : {0.0, 10.0}) {
    SCOPED_TRACE(std::to_string(degrees) + " degrees");
    Body ball = makeBall("ball", 0.1, {0, 0, 0.1}, {0.3, 2, 0});
    ball.angular_velocity = {5, 3, 1};
    ball.inertia = Inertia::fromMoments(Vec3::Constant(0.4 * 0.1 * 0.1));
    const Scene scene = makeScene(downSlope(degrees), 0, 0.1, {ball, floorAt()});
    const Motion closed_form = playLasting(scene, 2, {{true, false}, {}}), held = playLasting(scene, 2);
    ASSERT_EQ(held.status, MotionStatus::complete) << held.message;
    ASSERT_EQ(held.world_lines[0].arcs.size(), closed_form.world_lines[0].arcs.size());
    for (std::size_t k = 1; k < held.world_lines[0].arcs.size(); ++k) {
      ASSERT_TRUE(held.world_lines[0].arcs[k].trajectory().constrained());
      ASSERT_TRUE(closed_form.world_lines[0].arcs[k].closedForm());
      EXPECT_EQ(held.world_lines[0].arcs[k].kind(), closed_form.world_lines[0].arcs[k].kind());
      expectEntries(held.events[k - 1].time, closed_form.events[k - 1].time, kSame, "event");
    }
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.02 * i;
      const auto kinematicsOf = [&](const Motion& m) {
        const BodyState s = m.stateAt(0, t);
        return Kinematics{s.position, s.orientation.toRotationMatrix(), s.velocity, s.angular_velocity};
      };
      expectSame(kinematicsOf(held), kinematicsOf(closed_form), "at " + std::to_string(t));
    }
  }
}

// A ball in a V touches it below its middle, at r sin g from the axis about which it turns: it rolls as if it were so much
// smaller.
TEST(ConstrainedAgainstClosedForms, ABallRollsInAV) {
  for (const double side : {0.4, 0.9}) {  // of the walls' normals above the horizontal
    SCOPED_TRACE(side);
    const Vec3 left(0, -std::cos(side), std::sin(side)), right(0, std::cos(side), std::sin(side));
    const double r = 0.1, small = r * std::sin(side), slope = downSlope(15).x();
    Body ball = makeBall("ball", r, {0, 0, r / std::sin(side)}, {0.3, 0, 0});
    ball.angular_velocity = {0, 0.3 / small, 0};
    const std::vector<Body> orders[] = {{ball, makePlane("left", left, 0), makePlane("right", right, 0)},
                                        {makePlane("right", right, 0), ball, makePlane("left", left, 0)}};
    for (int own = 0; own < 2; ++own) {
      const Motion m = playLasting(makeScene(downSlope(15), 0, 0.9, orders[own]), 2);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      const double along = slope / (1 + 0.4 * r * r / (small * small));
      for (int i = 0; i <= 100; ++i) {
        const double t = 0.02 * i;
        const BodyState s = m.stateAt(own, t);
        const double v = 0.3 + along * t, x = 0.3 * t + 0.5 * along * t * t;
        expectEntries(s.position, Vec3(x, 0, r / std::sin(side)), kSame, "place");
        expectEntries(s.velocity, Vec3(v, 0, 0), kSame, "velocity");
        expectEntries(s.angular_velocity, Vec3(0, v / small, 0), kSame, "spin", v / small);
        const double turned = 0.5 * x / small;
        const Quat expected(std::cos(turned), 0, std::sin(turned), 0);
        expectEntries(s.orientation.toRotationMatrix(), expected.toRotationMatrix(), 4 * kSame, "orientation");
      }
    }
  }
}

}  // namespace
}  // namespace carom::held_against_closed_forms
