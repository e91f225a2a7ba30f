// SPDX-License-Identifier: MIT
// Impacts that the start lacks: hits, required sequences, rows at an impact that does not come yet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom::tests {
namespace {

Body ball(const std::string& name, const Vec3& place) {
  Body body;
  body.name = name;
  body.material = "resin";
  body.shape = Sphere{0.03};
  body.mass = 0.2;
  body.position = place;
  return body;
}

/// A table of 2 m by 1 m, seen from above, without gravity and friction: the cue ball runs along x and meets nothing but
/// rails.
Scene table() {
  Scene scene;
  scene.gravity = Vec3::Zero();
  Material resin;
  resin.name = "resin", resin.elasticity = 0.95, resin.friction = 0;
  scene.materials = {resin};
  const struct {
    const char* name;
    Vec3 inwards;
    double distance;
  } rails[] = {{"rail_east", -Vec3::UnitX(), 1},
               {"rail_west", Vec3::UnitX(), 1},
               {"rail_north", -Vec3::UnitY(), 0.5},
               {"rail_south", Vec3::UnitY(), 0.5}};
  for (const auto& rail : rails) {
    Body body;
    body.name = rail.name;
    body.fixed = true;
    body.material = "resin";
    body.shape = Plane{rail.inwards, -rail.distance};
    scene.bodies.push_back(body);
  }
  scene.bodies.push_back(ball("cue", {-0.5, 0, 0}));
  scene.bodies.back().velocity = Vec3(1.5, 0, 0);
  scene.bodies.push_back(ball("red", {0.2, 0.2, 0}));
  scene.bodies.push_back(ball("yellow", {0.3, -0.3, 0}));
  return scene;
}

int indexOf(const Motion& motion, const std::string& body) { return bodyIndex(*motion.scene, body); }

/// Names of those that the cue ball meets, in order.
std::vector<std::string> metByCue(const Motion& motion) {
  std::vector<std::string> met;
  const int cue = indexOf(motion, "cue");
  for (const Event& event : motion.events)
    for (const Contact& c : event.contacts)
      if (c.a == cue || c.b == cue)
        met.push_back(motion.scene->bodies[static_cast<std::size_t>(c.a == cue ? c.b : c.a)].name);
  return met;
}

struct Table {
  Scene scene = table();
  OdeContacts contacts{scene};
  Edit edit{scene, contacts, 4};
  Table() { edit.vary(velocity("cue").only({"x", "y"})); }
};

TEST(RequiredImpacts, AHitFromAMiss) {
  Table t;
  t.edit.hit("cue", "yellow");
  const EditResult r = t.edit.solve();
  ASSERT_EQ(r.status, EditStatus::solved_sequence_changed) << r.message;
  EXPECT_TRUE(r.motion.findImpact(indexOf(r.motion, "cue"), 1, indexOf(r.motion, "yellow"))) << r.message;
  EXPECT_TRUE(r.residuals.empty());
}

// Of all velocities v' that hit, the nearest to v sends the ball along a tangent: |v' - v| = |v| sin(a), with a the angle
// between v and the line on which the balls just touch. On one side of it the ball misses.
TEST(RequiredImpacts, TheSmallestHitJustTouches) {
  for (const bool reversed : {false, true}) {
    Table t;
    Scene scene = t.scene;
    scene.bodies = {scene.bodies[4], scene.bodies[5]};  // cue and red, without rails
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, 4);
    edit.vary(velocity("cue").only({"x", "y"}));
    edit.hit("cue", "red");
    const EditResult r = edit.solve({.graze_margin = 0});
    ASSERT_TRUE(r.solved()) << r.message;
    const Vec3 v(1.5, 0, 0), way = Vec3(0.2, 0.2, 0) - Vec3(-0.5, 0, 0);
    const double a = std::atan2(way.y(), way.x()) - std::asin(2 * 0.03 / way.norm());
    const double least = v.norm() * std::sin(a);
    const double change = (r.motion.stateAt("cue", 0).velocity - v).norm();
    EXPECT_TRUE(change >= least) << change << " and " << least;
    EXPECT_TRUE(change <= (1 + 1e-5) * least) << change << " and " << least;
    const EditResult inside = edit.solve();
    ASSERT_TRUE(inside.solved()) << inside.message;
    EXPECT_GE(inside.certificate.signature_radius, 5e-5) << inside.message;
    EXPECT_LE(inside.objective, 1.01 * r.objective);
  }
}

