// SPDX-License-Identifier: MIT
// Sessions of random gestures of every kind, stopped at random: they play again to the same bits, and undo leads back.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "adjoint/simulate/simulate.h"
#include "tests/editing/stopped_session.h"
#include "tests/support/scaled.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;

/// A person who does this and that with one body, and never waits for long.
class RestlessPerson {
 public:
  RestlessPerson(StoppedSession& s, std::string body, double latest, unsigned seed)
      : s_(s), session_(s.session), body_(std::move(body)), latest_(latest), random_(seed) {}

  void gesture() {
    switch (pick(11)) {
      case 0:
        return nail();
      case 1:
        return withNail([&](NailId id) { session_.setNail(id, somewhere(), soon(30)), note(); });
      case 2:
        return withNail([&](NailId id) { session_.setNailOn(id, pick(2) == 0); });
      case 3:
        return withNail([&](NailId id) { session_.unnail(id); });
      case 4:
        return session_.meetNails(soon(30)), note();
      case 5:
        return withNail([&](NailId id) {
          if (isThere(id)) session_.grabNail(id), drag();
        });
      case 6:
        return typed();
      case 7:
        return static_cast<void>(session_.undo());
      case 8:
        return static_cast<void>(session_.redo());
      default:
        return grab();
    }
  }
  int stopped() const { return stopped_; }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double within(double size) { return size * (2 * static_cast<double>(random_()) / 4294967295.0 - 1); }
  std::stop_token soon(int most) { return s_.stop.set(pick(most)); }
  double time() { return std::min(latest_, session_.motion().end) * (0.55 + within(0.4)); }
  Vec3 near(const Vec3& place) { return place + Vec3(within(0.2), within(0.1), within(0.2)); }
  Constraint somewhere() {
    const double t = time();
    return nailConstraint(body_, t, {.position = near(session_.motion().stateAt(body_, t).position)});
  }
  void note() { stopped_ += session_.last().stopped; }

  template <class Call>
  void withNail(const Call& call) {
    const std::vector<NailId> nails = session_.nails();
    if (!nails.empty()) call(nails[static_cast<std::size_t>(pick(static_cast<int>(nails.size())))]);
  }
  bool isThere(NailId id) const {
    return std::ranges::any_of(session_.nailStates(), [&](const NailState& n) { return n.id == id && n.available; });
  }
  void nail() {
    if (session_.nails().size() < 2) session_.nail(somewhere(), soon(30)), note();
  }
  void typed() {
    SessionContent content = session_.content();
    content.scene.bodies[static_cast<std::size_t>(bodyIndex(content.scene, body_))].velocity +=
        Vec3(0, 0, within(0.05));
    session_.setContent(content, "a number");
  }
  void grab() {
    std::vector<Control> more;
    if (pick(3) == 0 && session_.controls().size() < 2) more = {angularVelocity(body_)};
    session_.grab(body_, time(), {.orientation = pick(4) == 0}, more);
    drag();
  }
  void drag() {
    for (int updates = 1 + pick(3); updates > 0; --updates)
      session_.dragTo(near(session_.grabbedPlace()), soon(6)), note();
    if (pick(2) == 0) session_.dwell(soon(20)), note();
    switch (pick(5)) {
      case 0:
        session_.cancel();
        break;
      case 1:
        session_.releaseNailed(NailAt::target, soon(60)), note();
        break;
      case 2:
        session_.releaseNailed(NailAt::where_it_got, soon(60)), note();
        break;
      default:
        session_.release(soon(60)), note();
    }
  }

  StoppedSession& s_;
  EditSession& session_;
  const std::string body_;
  const double latest_;
  std::mt19937 random_;
  int stopped_ = 0;
};

int live(StoppedSession& s, const std::string& body, double latest, unsigned seed) {
  RestlessPerson person(s, body, latest, seed);
  for (int i = 0; i < 12; ++i) {
    person.gesture();
    const SessionUpdate& u = s.session.last();
    EXPECT_FALSE(u.cut_by_clock);
    EXPECT_EQ(simulate(u.scene(), s.inner, s.session.duration()).signature(), u.motion->signature());
  }
  expectSameAgain(s);
  while (s.session.canUndo()) s.session.undo();
  EXPECT_TRUE(sameScene(s.session.scene(), s.scene)) << "undone, it is as it was";
  EXPECT_TRUE(s.session.nails().empty());
  return person.stopped();
}

TEST(SessionRandom, WhatWasStoppedPlaysToTheSameBits) {
  const unsigned seeds = static_cast<unsigned>(test::scaled(10));
  int stopped = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    StoppedSession wall(floorAndWall(), 0.6, {velocity("ball").only({"x", "z"})});
    stopped += live(wall, "ball", 0.6, seed);
    StoppedSession box(thrownBox(), 1.2, {velocity("box")});
    stopped += live(box, "box", 1.0, seed);
  }
  RecordProperty("stopped", stopped);
  EXPECT_GE(stopped, static_cast<int>(seeds)) << "calls of " << seeds << " sessions";
}

}  // namespace
}  // namespace carom
