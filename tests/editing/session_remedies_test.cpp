// SPDX-License-Identifier: MIT
// What would help a drag that does not reach its target, and what else would meet what is held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "editing/session_alternatives.h"
#include "editing/session_remedies.h"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;
using RemedyKind = SessionRemedy::Kind;

/// Drags a ball there, lets go, and asks why it is not there.
SessionUpdate dragged(EditSession& session, const std::string& body, double at, const Vec3& by) {
  session.grab(body, at);
  session.dragTo(session.grabbedPlace() + by);
  return session.release();
}

const SessionRemedy* remedyOf(const SessionWhyNot& why, RemedyKind kind) {
  const auto found = std::ranges::find(why.remedies, kind, &SessionRemedy::kind);
  return found == why.remedies.end() ? nullptr : &*found;
}

TEST(SessionRemedies, AControlThatIsLackingIsNamedAndSolves) {
  BoxSession s;
  s.session.setControls({velocity("box").only({"x"})});
  const SessionUpdate update = dragged(s.session, "box", 0.15, {0.1, 0.05, 0.02});
  ASSERT_FALSE(update.reached);
  const SessionSnapshot asked = s.session.snapshot();
  EXPECT_FALSE(asked.reached);
  ASSERT_EQ(asked.wanted.size(), 1u);
  EXPECT_EQ(asked.nails[0], NailId());
  OdeContacts own(s.scene);
  int told = 0;
  const SessionWhyNot why = whyNot(asked, own, [&](const SessionWhyNot&) { ++told; });
  EXPECT_EQ(told, static_cast<int>(why.remedies.size()) + 1);
  ASSERT_FALSE(why.remedies.empty());
  const SessionRemedy& first = why.remedies[0];
  EXPECT_EQ(first.kind, RemedyKind::vary);
  EXPECT_TRUE(first.tried && first.solves) << first.name;
  EXPECT_EQ(first.name, "Let the velocity.y,z of 'box' change");
  ASSERT_EQ(first.content.controls.size(), 1u) << "it joins the control that is there";
  const std::size_t steps = s.session.undoDepth();
  s.session.setContent(first.content, first.name);
  EXPECT_EQ(s.session.undoDepth(), steps + 1);
  EXPECT_EQ(s.session.undoName(), first.name);
  EXPECT_TRUE(nailStateIn(s.session.motion(), asked.wanted[0], s.session.duration(), asked.tolerance).met);
  s.session.undo();
  EXPECT_EQ(s.session.controls()[0].components, std::vector<std::string>{"x"});
}

TEST(SessionRemedies, ABoundIsMovedAsFarAsItTakes) {
  BoxSession s;
  const double now = s.scene.bodies[1].velocity.x();
  s.session.setControls({velocity("box").within(-std::abs(now) - 0.2, std::abs(now) + 0.2)});
  ASSERT_FALSE(dragged(s.session, "box", 0.15, {0.08, 0, 0}).reached);
  OdeContacts own(s.scene);
  const SessionWhyNot why = whyNot(s.session.snapshot(), own);
  const SessionRemedy* widen = remedyOf(why, RemedyKind::widen);
  ASSERT_NE(widen, nullptr);
  EXPECT_TRUE(widen->solves);
  EXPECT_TRUE(widen->name.starts_with("Let velocity.x of 'box' go to ")) << widen->name;
  const Control& control = widen->content.controls[0];
  ASSERT_EQ(control.max.size(), 3u);
  EXPECT_GT(control.max[0], std::abs(now) + 0.2);
  EXPECT_EQ(control.max[1], std::abs(now) + 0.2) << "the others stay";
  EXPECT_GE(control.max[0], widen->content.scene.bodies[1].velocity.x());
  EXPECT_LE(control.max[0], 1.01 * widen->content.scene.bodies[1].velocity.x()) << "no farther than it takes";
}

TEST(SessionRemedies, ANailInTheWayIsReleased) {
  BoxSession s;
  s.session.setControls({velocity("box")});
  const NailId nail = s.session.nailAsItIs("box", 0.1);
  s.session.setNail(nail, nailConstraint("box", 0.1, {.position = Vec3(s.session.motion().stateAt("box", 0.1).position)}));
  ASSERT_FALSE(dragged(s.session, "box", 0.15, {0.05, 0, 0}).reached);
  OdeContacts own(s.scene);
  const SessionWhyNot why = whyNot(s.session.snapshot(), own);
  const SessionRemedy* release = remedyOf(why, RemedyKind::release);
  ASSERT_NE(release, nullptr) << why.sentence;
  EXPECT_EQ(release->name, "Release the nail of 'box' at 0.1 s");
  EXPECT_TRUE(release->solves);
  EXPECT_TRUE(release->content.nails.empty());
}

TEST(SessionRemedies, ThereAreNoneWhereTheTargetIsReached) {
  BoxSession s;
  ASSERT_TRUE(dragged(s.session, "box", 0.15, {0.02, 0, 0}).reached);
  OdeContacts own(s.scene);
  int told = 0;
  EXPECT_TRUE(whyNot(s.session.snapshot(), own, [&](const SessionWhyNot&) { ++told; }).remedies.empty());
  EXPECT_EQ(told, 0);
}

