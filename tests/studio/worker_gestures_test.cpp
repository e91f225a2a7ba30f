// SPDX-License-Identifier: MIT
// What gestures hold and free, and that nothing of one scene is left to the next.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "examples/support/project_file.h"
#include "studio/studio.h"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

struct WorkerGestures : testing::Test, WorkerTest {
  void SetUp() override {
    hello(1);
    worker->step({});
    received.take(1);
  }
};

TEST_F(WorkerGestures, NothingOfASceneIsLeftToTheNext) {
  hello(2);
  worker->step({});
  const Json first = lastOf(received.take(2), "scene");
  EXPECT_EQ(first["scene"], 1);
  folder.write("again.json", kTestScene);
  for (int k = 2; k <= 4; ++k) {
    const std::vector<Json> got = ask(1, {{"type", "open"}, {"path", k % 2 ? "bounce.json" : "again.json"}});
    for (const std::vector<Json>& page : {got, received.take(2)}) {
      const Json scene = lastOf(page, "scene"), motion = lastOf(page, "motion");
      ASSERT_FALSE(scene.is_null() || motion.is_null());
      EXPECT_EQ(scene["scene"], k);
      EXPECT_EQ(motion["scene"], k);
      EXPECT_EQ(scene["bodies"].size(), 3u) << "though they look like those before";
      EXPECT_EQ(motion["tracks"].size(), 3u) << "though they move like those before";
    }
  }
}

TEST_F(WorkerGestures, WhatNothingMovesIsFreed) {
  Json grab = kGrab;
  grab["free"] = true;
  std::vector<Json> got = ask(1, grab);
  EXPECT_FALSE(lastOf(got, "motion").contains("freed")) << "its velocity varies";
  EXPECT_EQ(lastOf(got, "state")["controls"].size(), 1u);
  ask(1, {{"type", "cancel"}, {"gesture", 1}});
  grab["body"] = "other", grab["gesture"] = 2, grab["at"] = 0.6;
  got = ask(1, grab);
  EXPECT_EQ(lastOf(got, "motion")["freed"], true) << "both met the floor, which moves nothing on";
  EXPECT_EQ(lastOf(got, "state")["controls"].size(), 3u);
  ask(1, {{"type", "cancel"}, {"gesture", 2}});
  grab["also_vary"] = Json::array({{{"vary", "velocity"}, {"body", "other"}}}), grab["id"] = 1000;
  EXPECT_THROW(readCommand(grab.dump()), MessageError) << "either the client says what varies, or it asks";
}

TEST_F(WorkerGestures, AnImpactIsConstrainedByItsContact) {
  const Json grab = {{"type", "grab"},
                     {"gesture", 1},
                     {"body", "ball"},
                     {"at", {{"impact", 1}, {"with", "floor"}}},
                     {"grip", {{"contact", true}, {"components", {"x", "y"}}}}};
  ask(1, grab);
  for (int seq = 1; seq <= 4; ++seq) {
    const double x = 0.8 + 0.1 * seq, y = 0.05 * seq;
    const Json motion = lastOf(
        ask(1, {{"type", "drag"}, {"gesture", 1}, {"seq", seq}, {"place", {x, y, 0}}}), "motion");
    EXPECT_TRUE(motion["reached"]);
    const Json impacts = motion["impacts"];
    const auto of_ball = [](const Json& impact) { return impact["bodies"] == Json{0, 1}; };
    const Json point = (*std::find_if(impacts.begin(), impacts.end(), of_ball))["point"];
    EXPECT_TRUE(std::abs(point[0].get<double>() - x) <= 1e-9 && std::abs(point[1].get<double>() - y) <= 1e-9) << point;
    EXPECT_TRUE(std::abs(point[2].get<double>()) <= 1e-9) << "where it is in height, the floor says";
  }
  ask(1, {{"type", "cancel"}, {"gesture", 1}});
  Json none = grab;
  none["gesture"] = 2, none["at"]["impact"] = 9;
  EXPECT_EQ(lastOf(ask(1, none), "error")["code"], "input");
}

/// What a contact may be off along the axis that is left to the surface: of the ball 2 %, of the pole 1 % of 2.3 m.
constexpr double kSheet = 0.02 * 0.1 + 0.01 * 2.3;

/// A ball of 0.1 m that falls on a lying pole of 0.3 m along y.
constexpr const char* kOnAPole = R"({
  "carom": 1, "duration": 0.6,
  "materials": { "felt": { "elasticity": 0.6, "friction": 0.3 } },
  "bodies": [
    { "name": "pole", "fixed": true, "material": "felt", "shape": { "capsule": { "radius": 0.3, "height": 4 } },
      "orientation": [0.7071067811865476, 0.7071067811865476, 0, 0] },
    { "name": "ball", "material": "felt", "mass": 0.2, "shape": { "sphere": { "radius": 0.1 } },
      "position": [0, 0, 1], "velocity": [0.2, 0.1, 0] }
  ],
  "controls": [ { "vary": "velocity", "body": "ball" } ]
})";

