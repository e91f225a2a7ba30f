// SPDX-License-Identifier: MIT
// Places beyond the borders of an impact sequence.

#include "editing/strategy/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "editing/strategy/landing.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

constexpr double kAnyLength = std::numeric_limits<double>::infinity();

/// A box that tumbles over a floor, and where it shall be after two impacts or so.
struct TumblingBox {
  Scene scene;
  OdeContacts contacts;
  EditOptions options;
  EditProblem problem;
  EditSearch search;
  EditPointPtr start;

  explicit TumblingBox(bool reversed)
      : scene(sceneOf(reversed)),
        contacts(scene),
        problem(scene, contacts, 1, {velocity("box"), angularVelocity("box")}, constraints()),
        search(problem, options),
        start(search.evaluateStart()) {}

  static Scene sceneOf(bool reversed) {
    Scene scene = testing_scenes::thrownBox();
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    return scene;
  }
  static std::vector<Constraint> constraints() {
    Constraint place{"box", When(0.9), {{"position", {1.4, any, any}}}};
    return {place};
  }
};

TEST(Neighbours, HaveOtherImpacts) {
  TumblingBox t(false);
  ASSERT_TRUE(t.search.differentiate(*t.start));
  const std::string before = t.start->signature;
  const std::vector<Eigen::VectorXd> places = beyondBorders(t.search, *t.start, kAnyLength);
  ASSERT_GE(places.size(), 6u);
  int others = 0, simulated = 0;
  double length = 0;
  for (const Eigen::VectorXd& place : places) {
    EXPECT_GE(lengthOf(t.problem, place), length);  // the smallest change first
    length = lengthOf(t.problem, place);
    if (length > 0.5) continue;  // what is linear at the start says little of places far away
    const EditPointPtr point = t.search.evaluate(place);
    if (!point) continue;
    ++simulated, others += point->signature != t.start->signature;
  }
  EXPECT_GE(simulated, 4);
  EXPECT_GT(2 * others, simulated) << others << " of " << simulated;
  EXPECT_EQ(t.start->signature, before);
}

TEST(Neighbours, KeepBelowALength) {
  TumblingBox t(false);
  ASSERT_TRUE(t.search.differentiate(*t.start));
  const std::vector<Eigen::VectorXd> all = beyondBorders(t.search, *t.start, kAnyLength);
  ASSERT_FALSE(all.empty());
  const double below = lengthOf(t.problem, all[all.size() / 2]);
  const std::vector<Eigen::VectorXd> some = beyondBorders(t.search, *t.start, below);
  EXPECT_LE(some.size(), all.size() / 2);
  for (const Eigen::VectorXd& place : some) EXPECT_LT(lengthOf(t.problem, place), below);
}

TEST(Neighbours, AreTheSameWithBodiesInReverseOrder) {
  TumblingBox a(false), b(true);
  ASSERT_TRUE(a.search.differentiate(*a.start) && b.search.differentiate(*b.start));
  const std::vector<Eigen::VectorXd> one = beyondBorders(a.search, *a.start, kAnyLength),
                                     other = beyondBorders(b.search, *b.start, kAnyLength);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_NEAR(lengthOf(a.problem, one[i]), lengthOf(b.problem, other[i]), 1e-9) << i;
}

}  // namespace
}  // namespace carom
