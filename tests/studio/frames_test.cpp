// SPDX-License-Identifier: MIT
// Frames as a page decodes them hold the motion and the scene that they were made of.
#include "examples/support/project_file.h"
#include "studio/frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/studio/decoded_frame.h"
#include "tests/support/compare.h"
#include "tests/support/page_pose.h"
#include "tests/support/scenes.h"

namespace carom::studio_test {
namespace {

using namespace studio;

Motion exampleMotion(const std::string& name) {
  const Document document = readDocument(projectFile("examples/scenes/") + name + ".json");
  OdeContacts contacts(document.scene);
  return simulate(document.scene, contacts, document.duration);
}

int bodyCount(const Motion& motion) { return static_cast<int>(motion.scene->bodies.size()); }

template <class Function>
void expectRefused(Function call, const std::string& words) {
  try {
    call();
    ADD_FAILURE() << "was not refused: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(MotionFrame, HoldsTheMotion) {
  for (const char* name : {"hat-on-coatrack", "mug-on-mark", "curling", "putt"}) {
    const Motion motion = exampleMotion(name);
    const DecodedFrame frame(motionFrame(viewOf(motion)));
    EXPECT_EQ(frame.header.at("type"), "motion");
    EXPECT_EQ(frame.header.at("end").get<double>(), motion.end);
    EXPECT_EQ(frame.header.at("status"), nameOf(motion.status));
    EXPECT_EQ(frame.header.at("message"), motion.message);
    EXPECT_EQ(frame.header.at("gravity").at(2).get<double>(), motion.scene->gravity.z());
    ASSERT_EQ(static_cast<int>(frame.header.at("tracks").size()), bodyCount(motion));
    test::Random random(5);
    for (int body = 0; body < bodyCount(motion); ++body) {
      const DisplayTrack track = frame.track(body);
      EXPECT_TRUE(track == displayTrack(motion, body)) << name;
      for (int i = 0; i < 50; ++i) {
        const double t = random.in(0, motion.end);
        const BodyState state = motion.stateAt(body, t);
        const test::PagePose pose = test::pagePoseAt(track, t);
        EXPECT_TRUE((pose.center - state.position - state.orientation * track.center).norm() <= 1e-9) << name << t;
        EXPECT_TRUE(pose.orientation.angularDistance(state.orientation) <= 2e-3) << name << t;
      }
    }
  }
}

// Whatever the page takes hold of by its n-th impact is that impact for the session.
TEST(MotionFrame, ImpactsAreThoseThatPeopleCount) {
  for (const char* name : {"hat-on-coatrack", "mug-on-mark", "billiard-three-balls", "dice"}) {
    const Motion motion = exampleMotion(name);
    const DecodedFrame frame(motionFrame(viewOf(motion)));
    const nlohmann::json& impacts = frame.header.at("impacts");
    EXPECT_EQ(impacts.size(), motion.impacts) << name;
    std::vector<int> met(static_cast<std::size_t>(bodyCount(motion)), 0);
    std::map<std::array<int, 2>, int> met_with;
    for (const nlohmann::json& impact : impacts) {
      const double time = impact.at("t").get<double>();
      const auto bodies = impact.at("bodies").get<std::vector<int>>(), nth = impact.at("nth").get<std::vector<int>>();
      ASSERT_EQ(bodies.size(), nth.size());
      ASSERT_GE(bodies.size(), 2u);
      for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (motion.scene->bodies[static_cast<std::size_t>(bodies[k])].fixed) {
          EXPECT_EQ(nth[k], 0);
          continue;
        }
        EXPECT_EQ(nth[k], ++met[static_cast<std::size_t>(bodies[k])]) << name << " at " << time;
        const auto event = motion.findImpact(bodies[k], nth[k]);
        ASSERT_TRUE(event.has_value());
        EXPECT_EQ(motion.events[static_cast<std::size_t>(*event)].time, time);
        EXPECT_EQ(nameOf(motion.events[static_cast<std::size_t>(*event)].mode), impact.at("mode"));
      }
      for (const auto& pair : impact.at("pairs").get<std::vector<std::array<int, 2>>>()) {
        const int n = ++met_with[pair];
        const int mover = motion.scene->bodies[static_cast<std::size_t>(pair[0])].fixed ? 1 : 0;
        const auto event = motion.findImpact(pair[static_cast<std::size_t>(mover)], n,
                                             pair[static_cast<std::size_t>(1 - mover)]);
        ASSERT_TRUE(event.has_value());
        EXPECT_EQ(motion.events[static_cast<std::size_t>(*event)].time, time) << name;
      }
      ASSERT_EQ(impact.at("point").size(), 3u);
    }
  }
}

TEST(MotionFrame, TheMiddleOfABallOnAFloorIsBelowIt) {
  const Body ball = test::makeBall("ball", 0.1, {1, 2, 1}), floor = test::makePlane("floor", Vec3::UnitZ(), 0);
  const Scene scene = test::makeScene({0, 0, -9.81}, 0.5, 0.3, {ball, floor});
  const DecodedFrame frame(motionFrame(viewOf(test::play(scene, 0.6))));
  ASSERT_EQ(frame.header.at("impacts").size(), 1u);
  const nlohmann::json& impact = frame.header["impacts"][0];
  EXPECT_EQ(impact.at("bodies"), nlohmann::json({0, 1}));
  EXPECT_EQ(impact.at("nth"), nlohmann::json({1, 0}));
  EXPECT_EQ(impact.at("pairs"), nlohmann::json::parse("[[0, 1]]"));
  const auto point = impact.at("point").get<std::array<double, 3>>();
  test::expectEntries(Vec3(point[0], point[1], point[2]), Vec3(1, 2, 0), 1e-12, "point");
}

TEST(MotionFrame, SaysWhoLiesOnWhom) {
  const Scene scene = test::makeScene({0, 0, -9.81}, 0, 0.5,
                                      {test::fixedBody(test::makeBox("floor", {9, 9, 1}, {0, 0, -0.5})), test::makeBox("left", {1, 1, 1}, {-0.6, 0, 0.5}),
                                       test::makeBox("right", {1, 1, 1}, {0.6, 0, 0.5}), test::makeBox("top", {1, 1, 1}, {0, 0, 1.5})});
  OdeContacts contacts(scene);
  const DecodedFrame frame(motionFrame(viewOf(simulate(scene, contacts, 1))));
  EXPECT_EQ(frame.header.at("contacts"), nlohmann::json::parse(R"([{"body": 1, "on": [0], "kind": "rest", "from": 0.0, "to": 1.0},
    {"body": 2, "on": [0], "kind": "rest", "from": 0.0, "to": 1.0}, {"body": 3, "on": [1, 2], "kind": "rest", "from": 0.0, "to": 1.0}])"));
}

TEST(MotionFrame, TracksThatTheReaderHasAreLeftOut) {
  const Motion motion = exampleMotion("billiard-three-balls");
  MotionView view = viewOf(motion);
  const MotionView sent = view;
  const DecodedFrame same(motionFrame(view, "{}", &sent));
  EXPECT_TRUE(same.header.at("tracks").empty());
  EXPECT_EQ(same.header.at("impacts").size(), motion.impacts);

  view.tracks[1].arcs[0].velocity.x() = std::nextafter(view.tracks[1].arcs[0].velocity.x(), 1e9);
  const DecodedFrame one(motionFrame(view, "{}", &sent));
  ASSERT_EQ(one.header.at("tracks").size(), 1u);
  EXPECT_TRUE(one.track(1) == view.tracks[1]);

  view.tracks.push_back(view.tracks[0]);  // a body more
  EXPECT_EQ(DecodedFrame(motionFrame(view, "{}", &sent)).header.at("tracks").size(), 2u);
}

TEST(MotionFrame, MembersOfItsSenderStandInTheHeader) {
  const MotionView view = viewOf(exampleMotion("two-balls"));
  const DecodedFrame frame(motionFrame(view, R"({"re": 18, "gesture": 4, "obstacle": {"kind": "none"}})"));
  EXPECT_EQ(frame.header.at("re"), 18);
  EXPECT_EQ(frame.header.at("gesture"), 4);
  EXPECT_EQ(frame.header.at("obstacle").at("kind"), "none");
  EXPECT_EQ(frame.header.at("type"), "motion");
  for (const char* members : {"", "[]", "3", "{", "{\"a\": 1} {}"})
    expectRefused([&] { motionFrame(view, members); }, "no JSON object");
  for (const char* member : {"type", "end", "status", "message", "gravity", "impacts", "contacts", "tracks"})
    expectRefused([&] { motionFrame(view, "{\"" + std::string(member) + "\": 1}"); }, member);
  for (const char* member : {"type", "count", "extent", "bodies"})
    expectRefused([&] { sceneFrame({}, "{\"" + std::string(member) + "\": 1}"); }, member);
}

TEST(SceneFrame, HoldsTheScene) {
  for (const char* name : {"hat-on-coatrack", "mug-on-mark", "dice", "putt"}) {
    const Motion motion = exampleMotion(name);
    const SceneView view = sceneViewOf(motion);
    const DecodedFrame frame(sceneFrame(view, R"({"re": 1})"));
    EXPECT_EQ(frame.header.at("type"), "scene");
    EXPECT_EQ(frame.header.at("count"), bodyCount(motion));
    ASSERT_EQ(static_cast<int>(frame.header.at("bodies").size()), bodyCount(motion));
    for (int body = 0; body < bodyCount(motion); ++body) {
      const nlohmann::json& json = frame.header["bodies"][static_cast<std::size_t>(body)];
      const Body& written = motion.scene->bodies[static_cast<std::size_t>(body)];
      EXPECT_EQ(json.at("body"), body);
      EXPECT_EQ(json.at("name"), written.name);
      EXPECT_EQ(json.at("fixed"), written.fixed);
      EXPECT_EQ(json.at("colour").get<std::string>().size(), 7u);
      EXPECT_EQ(json.at("pose").at("position").at(0).get<double>(), written.position.x());
      EXPECT_EQ(json.at("pose").at("orientation").at(0).get<double>(), written.orientation.w());
      if (kindOf(written.shape).endless) {
        EXPECT_EQ(json.at("plane").at("normal").size(), 3u);
        EXPECT_FALSE(json.contains("vertices") || json.contains("radius"));
        continue;
      }
      EXPECT_TRUE(frame.mesh(body) == displayMesh(*motion.scene, body, 1)) << name;
      const double radius = json.at("radius").get<double>();
      double most = 0;
      const DisplayMesh mesh = frame.mesh(body);
      for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
        most = std::max(most, (Vec3(mesh.positions[k], mesh.positions[k + 1], mesh.positions[k + 2]) -
                               (*motion.models)[static_cast<std::size_t>(body)].center).norm());
      EXPECT_LE(most, radius * (1 + 1e-6)) << name;
      EXPECT_GE(most, radius * 0.9) << name;
    }
    for (int i = 0; i < 3; ++i)
      EXPECT_LT(frame.header.at("extent").at("min").at(static_cast<std::size_t>(i)).get<double>(),
                frame.header.at("extent").at("max").at(static_cast<std::size_t>(i)).get<double>());
  }
}

TEST(SceneFrame, EqualMeshesShareTheirBlocks) {
  std::vector<Body> balls;
  for (int i = 0; i < 20; ++i) balls.push_back(test::makeBall("ball " + std::to_string(i), 0.1, {i * 1.0, 0, 0}));
  const auto sizeWith = [&](std::size_t count) {
    const std::vector<Body> some(balls.begin(), balls.begin() + static_cast<long>(count));
    return sceneFrame(sceneViewOf(test::play(test::makeScene({0, 0, 0}, 0.5, 0.3, some), 0.1))).size();
  };
  const std::size_t one = sizeWith(1), all = sizeWith(20);
  EXPECT_LT(all, one + 19 * 600);
}

TEST(SceneFrame, BodiesThatTheReaderHasAreLeftOut) {
  const Motion motion = exampleMotion("hat-on-coatrack");
  SceneView view = sceneViewOf(motion);
  const SceneView sent = view;
  EXPECT_TRUE(DecodedFrame(sceneFrame(view, "{}", &sent)).header.at("bodies").empty());
  int fixed = -1, moving = -1;
  for (int body = 0; body < bodyCount(motion); ++body)
    (view.bodies[static_cast<std::size_t>(body)].fixed ? fixed : moving) = body;
  ASSERT_GE(fixed, 0);
  ASSERT_GE(moving, 0);
  view.bodies[static_cast<std::size_t>(moving)].position.x() += 1;  // its track says where it is
  EXPECT_TRUE(DecodedFrame(sceneFrame(view, "{}", &sent)).header.at("bodies").empty());
  view.bodies[static_cast<std::size_t>(fixed)].position.x() += 1;
  const DecodedFrame moved(sceneFrame(view, "{}", &sent));
  ASSERT_EQ(moved.header.at("bodies").size(), 1u);
  EXPECT_EQ(moved.header["bodies"][0].at("body"), fixed);
  EXPECT_EQ(moved.header.at("count"), bodyCount(motion));
  view.bodies[static_cast<std::size_t>(moving)].mesh.positions[0] += 1;
  EXPECT_EQ(DecodedFrame(sceneFrame(view, "{}", &sent)).header.at("bodies").size(), 2u);
}

// Names come from files.
TEST(SceneFrame, AnyNameIsText) {
  Scene scene = test::makeScene({0, 0, 0}, 0.5, 0.3, {test::makeBall("\"<b>\xff\n", 0.1, {0, 0, 0})});
  const DecodedFrame frame(sceneFrame(sceneViewOf(test::play(scene, 0.1))));
  EXPECT_EQ(frame.header.at("bodies").at(0).at("name"), "\"<b>\xef\xbf\xbd\n");
}

}  // namespace
}  // namespace carom::studio_test