// The contact goes three quarters as far as the ball, and is another point of it each time.
TEST(WorkerContacts, GoToWhereTheHandWantsThem) {
  WorkerTest test(kOnAPole);
  test.hello(1);
  test.worker->step({});
  test.received.take(1);
  test.ask(1, {{"type", "grab"},
               {"gesture", 1},
               {"body", "ball"},
               {"at", {{"impact", 1}, {"with", "pole"}}},
               {"grip", {{"contact", true}, {"components", {"x", "y"}}}}});
  const auto point = [](const Json& motion) { return motion["impacts"][0]["point"]; };
  for (int seq = 1; seq <= 5; ++seq) {
    const double x = -0.25 + 0.1 * seq, y = 0.2 * seq, z = std::sqrt(0.09 - x * x);
    const Json motion =
        lastOf(test.ask(1, {{"type", "drag"}, {"gesture", 1}, {"seq", seq}, {"place", {x, y, z}}}), "motion");
    EXPECT_TRUE(motion["reached"]) << seq;
    EXPECT_LE(motion["distance"].get<double>(), 1e-6) << seq;
    const Json at = point(motion);
    EXPECT_TRUE(std::abs(at[0].get<double>() - x) <= 1e-6 && std::abs(at[1].get<double>() - y) <= 1e-6) << at;
  }
  // No contact is beyond the side of the pole: it stays near, and what is said is how far the contact is off.
  const Json beyond =
      lastOf(test.ask(1, {{"type", "drag"}, {"gesture", 1}, {"seq", 6}, {"place", {0.32, 1, 0}}}), "motion");
  EXPECT_FALSE(beyond["reached"]);
  const double x = point(beyond)[0].get<double>() - 0.32, y = point(beyond)[1].get<double>() - 1;
  const double z = std::max(0.0, std::abs(point(beyond)[2].get<double>()) - kSheet);
  EXPECT_LE(std::abs(beyond["distance"].get<double>() - std::hypot(x, y, z)), 1e-12);
  EXPECT_LE(beyond["distance"].get<double>(), 0.08) << "no farther than where it was";
  const std::vector<Json> released = test.ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 6}});
  const Json motion = lastOf(released, "motion");
  EXPECT_FALSE(motion["reached"]);
  EXPECT_LE(motion["distance"].get<double>(), 0.08);
  EXPECT_FALSE(motion["obstacle"]["sentence"].get<std::string>().empty());
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The hat's first impact with the coatrack, in the real session; the hand goes from the pole to a place on a peg.
struct PegOfCoatrack {
  const char* name;
  Vec3 place;                         ///< m, on the surface
  std::vector<std::string> components;  ///< held there, by the normal
};

// Half way up the upper pegs, and the tip of the first.
const PegOfCoatrack kPegs[] = {{"first", {-0.108, 0, 1.555}, {"x", "y"}},
                               {"tip of the first", {-0.1617, 0, 1.5857}, {"y", "z"}},
                               {"second", {0.054, -0.0935, 1.555}, {"x", "y"}},
                               {"third", {0.054, 0.0935, 1.555}, {"x", "y"}}};

TEST(WorkerContacts, GoFromThePoleOfACoatrackToItsPegs) {
  for (const PegOfCoatrack& peg : kPegs) {
    SCOPED_TRACE(peg.name);
    WorkerTest test(contentOf(projectFile("examples/scenes/hat-on-coatrack.json")), countedWork());
    test.hello(1);
    test.worker->step({});
    const Json first = lastOf(test.received.take(1), "motion");
    const Json from = first["impacts"][0]["point"];
    const Vec3 start(from[0], from[1], from[2]);
    test.ask(1, {{"type", "grab"},
                 {"gesture", 1},
                 {"body", "hat"},
                 {"at", {{"impact", 1}, {"with", "coatrack"}}},
                 {"grip", {{"contact", true}, {"components", {"y", "z"}}}}});
    for (int seq = 1; seq <= 6; ++seq) {
      const Vec3 to = start + (peg.place - start) * seq / 6;
      const std::vector<std::string> held = seq > 3 ? peg.components : std::vector<std::string>{"y", "z"};
      test.ask(1, {{"type", "drag"}, {"gesture", 1}, {"seq", seq}, {"place", {to.x(), to.y(), to.z()}}, {"components", held}});
    }
    const std::vector<Json> told = test.ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 6}, {"nail", true}});
    const Json motion = lastOf(told, "motion"), point = motion["impacts"][0]["point"];
    EXPECT_TRUE(motion["reached"]) << motion["obstacle"];
    EXPECT_TRUE((Vec3(point[0], point[1], point[2]) - peg.place).norm() <= 2e-4) << point;
    const Json nail = lastOf(told, "state")["nails"].back();
    EXPECT_TRUE(nail["met"] && nail["error"].get<double>() <= 1e-6) << nail;
    EXPECT_TRUE(nail["constraint"].contains("contact")) << nail;
  }
}

TEST(WorkerExamples, OpenAsCopiesThatAreNotSaved) {
  TestFolder place;
  place.write("bounce.json", kTestScene);
  WorkerTest test("", solvingWithoutClock(), place.path());
  test.workspace = std::make_unique<Workspace>(place.path());
  WorkerOptions options;
  options.solving = solvingWithoutClock();
  options.gallery = place.path();
  test.worker = std::make_unique<Worker>(
      test.mailbox, *test.workspace,
      Post{[&](SocketId to, const Outgoing& message) { test.received.add(to, message); }}, options);
  test.worker->openFirst("bounce.json");
  test.hello(1);
  test.worker->step({});
  const Json state = lastOf(test.received.take(1), "state");
  EXPECT_TRUE(state["path"].is_null());
  EXPECT_EQ(state["suggested"], "bounce-copy.json");
  EXPECT_FALSE(state["saved"]);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "save"}}), "error")["code"], "input") << "it has to be given a name";
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "open"}, {"path", "bounce.json"}}), "state")["path"], nullptr);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "save"}, {"path", "bounce-copy.json"}}), "saved")["path"], "bounce-copy.json");
  EXPECT_EQ(place.read("bounce.json"), kTestScene);
}

}  // namespace
}  // namespace carom::studio