// A hit that may come no later than the end T: of all v' for which |v' T - way| is at most the sum of the radii, the nearest to v
// has v' T where the line from v T to `way` enters that circle.
TEST(RequiredImpacts, TheSmallestHitInTimeComesAtTheEnd) {
  for (const bool reversed : {false, true}) {
    Scene scene = table();
    scene.bodies = {scene.bodies[4], scene.bodies[5]};  // cue and red, without rails
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    OdeContacts contacts(scene);
    constexpr double kEnd = 0.3;
    Edit edit(scene, contacts, kEnd);
    edit.vary(velocity("cue").only({"x", "y"}));
    edit.hit("cue", "red");
    const EditResult r = edit.solve({.graze_margin = 0});
    ASSERT_TRUE(r.solved()) << r.message;
    const Vec3 v(1.5, 0, 0), way = Vec3(0.2, 0.2, 0) - Vec3(-0.5, 0, 0);
    const double least = ((v * kEnd - way).norm() - 2 * 0.03) / kEnd;
    const double change = (r.motion.stateAt("cue", 0).velocity - v).norm();
    EXPECT_TRUE(change >= (1 - 1e-12) * least) << change << " and " << least;
    EXPECT_TRUE(change <= (1 + 1e-5) * least) << change << " and " << least;
  }
}

TEST(RequiredImpacts, AHitDuringASpan) {
  Table t;
  t.edit.hit("cue", {.with = "red", .during = {{0.9, 1.0}}});
  const EditResult r = t.edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  const auto event = r.motion.findImpact(indexOf(r.motion, "cue"), 1, indexOf(r.motion, "red"));
  ASSERT_TRUE(event);
  const double time = r.motion.events[static_cast<std::size_t>(*event)].time;
  EXPECT_GE(time, 0.9 - 1e-9);
  EXPECT_LE(time, 1.0 + 1e-9);
  ASSERT_EQ(r.residuals.size(), 1u);
  EXPECT_EQ(r.residuals[0].component, "time");
}

TEST(RequiredImpacts, AHitAfterAnother) {
  Table t;
  t.edit.hit("cue", {.with = "yellow", .after = ImpactOf{"cue", 1, "rail_east"}});
  const EditResult r = t.edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  const int cue = indexOf(r.motion, "cue");
  const auto rail = r.motion.findImpact(cue, 1, indexOf(r.motion, "rail_east"));
  const auto last = r.motion.world_lines[static_cast<std::size_t>(cue)].events;
  bool hit_after = false;
  ASSERT_TRUE(rail);
  for (int e : last)
    if (e > *rail && r.motion.events[static_cast<std::size_t>(e)].meets(cue, indexOf(r.motion, "yellow"))) hit_after = true;
  EXPECT_TRUE(hit_after);
}

TEST(RequiredImpacts, ARowAtAnImpactThatDoesNotComeYet) {
  Table t;
  t.edit.nail("cue", nthImpact(1, "yellow")).time(0.8);
  const EditResult r = t.edit.solve();
  ASSERT_EQ(r.status, EditStatus::solved_sequence_changed) << r.message;
  const auto event = r.motion.findImpact(indexOf(r.motion, "cue"), 1, indexOf(r.motion, "yellow"));
  ASSERT_TRUE(event);
  EXPECT_NEAR(r.motion.events[static_cast<std::size_t>(*event)].time, 0.8, 1e-9);
}

TEST(RequiredImpacts, ThreeCushions) {
  Table t;
  t.edit.sequence({"cue red", "cue rail*", "cue rail*", "cue rail*", "cue yellow"});
  const EditResult r = t.edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  const std::vector<std::string> met = metByCue(r.motion);
  ASSERT_GE(met.size(), 5u);
  EXPECT_EQ(met[0], "red");
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(met[i].substr(0, 4), "rail") << i;
  EXPECT_EQ(met[4], "yellow");
}

TEST(RequiredImpacts, WhateverLiesBetween) {
  Table t;
  t.edit.sequence({"cue yellow", "...", "cue red"});
  const EditResult r = t.edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  std::vector<std::string> met = metByCue(r.motion);
  std::erase_if(met, [](const std::string& name) { return name.starts_with("rail"); });  // nobody speaks of them
  ASSERT_GE(met.size(), 2u);
  EXPECT_EQ(met[0], "yellow");
  EXPECT_NE(std::find(met.begin() + 1, met.end(), "red"), met.end());
}

TEST(RequiredImpacts, TheAnswerDoesNotDependOnThreads) {
  Table t;
  t.edit.hit("cue", "yellow");
  EditOptions one, many;
  one.threads = 1, many.threads = 3;
  const EditResult a = t.edit.solve(one), b = t.edit.solve(many);
  ASSERT_TRUE(a.solved());
  for (std::size_t i = 0; i < a.changed.size(); ++i) EXPECT_EQ(a.changed[i].after, b.changed[i].after);
}

TEST(RequiredImpacts, WithBodiesInReverseOrder) {
  Scene scene = table();
  std::reverse(scene.bodies.begin(), scene.bodies.end());
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 4);
  edit.vary(velocity("cue").only({"x", "y"}));
  edit.sequence({"cue rail*", "cue yellow"});
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  const std::vector<std::string> met = metByCue(r.motion);
  ASSERT_GE(met.size(), 2u);
  EXPECT_EQ(met[0].substr(0, 4), "rail");
  EXPECT_EQ(met[1], "yellow");
}

