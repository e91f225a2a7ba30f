// SPDX-License-Identifier: MIT
// A path along a drawn curve: as near as may be, with the nails that are there, first answers soon, and nothing once it is stopped.
#include "studio/sketch.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>

#include "adjoint/simulate/simulate.h"
#include "editing/session.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

double processorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Where the centre of mass goes.
std::vector<Vec3> curveOf(const Motion& motion, int body, double from, double to) {
  std::vector<Vec3> places;
  for (int k = 0; k <= 40; ++k) {
    const BodyState state = motion.stateAt(body, from + (to - from) * k / 40);
    places.push_back(state.position + state.orientation * (*motion.models)[static_cast<std::size_t>(body)].center);
  }
  return places;
}

struct Sketched {
  std::shared_ptr<const Motion> first;
  SessionContent content;
  double first_after = 0, after = 0;
  double off = 0;  // m, the most, of the last answer
};

struct Sketches : testing::Test {
  Document document;
  std::stop_source stop;

  void read(const char* scene) { document = readDocument(projectFile("examples/scenes/") + scene + ".json"); }
  SessionSnapshot snapshot(std::vector<Control> controls, std::vector<Constraint> nails = {}) const {
    SessionSnapshot now;
    now.began = document.scene;
    now.content = {document.scene, document.duration, std::move(controls), {}};
    for (std::size_t i = 0; i < nails.size(); ++i) {
      now.nails.push_back(NailId{static_cast<int>(i)});
      now.content.nails.emplace_back(now.nails.back(), std::move(nails[i]));
    }
    return now;
  }
  double most(const SessionContent& content, const Motion& motion) const {
    double off = 0;
    for (const auto& [id, nail] : content.nails)
      if (nail.soft) off = std::max(off, nailStateIn(motion, nail, content.duration, 1e-9).error);
    return off;
  }
  Sketched draw(const SessionSnapshot& now, const Sketch& sketch) {
    OdeContacts contacts(now.content.scene);
    Sketched out;
    const double began = processorTime();
    const auto first = [&](const std::shared_ptr<const Motion>& motion) {
      out.first = motion;
      out.first_after = processorTime() - began;
    };
    out.content = fitSketch(now, contacts, sketch, first, stop.get_token());
    out.after = processorTime() - began;
    OdeContacts afresh(out.content.scene);
    out.off = most(out.content, simulate(out.content.scene, afresh, document.duration));
    std::printf("%s: first answer after %.3f s of the processor, within %.4g m, the last after %.3f s, within %.4g m\n", sketch.body.c_str(),
                out.first_after, out.first ? most(out.content, *out.first) : NAN, out.after, out.off);
    return out;
  }
  Motion thrown(int body, const Vec3& more) const {
    Scene scene = document.scene;
    scene.bodies[static_cast<std::size_t>(body)].velocity += more;
    OdeContacts contacts(scene);
    return simulate(scene, contacts, document.duration);
  }
};

TEST_F(Sketches, AHatGoesWhereAnotherThrowWouldTakeIt) {
  read("hat-on-coatrack");
  const int hat = bodyIndex(document.scene, "hat");
  const Sketch sketch{0, "hat", 0.05, curveOf(thrown(hat, {-0.3, 0.2, 0.3}), hat, 0.05, 0.45)};
  const Sketched got = draw(snapshot(document.controls), sketch);
  EXPECT_LE(got.off, 5e-3);
  ASSERT_TRUE(got.first);
  EXPECT_EQ(got.content.nails.size(), 10u);
  EXPECT_EQ(got.content.controls.size(), document.controls.size());
}

TEST_F(Sketches, AMugThatNoControlNamesIsThrownOtherwise) {
  read("mug");
  const int mug = bodyIndex(document.scene, "mug");
  const Sketch sketch{0, "mug", 0.02, curveOf(thrown(mug, {0.2, 0.1, 0.2}), mug, 0.02, 0.2)};
  const Sketched got = draw(snapshot({}), sketch);
  EXPECT_LE(got.off, 5e-3);
  ASSERT_TRUE(got.first);
  EXPECT_EQ(got.content.controls.size(), 2u);
}

TEST_F(Sketches, WhatCannotBeMetIsComeNearAndNailsHold) {
  read("hat-on-coatrack");
  const int hat = bodyIndex(document.scene, "hat");
  OdeContacts contacts(document.scene);
  const Motion now = simulate(document.scene, contacts, document.duration);
  Constraint nail{"hat", 0.3, {targetOf("position", WantedVector(now.stateAt(hat, 0.3).position))}};
  const std::vector<Vec3> path = curveOf(now, hat, 0.1, 0.5);
  std::vector<Vec3> line;
  for (std::size_t k = 0; k < path.size(); ++k)  // no body flies straight
    line.push_back(path.front() + (path.back() - path.front()) * static_cast<double>(k) / static_cast<double>(path.size() - 1));
  const Sketched got = draw(snapshot(document.controls, {nail}), {0, "hat", 0.1, line});
  EXPECT_GT(got.off, 1e-2);
  OdeContacts afresh(got.content.scene);
  const Motion fitted = simulate(got.content.scene, afresh, document.duration);
  EXPECT_TRUE(nailStateIn(fitted, nail, document.duration, 1e-9).met);
}

