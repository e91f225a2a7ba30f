// SPDX-License-Identifier: MIT
// What an answer says beside its numbers: shares of the cost, which alternatives are much dearer, how the impacts of the
// whole motions differ, and an edit that is stopped anywhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/problem/controls/natural_scales.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"
#include "tests/editing/stopping_contacts.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;
using namespace testing_sessions;
using Kind = SequenceChange::Kind;

/// A ball that bounces twice in two seconds.
Scene bouncing() {
  Scene scene;
  scene.materials = {material("rubber", 0.8, 0.3)};
  scene.bodies = {fixedPlane("floor", "rubber", Vec3::UnitZ(), 0),
                  ball("ball", "rubber", 0.1, Vec3(0, 0, 1.5), Vec3(1, 0, 0))};
  return scene;
}

TEST(Shares, AreTheCostOfEachNumber) {
  const Scene scene = bouncing();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.2);
  edit.vary(velocity("ball").weighted(3), elasticity("rubber"));
  edit.nail("ball", 1.1).position({1.4, 0.1, 0.9});
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.met) << r.message;
  const double velocity_scale = naturalScales(scene, 1).velocity / 3;
  std::vector<double> costs;
  for (const ChangedNumber& number : r.changed) {
    const double scale = number.control == 0 ? velocity_scale : elasticityScale(0.8);
    costs.push_back(std::pow((number.after - number.before) / scale, 2));
  }
  double all = 0, sum = 0;
  for (const double cost : costs) all += cost;
  EXPECT_NEAR(all / 2, r.objective, 1e-12 * all);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    EXPECT_NEAR(r.changed[i].share, costs[i] / all, 1e-12) << r.changed[i].name;
    sum += r.changed[i].share;
  }
  EXPECT_NEAR(sum, 1, 1e-14);
}

TEST(Shares, AreZeroWhereNothingChanged) {
  const Scene scene = bouncing();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.2);
  edit.vary(velocity("ball"));
  edit.nail("ball", 1.1).position(simulate(scene, contacts, 1.2).stateAt("ball", 1.1).position);
  const EditResult r = edit.solve();
  EXPECT_TRUE(r.met && r.solved()) << r.message;
  for (const ChangedNumber& number : r.changed) EXPECT_EQ(number.share, 0);
}

// A throw that nearly clears a wall: over it the target is near, with a bounce before it far.
TEST(Alternatives, ThatAreMuchDearerComeLast) {
  Scene scene = bouncing();
  Body wall;
  wall.name = "wall", wall.fixed = true, wall.material = "rubber";
  wall.shape = Box{Vec3(0.1, 2, 1)}, wall.position = Vec3(2, 0, 0.5);
  scene.materials[0].elasticity = 0.7;
  scene.bodies = {scene.bodies[0], wall, ball("ball", "rubber", 0.05, Vec3(0, 0, 0.6), Vec3(4.0232, 0, 2.5684))};
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.2);
  edit.vary(velocity("ball"));
  edit.nail("ball", 1.2).position({3, 0, 0.4});
  EditOptions options;
  options.alternatives = 4;
  const EditResult r = edit.solve(options);
  ASSERT_TRUE(r.solved()) << r.message;
  ASSERT_FALSE(r.alternatives.empty());
  bool dearer = false;
  double least = r.objective;
  for (const EditAlternative& other : r.alternatives) {
    EXPECT_EQ(other.much_dearer, other.objective > kMuchDearer * r.objective);
    EXPECT_TRUE(other.much_dearer || !dearer) << "after one that is much dearer";
    EXPECT_GE(other.objective, least);
    dearer = other.much_dearer, least = other.objective;
  }
  EXPECT_TRUE(dearer) << "none of " << r.alternatives.size() << ", best " << r.objective << ", last "
                      << r.alternatives.back().objective;
}

Motion falling(double height, double duration) {
  Scene scene = bouncing();
  scene.bodies[1].position.z() = height;
  OdeContacts contacts(scene);
  return simulate(scene, contacts, duration);
}

TEST(WholeSequenceChanges, TellWhatPassedTheLastConstraint) {
  const Motion lower = falling(1.5, 1.8), higher = falling(1.8, 1.8);
  ASSERT_EQ(lower.events.size(), 2u);
  ASSERT_EQ(lower.signature(), higher.signature());
  EXPECT_TRUE(wholeSequenceChanges(lower, 1, higher, 1).empty());
  const auto later = wholeSequenceChanges(lower, 1, higher, 0), earlier = wholeSequenceChanges(higher, 0, lower, 1);
  ASSERT_EQ(later.size(), 1u);
  EXPECT_EQ(later[0].kind, Kind::passed);
  EXPECT_TRUE(later[0].matters);
  EXPECT_EQ(later[0].sentence,
            "The 1st impact of 'floor' and 'ball', which was at 0.534 s, now comes after the last constraint, at 0.589 s.");
  ASSERT_EQ(earlier.size(), 1u);
  EXPECT_EQ(earlier[0].sentence,
            "The 1st impact of 'floor' and 'ball', which was at 0.589 s, now comes before the last constraint, at 0.534 s.");
}

