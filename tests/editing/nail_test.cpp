// SPDX-License-Identifier: MIT
// What nails of the C++ API ask for, and what results say of it.

#include "editing/nail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/problem/edit_problem.hpp"
#include "editing/problem_of.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;
using Numbers = std::vector<TargetNumber>;

/// Numbers with the free ones as 99.
Numbers shown(Numbers numbers) {
  for (TargetNumber& x : numbers)
    if (x.isFree()) x = 99;
  return numbers;
}

class Nails : public testing::Test {
 protected:
  Nails() {
    scene.materials = {material("rubber", 0.8, 0.3)};
    scene.bodies = {fixedPlane("floor", "rubber", {0, 0, 1}, 0), ball("ball", "rubber", 0.1, {0, 0, 1}, {2, 0, 1}),
                    ball("other", "rubber", 0.1, {3, 2, 1}, {0, 0, 2})};
    contacts.emplace(scene);
    edit.emplace(scene, *contacts, 1.0);
  }
  Constraint only() const { return edit->constraints().at(0); }
  Target target(std::size_t i = 0) const { return only().targets.at(i); }

  Scene scene;
  std::optional<OdeContacts> contacts;
  std::optional<Edit> edit;
};

TEST_F(Nails, VectorsAreTargetsWithFreeComponents) {
  edit->nail("ball", 0.5).position({1, any, 2}).velocity({0, 0, any}).orientation(Quat(0, 1, 0, 0));
  EXPECT_EQ(only().body, "ball");
  EXPECT_EQ(only().at.time, 0.5);
  ASSERT_EQ(only().targets.size(), 3u);
  EXPECT_EQ(target(0).quantity, "position");
  EXPECT_EQ(shown(target(0).value), (Numbers{1, 99, 2}));
  EXPECT_EQ(shown(target(1).value), (Numbers{0, 0, 99}));
  EXPECT_EQ(target(2).value, (Numbers{0, 1, 0, 0}));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(target(i).min.empty() && target(i).max.empty());
}

TEST_F(Nails, ComponentsHaveRanges) {
  edit->nail("ball", nthImpact(2, "floor"))
      .position(within(0.1, 0.3), any, 2)
      .velocity(atLeast(-1), atMost(4), any)
      .angularVelocity(1, 2, any)
      .point({0.1, 0, 0}, any, any, within(-1, 1))
      .time(atMost(0.7));
  EXPECT_EQ(only().at.impact, 2);
  EXPECT_EQ(only().at.with, "floor");
  EXPECT_EQ(shown(target(0).value), (Numbers{99, 99, 2}));
  EXPECT_EQ(shown(target(0).min), (Numbers{0.1, 99, 99}));
  EXPECT_EQ(shown(target(0).max), (Numbers{0.3, 99, 99}));
  EXPECT_EQ(shown(target(1).min), (Numbers{-1, 99, 99}));
  EXPECT_EQ(shown(target(1).max), (Numbers{99, 4, 99}));
  EXPECT_EQ(target(2).quantity, "angular_velocity");
  EXPECT_EQ(shown(target(2).value), (Numbers{1, 2, 99}));
  EXPECT_TRUE(target(2).min.empty());
  EXPECT_EQ(target(3).quantity, "point");
  EXPECT_EQ(target(3).body_point, Vec3(0.1, 0, 0));
  EXPECT_EQ(shown(target(3).max), (Numbers{99, 99, 1}));
  EXPECT_EQ(target(4).quantity, "time");
  EXPECT_EQ(shown(target(4).value), Numbers{99});
  EXPECT_TRUE(target(4).min.empty());
  EXPECT_EQ(target(4).max, Numbers{0.7});
}