TEST_F(Sketches, WhatIsNoCurveIsRefused) {
  read("hat-on-coatrack");
  OdeContacts contacts(document.scene);
  const Motion now = simulate(document.scene, contacts, document.duration);
  const Vec3 a(0, 0, 1), b(0, 0, 2);
  EXPECT_THROW(sketchedNails(now, {0, "hat", 0.1, {a, a}}, ""), InputError);
  EXPECT_THROW(sketchedNails(now, {0, "hat", now.end, {a, b}}, ""), InputError);
  EXPECT_THROW(sketchedNails(now, {0, "coatrack", 0.1, {a, b}}, ""), InputError);
  EXPECT_THROW(sketchedNails(now, {0, "nobody", 0.1, {a, b}}, ""), InputError);
}

struct AskedForAPath : testing::Test, WorkerTest {
  Json state;

  void SetUp() override {
    hello(1);
    worker->step({});
    state = lastOf(received.take(1), "state");
  }
  Json sketch() const {
    return {{"type", "sketch"}, {"rev", state["rev"]}, {"body", "ball"}, {"from", 0.05}, {"places", {{0.05, 0, 1}, {0.2, 0, 1.1}, {0.3, 0.05, 1}}}};
  }
};

TEST_F(AskedForAPath, TheFirstAnswerIsShownAndTheLastIsOneStep) {
  std::vector<Json> all = ask(1, sketch());
  while (lastOf(all, "sketch").is_null() || lastOf(all, "sketch")["more"] == true) {
    worker->step({});
    for (Json& message : received.take(1)) all.push_back(std::move(message));
  }
  const Json kept = lastOf(all, "state");
  EXPECT_EQ(lastOf(all, "sketch")["message"], "");
  EXPECT_EQ(lastOf(all, "sketch")["re"], id);
  ASSERT_EQ(kept["nails"].size(), state["nails"].size() + 10) << kept.dump();
  EXPECT_EQ(kept["undo"], "sketch of 'ball'");
  const std::vector<Json> removed = ask(1, {{"type", "unnail"}, {"sketch", "sketch 1"}});
  EXPECT_EQ(lastOf(removed, "state")["nails"].size(), state["nails"].size());
  EXPECT_EQ(lastOf(ask(1, {{"type", "unnail"}, {"sketch", "sketch 1"}}), "error")["code"], "input");
  for (int k = 0; k < 2; ++k) all = ask(1, {{"type", "undo"}});
  EXPECT_EQ(lastOf(all, "state")["bodies"], state["bodies"]);
  EXPECT_EQ(lastOf(all, "state")["controls"], state["controls"]);
}

TEST_F(AskedForAPath, StopPutsTheMotionBack) {
  const std::vector<Json> before = ask(1, {{"type", "stop"}});
  send(1, sketch());
  worker->step({});
  send(1, {{"type", "stop"}});
  std::vector<Json> all;
  while (lastOf(all, "sketch").is_null() || !lastOf(all, "sketch").contains("cancelled")) {
    worker->step({});
    for (Json& message : received.take(1)) all.push_back(std::move(message));
    if (!lastOf(all, "sketch").is_null() && !lastOf(all, "sketch").value("more", true)) GTEST_SKIP() << "it was quicker than the stop";
  }
  EXPECT_EQ(lastOf(all, "motion")["end"], lastOf(before, "motion")["end"]);
  EXPECT_EQ(lastOf(all, "state")["rev"], state["rev"]);
  EXPECT_EQ(lastOf(all, "state")["undo"], state["undo"]);
}

TEST_F(AskedForAPath, WhatCannotBeDrawnIsSaid) {
  Json wrong = sketch();
  wrong["body"] = "none";
  EXPECT_EQ(lastOf(ask(1, wrong), "error")["code"], "input");
  wrong = sketch(), wrong["places"] = {{0, 0, 1}};
  EXPECT_THROW(send(1, wrong), MessageError);
  wrong = sketch(), wrong["places"] = {{0, 0, 1}, {0, 0, 1}};
  std::vector<Json> all = ask(1, wrong);
  while (lastOf(all, "sketch").is_null()) {
    worker->step({});
    all = received.take(1);
  }
  EXPECT_NE(lastOf(all, "sketch")["message"], "");
  EXPECT_EQ(lastOf(ask(1, {{"type", "stop"}}), "state")["rev"], state["rev"]);
}

}  // namespace
}  // namespace carom::studio
