// SPDX-License-Identifier: MIT
// Places beyond the boundaries of an impact sequence.

#include "editing/strategy/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "editing/problem/margins/near_misses.hpp"
#include "editing/strategy/local_solve.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

constexpr double kAnyLength = std::numeric_limits<double>::infinity();
constexpr std::size_t kMisses = 12;

/// An edit of one second of a scene.
struct SecondOf {
  Scene scene;
  OdeContacts contacts;
  EditOptions options;
  EditProblem problem;
  EditEvaluator evaluator;
  EditPointPtr start;

  SecondOf(Scene s, const std::vector<Control>& controls, const std::vector<Constraint>& constraints, bool reversed)
      : scene(std::move(s)),
        contacts(ordered(scene, reversed)),
        problem(scene, contacts, 1, controls, constraints),
        evaluator(problem, options),
        start(evaluator.evaluateStart()) {}

  static const Scene& ordered(Scene& scene, bool reversed) {
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    return scene;
  }
};

/// A box that tumbles over a floor, and where it shall be after two impacts or so.
struct TumblingBox : SecondOf {
  explicit TumblingBox(bool reversed)
      : SecondOf(testing_scenes::thrownBox(), {velocity("box"), angularVelocity("box")}, constraints(), reversed) {}

  static std::vector<Constraint> constraints() {
    Constraint place{"box", When(0.9), {{"position", {1.4, any, any}}}};
    return {place};
  }
};

TEST(Neighbours, HaveOtherImpacts) {
  TumblingBox t(false);
  ASSERT_TRUE(t.evaluator.differentiate(*t.start));
  const std::string before = t.start->signature;
  const std::vector<Eigen::VectorXd> places = beyondBoundaries(t.evaluator, *t.start, kAnyLength, kMisses);
  ASSERT_GE(places.size(), 6u);
  int others = 0, simulated = 0;
  double length = 0;
  for (const Eigen::VectorXd& place : places) {
    EXPECT_GE(lengthOf(t.problem, place), length);  // the smallest change first
    length = lengthOf(t.problem, place);
    if (length > 0.5) continue;  // what is linear at the start says little of places far away
    const EditPointPtr point = t.evaluator.evaluate(place);
    if (!point) continue;
    ++simulated, others += point->signature != t.start->signature;
  }
  EXPECT_GE(simulated, 4);
  EXPECT_GT(2 * others, simulated) << others << " of " << simulated;
  EXPECT_EQ(t.start->signature, before);
}

TEST(Neighbours, KeepBelowALength) {
  TumblingBox t(false);
  ASSERT_TRUE(t.evaluator.differentiate(*t.start));
  const std::vector<Eigen::VectorXd> all = beyondBoundaries(t.evaluator, *t.start, kAnyLength, kMisses);
  ASSERT_FALSE(all.empty());
  const double below = lengthOf(t.problem, all[all.size() / 2]);
  const std::vector<Eigen::VectorXd> some = beyondBoundaries(t.evaluator, *t.start, below, kMisses);
  EXPECT_LE(some.size(), all.size() / 2);
  for (const Eigen::VectorXd& place : some) EXPECT_LT(lengthOf(t.problem, place), below);
}

TEST(Neighbours, AreTheSameWithBodiesInReverseOrder) {
  TumblingBox a(false), b(true);
  ASSERT_TRUE(a.evaluator.differentiate(*a.start) && b.evaluator.differentiate(*b.start));
  const std::vector<Eigen::VectorXd> one = beyondBoundaries(a.evaluator, *a.start, kAnyLength, kMisses),
                                     other = beyondBoundaries(b.evaluator, *b.start, kAnyLength, kMisses);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_NEAR(lengthOf(a.problem, one[i]), lengthOf(b.problem, other[i]), 1e-9) << i;
}

/// A ball that passes another one without gravity, at (kAhead, kBeside, 0), and where it shall be later.
struct PassingBall : SecondOf {
  static constexpr double kRadius = 0.1, kSpeed = 2, kAhead = 1, kBeside = 0.3;

  explicit PassingBall(bool reversed) : SecondOf(passing(), {velocity("ball")}, constraints(), reversed) {}

  static Scene passing() {
    Scene scene;
    scene.gravity.setZero();
    for (const char* name : {"ball", "other"}) {
      Body body;
      body.name = name;
      body.mass = 1;
      body.shape = Sphere{kRadius};
      scene.bodies.push_back(body);
    }
    scene.bodies[0].velocity = Vec3(kSpeed, 0, 0);
    scene.bodies[1].position = Vec3(kAhead, kBeside, 0);
    return scene;
  }
  static std::vector<Constraint> constraints() {
    Constraint place{"ball", When(0.9), {{"position", {2, 0.2, any}}}};
    return {place};
  }
};

// Along a line in the direction of v the least distance of the centres is |kAhead v_y - kBeside v_x| / |v|.
TEST(Neighbours, KnowHowNearBodiesPass) {
  for (const bool reversed : {false, true}) {
    PassingBall p(reversed);
    DerivativeTape tape(p.start->motion);
    const std::vector<NearMiss> misses = nearMisses(p.problem, p.start->changes, tape, p.start->rows, kMisses);
    ASSERT_EQ(misses.size(), 1u);
    const NearMiss& miss = misses[0];
    EXPECT_TRUE(std::abs(miss.gap - (p.kBeside - 2 * p.kRadius)) <= 1e-12) << miss.gap;
    EXPECT_EQ(miss.length, p.kRadius);
    const Vec3 by_velocity(0, -p.kAhead / p.kSpeed, 0);
    const Eigen::VectorXd rates = p.problem.controls.valueRates(p.start->changes);
    ASSERT_EQ(miss.gradient.size(), 3);
    for (int i = 0; i < 3; ++i)
      EXPECT_TRUE(std::abs(miss.gradient[i] - by_velocity[i] * rates[i]) <= 1e-9 * rates.norm())
          << i << ": " << miss.gradient[i];
  }
}

TEST(Neighbours, MeetWhatTheMotionPasses) {
  PassingBall p(false);
  ASSERT_TRUE(p.evaluator.differentiate(*p.start));
  EXPECT_TRUE(beyondBoundaries(p.evaluator, *p.start, kAnyLength, 0).empty());
  const std::vector<Eigen::VectorXd> places = beyondBoundaries(p.evaluator, *p.start, kAnyLength, kMisses);
  ASSERT_FALSE(places.empty());
  const EditPointPtr nearest = p.evaluator.evaluate(places[0]);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(p.start->motion.impacts, 0u);
  EXPECT_EQ(nearest->motion.impacts, 1u);
}

}  // namespace
}  // namespace carom