TEST_F(Nails, TheSameQuantityAgainReplacesItsTarget) {
  Nail nail = edit->nail("ball", 0.5);
  nail.position(within(0.1, 0.3), any, any).position({1, 2, 3});
  ASSERT_EQ(only().targets.size(), 1u);
  EXPECT_EQ(target().value, (Numbers{1, 2, 3}));
  EXPECT_TRUE(target().min.empty());
  nail.point({1, 0, 0}, {1, 1, 1}).point({2, 0, 0}, {2, 2, 2}).point({1, 0, 0}, any, any, 5);
  ASSERT_EQ(only().targets.size(), 3u);
  EXPECT_EQ(shown(target(1).value), (Numbers{99, 99, 5}));
}

TEST_F(Nails, AreSeenFromOtherBodiesAndKeepToRegions) {
  edit->nail("ball", between(0.2, 0.8))
      .relativeTo("other")
      .position({1, 0, 0})
      .avoid({.shape = Sphere{0.3}, .position = {1, 0, 0}})
      .inside({.shape = Box{{4, 4, 4}}, .during = {{0.1, 0.9}}, .margin = 0.2});
  EXPECT_EQ(only().at.span, (TimeSpan(0.2, 0.8)));
  EXPECT_EQ(only().relative_to, "other");
  ASSERT_EQ(only().regions.size(), 2u);
  EXPECT_EQ(only().regions[0].side, Region::Side::avoid);
  EXPECT_EQ(std::get<Sphere>(only().regions[0].shape).radius, 0.3);
  EXPECT_EQ(only().regions[1].side, Region::Side::inside);
  EXPECT_EQ(only().regions[1].margin, 0.2);
  const EditProblem problem = problemOf(*edit);
  EXPECT_EQ(problem.constraints.size(), 3 + 1 + 6);
  EXPECT_EQ(problem.times(), 1);
}

TEST_F(Nails, OnesThatAreGoneSaySo) {
  Nail nail = edit->nail("ball", 0.5).position({1, 2, 3});
  edit->unnail(nail);
  EXPECT_THROW(nail.relativeTo("other"), InputError);
  EXPECT_THROW(nail.avoid({}), InputError);
  EXPECT_THROW(nail.time(1), InputError);
}

// A result tells the ranges, and the time that it chose.
TEST_F(Nails, ResultsTellRangesAndTimes) {
  edit->vary(velocity("ball"));
  edit->nail("ball", between(0.2, 0.8)).position(1, any, within(1.2, 1.25));
  edit->nail("ball", 0.9).position(any, any, atMost(1));
  const EditResult r = edit->solve();
  ASSERT_TRUE(r.solved()) << r.message;
  ASSERT_EQ(r.times.size(), 1u);
  EXPECT_EQ(r.times[0].constraint, 0);
  EXPECT_EQ(r.times[0].name, "'ball' between 0.2 s and 0.8 s");
  EXPECT_EQ(r.times[0].from, 0.2);
  EXPECT_EQ(r.times[0].to, 0.8);
  EXPECT_TRUE(r.times[0].time >= 0.2 && r.times[0].time <= 0.8) << r.times[0].time;
  ASSERT_EQ(r.residuals.size(), 3u);
  EXPECT_EQ(r.residuals[0].target, 1);
  EXPECT_EQ(r.residuals[0].lower, 1);
  EXPECT_EQ(r.residuals[0].upper, 1);
  EXPECT_TRUE(std::isnan(r.residuals[1].target));
  EXPECT_EQ(r.residuals[1].lower, 1.2);
  EXPECT_EQ(r.residuals[1].upper, 1.25);
  EXPECT_TRUE(r.residuals[1].value >= 1.2 - 1e-9 && r.residuals[1].value <= 1.25 + 1e-9) << r.residuals[1].value;
  EXPECT_EQ(r.residuals[2].lower, -carom::kInfinity);
  EXPECT_EQ(r.residuals[2].upper, 1);
  const Vec3 place = r.motion.stateAt("ball", r.times[0].time).position;
  EXPECT_EQ(place.x(), r.residuals[0].value);
  EXPECT_EQ(place.z(), r.residuals[1].value);
}

}  // namespace
}  // namespace carom