TEST(WholeSequenceChanges, MarkWhatComesAfterTheLastConstraint) {
  const Motion two = falling(1.5, 1.8), one = falling(1.5, 1);
  const auto went = wholeSequenceChanges(two, 1, one, 1), held = wholeSequenceChanges(two, 2, one, 1);
  ASSERT_EQ(went.size(), 1u);
  EXPECT_EQ(went[0].kind, Kind::went);
  EXPECT_FALSE(went[0].matters);
  ASSERT_EQ(held.size(), 1u);
  EXPECT_TRUE(held[0].matters);
}

// What came and went is the difference of what both motions show, and says whether the held impacts are others.
TEST(WholeSequenceChanges, AgreeWithTheListsOfAnAnswer) {
  const Scene scene = bouncing();
  OdeContacts contacts(scene);
  const Motion before = simulate(scene, contacts, 3);
  for (const double height : {0.2, 0.7, 1.6, 2.2}) {
    Edit edit(scene, contacts, 3);
    edit.vary(velocity("ball"));
    edit.nail("ball", 1.0).position({1.2, 0.1, height});
    const EditResult r = edit.solve();
    ASSERT_TRUE(r.met) << r.message;
    int more = 0;
    bool matters = false;
    for (const SequenceChange& change : r.sequence_changes) {
      more += (change.kind == Kind::came) - (change.kind == Kind::went);
      matters = matters || change.matters;
      EXPECT_EQ(r.message.find(change.sentence) != std::string::npos, change.matters) << change.sentence;
    }
    EXPECT_EQ(static_cast<int>(r.sequence_after.size()) - static_cast<int>(r.sequence_before.size()), more);
    EXPECT_EQ(r.signature_changed, matters);
    EXPECT_EQ(r.status, matters ? EditStatus::solved_sequence_changed : EditStatus::solved);
    EXPECT_EQ(r.sequence_before, before.describeEvents());
  }
}

// A stop that comes with any motion of the edit, up to the last one of its report.
TEST(CancelledEdit, IsVerifiedWheneverItIsStopped) {
  const Scene scene = bouncing();
  OdeContacts plain(scene);
  StopAfter stop;
  StoppingContacts contacts(plain, stop);
  const auto solve = [&](int motions) {
    Edit edit(scene, contacts, 1.2);
    edit.vary(velocity("ball"), elasticity("rubber"));
    edit.nail("ball", 1.1).position({1.3, 0.1, 0.9});
    EditOptions options;
    options.threads = 1;
    options.alternatives = 2;
    options.stop = stop.set(motions);
    return edit.solve(options);
  };
  const EditResult whole = solve(-1);
  ASSERT_TRUE(whole.solved()) << whole.message;
  const int all = stop.begun;
  ASSERT_GT(all, 20);
  int met = 0;
  for (int motions = 0; motions < all; motions += motions < all - 12 ? 1 + motions / 4 : 1) {
    const EditResult r = solve(motions);
    EXPECT_EQ(r.status, EditStatus::cancelled) << motions << " of " << all << ": " << r.message;
    EXPECT_EQ(r.motion.status, MotionStatus::complete);
    EXPECT_EQ(r.met, r.scaled_residual <= 1e-9) << motions;
    EXPECT_NE(r.message.find("cancelled"), std::string::npos) << r.message;
    EXPECT_EQ(r.motion.signature(), simulate(r.scene, plain, 1.2).signature());
    met += r.met;
    EXPECT_TRUE(!r.met || r.objective >= whole.objective * (1 - 1e-9)) << motions;
  }
  EXPECT_GT(met, 0);
}

// With `abandon` there is no answer, and no further motion begins, with whatever motion the stop comes.
TEST(AbandonedEdit, EndsWithTheMotionThatIsSimulated) {
  const Scene scene = bouncing();
  OdeContacts plain(scene);
  StopAfter stop;
  StoppingContacts contacts(plain, stop);
  Edit edit(scene, contacts, 1.2);
  edit.vary(velocity("ball"), elasticity("rubber"));
  edit.nail("ball", 1.1).position({1.3, 0.1, 0.9});
  EditOptions options;
  options.threads = 1;
  options.alternatives = 2;
  options.abandon = true;
  options.stop = stop.set(-1);
  ASSERT_TRUE(edit.solve(options).solved());
  const int all = stop.begun;
  ASSERT_GT(all, 20);
  for (int motions = 0; motions < all; motions += motions < all - 12 ? 1 + motions / 4 : 1) {
    options.stop = stop.set(motions);
    EXPECT_THROW(edit.solve(options), EditAbandoned) << motions << " of " << all;
    EXPECT_EQ(stop.begun, motions + 1);
  }
}

TEST(CancelledEdit, ByItsCallbackToo) {
  const Scene scene = bouncing();
  OdeContacts contacts(scene);
  int met = 0;
  for (int last = 1; last < 60; last += 4) {
    Edit edit(scene, contacts, 1.2);
    edit.vary(velocity("ball"), elasticity("rubber"));
    edit.nail("ball", 1.1).position({1.3, 0.1, 0.9});
    EditOptions options;
    options.progress = [&](const EditProgress& p) { return p.iteration < last; };
    const EditResult r = edit.solve(options);
    if (r.solved()) break;
    EXPECT_EQ(r.status, EditStatus::cancelled) << r.message;
    EXPECT_EQ(r.met, r.scaled_residual <= 1e-9);
    EXPECT_TRUE(r.alternatives.empty());
    met += r.met;
  }
  EXPECT_GT(met, 0);
}

}  // namespace
}  // namespace carom
