// SPDX-License-Identifier: MIT
// Soft constraints between two times: closed forms, derivatives of the sum where its time moves, at an event and at an end
// of the span, and what comes out of a recording without clocks.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/session.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/edits/ball_above.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom::test {
namespace {

// Without gravity and with its velocity along x the way is a line, whose distance from the place is |y|: only the speed
// across it changes that.
TEST(SoftBetween, OfALineIsItsDistance) {
  Scene scene = ballAbove({1, 0, 0});
  scene.gravity.setZero();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("ball").only({"y"}));
  edit.nail("ball", between(0.2, 1.8)).position(1, 0.1, 1).soft(3);
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  // Nearest to the line (t, v t): |v - 0.1| / sqrt(1 + v^2) in lengths of 0.2 m and speeds of sqrt(g l); here g is 0.
  const double v = r.changed[0].after, d = (v - 0.1) / std::sqrt(1 + v * v);
  const double errors = 0.5 * 9 * d * d / 0.04, change = r.objective - errors;
  EXPECT_GT(v, 0);
  EXPECT_LT(v, 0.1);
  EXPECT_NEAR(r.fit.sum_of_squares, 2 * errors, 1e-12);
  const double scale = v / std::sqrt(2 * change);
  const double slope = 9 * (v - 0.1) * (1 + 0.1 * v) / (0.04 * std::pow(1 + v * v, 2));
  EXPECT_NEAR(slope, -v / (scale * scale), 1e-7 * std::abs(slope)) << "the least of the sum";
  ASSERT_EQ(r.times.size(), 1u);
  EXPECT_NEAR(r.times[0].time, (1 + 0.1 * v) / (1 + v * v), 1e-9);
  EXPECT_EQ(r.times[0].name, "'ball' between 0.2 s and 1.8 s");
}

/// The objective of a scene with one soft nail between two times, and its gradient.
struct Checked {
  Scene scene;
  OdeContacts contacts;
  Edit edit;
  Checked(const Scene& s, double duration) : scene(s), contacts(scene), edit(scene, contacts, duration) {}

  void expectExact(const char* what) const {
    const NlpEvaluator program = edit.evaluator();
    const Eigen::Index n = static_cast<Eigen::Index>(program.variables().size());
    Eigen::VectorXd x(n);
    for (Eigen::Index j = 0; j < n; ++j) x[j] = program.variables()[static_cast<std::size_t>(j)].start;
    const NlpPoint at = program.at(x);
    ASSERT_TRUE(at.available()) << what << ": " << at.message();
    const Eigen::VectorXd gradient = at.gradient().entries;
    ASSERT_GT(at.objective(), 0) << what;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double h = 1e-6;
      const Eigen::VectorXd e = h * Eigen::VectorXd::Unit(n, j);
      expectEntries(gradient[j], (program.at(x + e).objective() - program.at(x - e).objective()) / (2 * h), 1e-6, what,
                    gradient.norm());
    }
  }
};

// The best time lies within an arc, at an impact (a place below the floor), or at an end of the span.
TEST(SoftBetween, DerivativesOfTheObjectiveAreExact) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Scene scene = ballAbove({random.in(0.5, 2), random.in(-0.5, 0.5), random.in(-1, 2)});
    OdeContacts contacts(scene);
    const Motion motion = simulate(scene, contacts, 2);
    const auto beside = [&](double t) -> Vec3 {
      return motion.stateAt("ball", t).position + Vec3(random.in(-0.05, 0.05), random.in(-0.1, 0.1), random.in(-0.05, 0.05));
    };
    const auto check = [&](const When& at, const Vec3& place, const char* what) {
      Checked checked(scene, 2);
      checked.edit.vary(velocity("ball"), elasticity("m"), position("ball"));
      checked.edit.nail("ball", at).position(place).soft(random.in(0.3, 3));
      checked.expectExact(what);
    };
    check(between(0.1, 1.9), beside(random.in(0.4, 1.6)), "within an arc");
    const double impact = motion.events[0].time;
    const Vec3 below = motion.stateAt("ball", impact).position + Vec3(random.in(-0.02, 0.02), random.in(-0.02, 0.02), -0.2);
    check(between(impact - 0.1, impact + 0.1), below, "at an impact");
    check(between(1.2, 1.9), motion.stateAt("ball", 0.3).position - Vec3(3, 0, 0), "at an end");
  }
}

// A body seen from another, and a range within which nothing pulls.
TEST(SoftBetween, RelativeToAnotherBodyAndWithinARange) {
  Scene scene = ballAbove({1, 0, 2});
  Body other = scene.bodies[1];
  other.name = "other", other.position = {0.5, 1, 1}, other.velocity = {0.3, 0, 1};
  other.angular_velocity = {0, 0, 0.4};
  scene.bodies.push_back(other);
  Checked relative(scene, 1.5);
  relative.edit.vary(velocity("ball"), velocity("other"), angularVelocity("other"));
  relative.edit.nail("ball", between(0.2, 1.4)).position(0.1, -0.8, 0.1).relativeTo("other").soft(2);
  relative.expectExact("relative");
  Checked range(scene, 1.5);
  range.edit.vary(velocity("ball"));
  range.edit.nail("ball", between(0.2, 0.6)).position(within(0, 2), atMost(1), atLeast(1.3)).soft(2);
  range.expectExact("range");
}