TEST(RequiredImpacts, WhatCannotBeHitIsToldWithHowNearItCame) {
  Table t;
  Edit edit(t.scene, t.contacts, 0.3);
  edit.vary(velocity("cue").only({"x"}).within(1, 2));
  edit.hit("cue", "yellow");
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::not_converged);
  EXPECT_NE(r.message.find("The nearest that 'cue' and 'yellow' came"), std::string::npos) << r.message;
}

TEST(RequiredImpacts, AnImpactThatDoesNotComeIsLookedForUnlessTheSequenceStays) {
  const Scene scene = testing_scenes::floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball").within(-9, 9));
  edit.nail("ball", nthImpact(3, "wall")).position({any, any, 1});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::not_converged);
  EXPECT_NE(r.message.find("mpact 3 with 'wall'"), std::string::npos) << r.message;
  EditOptions options;
  options.sequence = SequencePolicy::stay;
  const EditResult stays = edit.solve(options);
  EXPECT_EQ(stays.status, EditStatus::bad_start);
  EXPECT_NE(stays.message.find("mpact 3 with 'wall'"), std::string::npos) << stays.message;
}

/// A tumbling box above a floor.
struct Tumble {
  Scene scene;
  OdeContacts contacts;
  Edit edit;
  explicit Tumble(bool reversed = false) : scene(sceneOf(reversed)), contacts(scene), edit(scene, contacts, 1) {
    edit.vary(velocity("box"), angularVelocity("box"));
  }
  static Scene sceneOf(bool reversed) {
    Scene scene = testing_scenes::thrownBox();
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    return scene;
  }
};

/// Of the first impact, "vertex +x-y-z on face", seen from the box.
std::string featuresOfFirst(const Motion& motion) {
  const Contact& c = motion.events.front().contacts.front();
  const std::string text = motion.geometry->describe(c.a, c.b, c.features);
  const std::size_t on = text.find(" on ");
  if (c.a == bodyIndex(*motion.scene, "box")) return text;
  return text.substr(on + 4) + " on " + text.substr(0, on);
}

TEST(RequiredImpacts, FeaturesThatMeet) {
  for (const bool reversed : {false, true}) {
    Tumble start(reversed);
    const std::string was = featuresOfFirst(simulate(start.scene, start.contacts, 1));
    Tumble same(reversed);
    same.edit.sequence({"box floor (" + was + ")"});
    const EditResult unchanged = same.edit.solve();
    EXPECT_EQ(unchanged.status, EditStatus::solved) << unchanged.message;
    EXPECT_EQ(unchanged.iterations, 0);
    for (const std::string wish : {"vertex +x-y-z", "vertex -x+y+z"}) {
      Tumble other(reversed);
      other.edit.sequence({"floor box (* on " + wish + ")"});
      const EditResult r = other.edit.solve();
      ASSERT_TRUE(r.solved()) << wish << ": " << r.message;
      EXPECT_TRUE(featuresOfFirst(r.motion).starts_with(wish + " on ")) << featuresOfFirst(r.motion);
    }
  }
}

void expectRefused(const Edit& edit, const std::string& place, const std::string& found) {
  try {
    edit.solve();
    FAIL() << "not refused: " << place;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(place), std::string::npos) << what;
    EXPECT_NE(what.find(found), std::string::npos) << what;
  }
}

TEST(RequiredImpacts, BadOnesAreRefused) {
  const auto with = [](const auto& ask, const std::string& place, const std::string& found) {
    Table t;
    ask(t.edit);
    expectRefused(t.edit, place, found);
  };
  with([](Edit& e) { e.hit("cue", "blue"); }, "/constraints/0/hits", "'blue'");
  with([](Edit& e) { e.hit("blue", "cue"); }, "/constraints/0/body", "'blue'");
  with([](Edit& e) { e.hit("cue", "cue"); }, "/constraints/0/hits", "another body");
  with([](Edit& e) { e.hit("cue", {.with = "red", .during = {{1, 0.5}}}); }, "/constraints/0/during/1", "0.5");
  with([](Edit& e) { e.hit("cue", {.with = "red", .after = ImpactOf{"cue", 0}}); }, "/constraints/0/after/impact", "0");
  with([](Edit& e) { e.hit("cue", {.with = "red", .before = ImpactOf{"green"}}); }, "/constraints/0/before/body", "'green'");
  with([](Edit& e) { e.sequence({"cue red", "cue"}); }, "/constraints/0/sequence/1", "'cue'");
  with([](Edit& e) { e.sequence({"cue bl*"}); }, "/constraints/0/sequence/0", "two bodies");
  with([](Edit& e) { e.sequence({"..."}); }, "/constraints/0/sequence", "found no impact");
  with([](Edit& e) { e.sequence({"cue red (ball)"}); }, "/constraints/0/sequence/0", "the features 'ball'");
  with([](Edit& e) { e.sequence({"cue blue (ball on *)"}); }, "/constraints/0/sequence/0", "two bodies");
}

}  // namespace
}  // namespace carom::tests