TEST(SessionRemedies, EndWhenTheyAreToStop) {
  BoxSession s;
  s.session.setControls({velocity("box").only({"x"})});
  ASSERT_FALSE(dragged(s.session, "box", 0.15, {0.1, 0.05, 0.02}).reached);
  OdeContacts own(s.scene);
  std::stop_source stop;
  int told = 0;
  const SessionWhyNot why = whyNot(s.session.snapshot(), own, [&](const SessionWhyNot&) { ++told, stop.request_stop(); }, stop.get_token());
  EXPECT_EQ(told, 1);
  for (const SessionRemedy& remedy : why.remedies) EXPECT_FALSE(remedy.tried || remedy.solves);
}

TEST(SessionSnapshots, HaveTheTargetOfADragInPlaceOfTheNailThatItLeft) {
  BoxSession s;
  s.session.setControls({velocity("box").only({"x"})});
  s.session.grab("box", 0.15);
  const Vec3 from = s.session.grabbedPlace();
  s.session.dragTo(from + Vec3(0.1, 0.05, 0));
  s.session.releaseNailed(NailAt::where_it_got);
  const SessionSnapshot asked = s.session.snapshot();
  ASSERT_EQ(asked.wanted.size(), 1u);
  EXPECT_EQ(asked.nails[0], s.session.nails()[0]);
  EXPECT_EQ(asked.wanted[0].targets[0].value[1], from.y() + 0.05);
  EXPECT_NE(s.session.constraintOf(asked.nails[0]).targets[0].value[1], from.y() + 0.05);
  EXPECT_EQ(asked.began.bodies[1].velocity, s.scene.bodies[1].velocity);
  EXPECT_NE(asked.content.scene.bodies[1].velocity, s.scene.bodies[1].velocity);
  s.session.undo();
  EXPECT_TRUE(s.session.snapshot().wanted.empty());
  EXPECT_TRUE(s.session.snapshot().reached);
}

TEST(SessionAlternatives, MeetTheSameAndAreOthers) {
  BoxSession s;
  ASSERT_TRUE(dragged(s.session, "box", 0.9, {0.1, 0.02, 0}).reached);
  const SessionSnapshot asked = s.session.snapshot();
  OdeContacts own(s.scene);
  const SessionAlternatives others = alternativesTo(asked, own, 6);
  ASSERT_FALSE(others.found.empty()) << others.message;
  EXPECT_LE(others.found.size(), 6u);
  for (const EditAlternative& other : others.found) {
    SessionContent content = asked.content;
    content.scene = other.scene;
    s.session.setContent(content, "another solution");
    EXPECT_TRUE(nailStateIn(s.session.motion(), asked.wanted[0], s.session.duration(), asked.tolerance).met);
    EXPECT_GE(other.objective, others.least);
  }
}

TEST(SessionAlternatives, AreThereAfterStepsBack) {
  BoxSession s;
  ASSERT_TRUE(dragged(s.session, "box", 0.9, {0.1, 0.02, 0}).reached);
  const SessionSnapshot asked = s.session.snapshot();
  s.session.setNailOn(s.session.nailAsItIs("box", 0.3), false);
  s.session.undo();
  s.session.undo();
  const SessionSnapshot again = s.session.snapshot();
  EXPECT_TRUE(sameScene(again.began, asked.began));
  ASSERT_EQ(again.wanted.size(), 1u);
  EXPECT_EQ(again.wanted[0].targets[0].value[0], asked.wanted[0].targets[0].value[0]);
  s.session.undo();
  EXPECT_TRUE(s.session.snapshot().wanted.empty());
  s.session.redo();
  EXPECT_EQ(s.session.snapshot().wanted.size(), 1u);
}

TEST(SessionAlternatives, SayWhyThereAreNone) {
  BoxSession s;
  OdeContacts own(s.scene);
  const SessionAlternatives none = alternativesTo(s.session.snapshot(), own, 6);
  EXPECT_TRUE(none.found.empty());
  EXPECT_TRUE(none.message.starts_with("Nothing is nailed")) << none.message;
  ASSERT_TRUE(dragged(s.session, "box", 0.9, {0.1, 0.02, 0}).reached);
  SessionContent content = s.session.content();
  content.nails.emplace_back(NailId(), nailConstraint("box", 0.3, {.position = s.session.motion().stateAt("box", 0.3).position}));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(alternativesTo(s.session.snapshot(), own, 6, stop.get_token()).found.empty());
  s.session.setContent(content, "a nail that is met");
  const SessionAlternatives met = alternativesTo(s.session.snapshot(), own, 6);
  EXPECT_TRUE(met.found.empty());
  EXPECT_TRUE(met.message.starts_with("The motion met everything")) << met.message;
}

}  // namespace
}  // namespace carom