// A recording without clocks: places along a bounce, each somewhere in a span. The fit finds what they were made with, and
// has as many times as parameters beside the four.
TEST(SoftBetween, FitsPlacesWhoseTimesAreNotKnown) {
  Scene hidden = ballAbove({1.3, 0.2, 0.5});
  hidden.materials[0].elasticity = 0.76;
  OdeContacts contacts(hidden);
  const Motion motion = simulate(hidden, contacts, 2);
  int found = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    Scene start = hidden;
    start.materials[0].elasticity = random.in(0.65, 0.85);
    start.bodies[1].velocity += Vec3(random.in(-0.2, 0.2), random.in(-0.2, 0.2), random.in(-0.2, 0.2));
    OdeContacts of_start(start);
    Edit edit(start, of_start, 2);
    edit.vary(velocity("ball").weighted(1e-3), elasticity("m").weighted(1e-3));
    for (int k = 1; k <= 10; ++k) {
      const double t = 0.17 * k;
      const Vec3 noise(random.in(-1e-3, 1e-3), random.in(-1e-3, 1e-3), random.in(-1e-3, 1e-3));
      edit.nail("ball", between(t - 0.05, t + 0.05)).position(motion.stateAt("ball", t).position + noise).soft();
    }
    const EditResult r = edit.solve({.effort = Effort::fast});
    ASSERT_TRUE(r.solved()) << r.message;
    EXPECT_EQ(r.fit.rows, 30);
    ++all;
    if (!r.fit.deviation || *r.fit.deviation > 0.01) continue;  // a local minimum, which the deviation of an error tells
    ++found;
    EXPECT_GE(r.fit.parameters, 4 + 6) << r.fit.message;
    const double made_with[] = {1.3, 0.2, 0.5, 0.76};
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_TRUE(r.changed[i].standard_deviation) << r.fit.message;
      EXPECT_NEAR(r.changed[i].after, made_with[i], 5 * *r.changed[i].standard_deviation) << r.changed[i].name;
    }
  }
  EXPECT_GE(found, 3) << "of " << all;
}

// Beside exact constraints, also between two times, which have a time of their own.
TEST(SoftBetween, BesideExactOnes) {
  const Scene scene = ballAbove({1, 0, 2});
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.5);
  edit.vary(velocity("ball"), elasticity("m"));
  edit.nail("ball", between(1.0, 1.4)).position(1.5, 0.1, any);
  edit.nail("ball", between(0.2, 0.6)).position(0.4, 0.1, 1.3).soft(2);
  edit.nail("ball", 0.9).position(0.9, 0.1, 0.3).soft();
  const EditResult r = edit.solve({.effort = Effort::fast});
  ASSERT_TRUE(r.solved()) << r.message;
  EXPECT_LE(r.scaled_residual, 1e-9);
  ASSERT_EQ(r.times.size(), 2u);
  EXPECT_EQ(r.times[0].constraint, 0);
  EXPECT_EQ(r.times[1].constraint, 1);
  const Vec3 place = r.motion.stateAt("ball", r.times[1].time).position;
  for (double beside : {-1e-4, 1e-4}) {
    const double t = r.times[1].time + beside;
    if (!(t >= 0.2 && t <= 0.6)) continue;
    EXPECT_GE((r.motion.stateAt("ball", t).position - Vec3(0.4, 0.1, 1.3)).norm(), (place - Vec3(0.4, 0.1, 1.3)).norm());
  }
}

TEST(SoftBetween, ASessionTakesThem) {
  const Scene scene = ballAbove({1, 0, 2});
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.5);
  Constraint place{"ball", between(0.3, 0.7), {Target{"position", {0.5, 0.1, 1.2}}}};
  place.soft = 2;
  EditSession session(scene, contacts, 1.5, {velocity("ball")}, {place});
  const SessionUpdate update = session.meetNails();
  EXPECT_TRUE(update.reached) << update.message;
  edit.vary(velocity("ball"));
  edit.nail("ball", between(0.3, 0.7)).position(0.5, 0.1, 1.2).soft(2);
  const EditResult r = edit.solve();
  EXPECT_NEAR((session.scene().bodies[1].velocity - r.scene.bodies[1].velocity).norm(), 0, 1e-6);
  EXPECT_NEAR(session.nailStates()[0].time, r.times[0].time, 1e-5);
}

TEST(SoftBetween, AreWrittenAndRead) {
  Document document;
  document.scene = ballAbove({1, 0, 2});
  document.duration = 1;
  document.controls = {velocity("ball")};
  Constraint place{"ball", between(0.2, 0.5), {Target{"position", {1.0, any, any}}}};
  place.soft = 0.5;
  document.constraints = {place};
  const Document again = parseDocument(writeDocument(document), "again");
  ASSERT_TRUE(again.constraints.at(0).at.span);
  EXPECT_EQ(again.constraints[0].soft, 0.5);
}

}  // namespace
}  // namespace carom::test
