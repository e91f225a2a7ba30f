// SPDX-License-Identifier: MIT
// Journals of sessions as documents: what is written is read back, plays to the same bits, and bad ones are refused.
#include "formats/documents/journal_json.h"

#include <gtest/gtest.h>

#include "editing/session_replay.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {
namespace {

Document throwOfABox() {
  return parseDocument(R"({
  "carom": 1, "duration": 1.2,
  "materials": { "felt": { "elasticity": 0.5, "friction": 0.4 } },
  "bodies": [
    { "name": "floor", "fixed": true, "material": "felt", "shape": { "plane": { "normal": [0, 0, 1], "offset": 0 } } },
    { "name": "box", "material": "felt", "density": 600, "shape": { "box": { "size": [0.3, 0.2, 0.1] } },
      "position": [0, 0, 1], "orientation": [0.9, 0.3, -0.1, 0.3], "velocity": [1.5, 0.2, 1],
      "angular_velocity": [1, 2, 0.5] }
  ],
  "controls": [{ "vary": "velocity", "body": "box" }, { "vary": "angular_velocity", "body": "box", "weight": 0.5 }],
  "constraints": [{ "body": "box", "at": 0, "position": [0, 0, 1] }]
})",
                       "throw");
}

SessionJournal recorded() {
  const Document document = throwOfABox();
  OdeContacts contacts(document.scene);
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  EditSession session(document.scene, contacts, document.duration, document.controls, document.constraints, options);
  session.grab("box", 0.6, {.body_point = Vec3(0.1, 0, 0), .components = {"x", "z"}});
  const Vec3 start = session.grabbedPlace();
  for (int k = 1; k <= 4; ++k) session.dragTo(start + k * Vec3(0.013, 0, 0.007));
  session.releaseNailed();
  session.vary(orientation("box"));
  session.nail("box", nthImpact(1, "floor"), {.position = WantedVector(0.7, any, any)});
  session.grab("box", 0.3, {.orientation = true});
  session.dragTo(session.grabbedPlace(), session.grabbedOrientation());
  session.cancel();
  session.grab("box", 0.3, {.orientation = true, .place = false});
  session.dragTo(session.grabbedPlace(), session.grabbedOrientation());
  session.cancel();
  session.undo();
  session.redo();
  session.unnail(session.nails().back());
  return session.journal();
}

TEST(Journal, ReadsBackAsItWasAndPlaysTheSame) {
  const SessionJournal journal = recorded();
  const std::string text = writeJournal({journal, ""});
  const JournalDocument read = parseJournal(text, "journal");
  EXPECT_EQ(writeJournal(read), text);
  ASSERT_EQ(read.journal.gestures.size(), journal.gestures.size());
  EXPECT_EQ(read.journal.nails.size(), 1u);
  EXPECT_EQ(read.journal.gestures[0].grip.components, (std::vector<std::string>{"x", "z"}));
  EXPECT_EQ(read.journal.gestures[0].grip.body_point->x(), 0.1);
  EXPECT_TRUE(read.journal.gestures[3].grip.place && !read.journal.gestures[4].grip.place);

  OdeContacts contacts(read.journal.scene);
  SessionReplay replay(read.journal, contacts);
  while (!replay.done()) {
    const ReplayedGesture gesture = replay.next();
    EXPECT_TRUE(gesture.differences.empty()) << gesture.differences[0];
  }
  const Document end = documentOf(replay.session(), "");
  EXPECT_EQ(end.constraints.size(), 2u);
  parseDocument(writeDocument(end), "end");
}

TEST(Journal, KeepsWhatIsConstrainedAtRest) {
  const Document document = parseDocument(R"({
  "carom": 1, "duration": 3,
  "bodies": [
    { "name": "floor", "fixed": true, "shape": { "plane": { "normal": [0, 0, 1] } } },
    { "name": "block", "mass": 2, "shape": { "box": { "size": [0.3, 0.2, 0.1] } }, "position": [0, 0, 0.05],
      "velocity": [1.5, 0.2, 0] }
  ],
  "controls": [{ "vary": "velocity", "body": "block", "components": ["x", "y"] }]
})",
                                          "block");
  OdeContacts contacts(document.scene);
  EditSession session(document.scene, contacts, document.duration, document.controls, {});
  session.grab("block", atRest(), {.components = {"x", "y"}});
  session.dragTo(session.grabbedPlace() + Vec3(0.2, 0.1, 0));
  session.releaseNailed();
  const std::string text = writeJournal({session.journal(), ""});
  const JournalDocument read = parseJournal(text, "journal");
  EXPECT_EQ(writeJournal(read), text);
  EXPECT_TRUE(read.journal.gestures.at(0).at.rest);
  OdeContacts again(read.journal.scene);
  SessionReplay replay(read.journal, again);
  while (!replay.done()) EXPECT_TRUE(replay.next().differences.empty());
  EXPECT_TRUE(replay.session().constraints().at(0).at.rest);
}

TEST(Journal, KeepsWhatSlidesOverASurface) {
  const Document document = throwOfABox();
  OdeContacts contacts(document.scene);
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  EditSession session(document.scene, contacts, document.duration, document.controls, {}, options);
  session.grab("box", nthImpact(1, "floor"), {.contact = true, .components = {"y", "z"}});
  const Vec3 start = session.grabbedPlace();
  session.slideTo(start + Vec3(0.02, 0.01, 0), {"x", "y"});
  session.dragTo(start + Vec3(0.04, 0.02, 0));
  session.slideTo(start + Vec3(0.04, 0.02, 0), {"y", "z"});
  session.slideTo(start + Vec3(0.05, 0.02, 0), {"x", "y"});
  session.releaseNailed();
  session.grabNail(session.nails().back());
  session.dragTo(start + Vec3(0.03, 0.01, 0));
  session.release();
  const std::string text = writeJournal({session.journal(), ""});
  const JournalDocument read = parseJournal(text, "journal");
  EXPECT_EQ(writeJournal(read), text);
  EXPECT_TRUE(read.journal.gestures.at(0).grip.contact);
  EXPECT_EQ(read.journal.gestures[0].grip.components, (std::vector<std::string>{"y", "z"}));
  EXPECT_EQ(read.journal.gestures[0].targets.at(2).components, (std::vector<std::string>{"y", "z"}));
  OdeContacts again(read.journal.scene);
  SessionReplay replay(read.journal, again);
  while (!replay.done()) {
    const ReplayedGesture gesture = replay.next();
    EXPECT_TRUE(gesture.differences.empty()) << gesture.differences[0];
  }
  EXPECT_EQ(replay.session().constraints().at(0).targets.at(0).quantity, "contact");
}

/// A session with every kind of gesture that studios make.
SessionJournal recordedInAStudio() {
  const Document document = throwOfABox();
  OdeContacts contacts(document.scene);
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  options.dwell_simulations = 7;
  options.drag_steps = 1234567.5, options.release_steps = 7e8;
  options.unmet_nails_off = true;
  std::vector<Constraint> goals = document.constraints;
  goals.push_back(nailConstraint("box", 0.2, {.position = WantedVector(0.4, any, any)}));
  EditSession session(document.scene, contacts, document.duration, document.controls, goals, options);
  session.meetNails();
  session.setNailOn({0}, false);
  session.setNail({1}, nailConstraint("box", 0.25, {.position = WantedVector(0.4, any, any)}));
  session.grab("box", 0.1, {}, {position("box")});
  session.dragTo(session.grabbedPlace() + Vec3(0, 0.5, 0));
  session.dwell();
  session.releaseNailed(NailAt::where_it_got);
  session.grabNail({1});
  session.dragTo({0.5, 0, 0});
  session.release();
  SessionContent content = session.content();
  content.scene.bodies[1].velocity.y() = 0.3;
  Body pebble = content.scene.bodies[1];
  pebble.name = "pebble", pebble.position.x() = 4;
  content.scene.bodies.push_back(pebble);
  content.duration = 2.5;
  content.nails.push_back({NailId(), nailConstraint("pebble", 0.4, {.velocity = WantedVector(1, any, any)})});
  session.setContent(content, "velocity.y of 'box'");
  session.grab("pebble", 0.3, {}, {velocity("pebble")});
  session.dragTo(session.grabbedPlace() + Vec3(0.1, 0, 0));
  session.release();
  session.undo();
  session.undo();
  session.keepSequence(true);
  session.nail("box", 0.3, {.velocity = WantedVector(any, 0.3, any)});
  session.keepSequence(false);
  return session.journal();
}

TEST(Journal, GesturesOfAStudioReadBackAndPlayTheSame) {
  const SessionJournal journal = recordedInAStudio();
  const std::string text = writeJournal({journal, ""});
  const JournalDocument read = parseJournal(text, "journal");
  EXPECT_EQ(writeJournal(read), text);
  ASSERT_EQ(read.journal.gestures.size(), journal.gestures.size());
  EXPECT_EQ(read.journal.options.dwell_simulations, 7);
  EXPECT_TRUE(read.journal.options.unmet_nails_off);
  for (std::size_t i = 0; i < journal.gestures.size(); ++i) {
    const SessionGesture &was = journal.gestures[i], &is = read.journal.gestures[i];
    EXPECT_EQ(is.kind, was.kind) << i;
    EXPECT_EQ(is.ending, was.ending) << i;
    EXPECT_EQ(is.nail, was.nail) << i;
    EXPECT_EQ(is.on, was.on) << i;
    EXPECT_EQ(is.grabbed_nail, was.grabbed_nail) << i;
    EXPECT_EQ(is.controls.size(), was.controls.size()) << i;
    EXPECT_EQ(is.name, was.name) << i;
    EXPECT_EQ(is.content.has_value(), was.content.has_value()) << i;
  }
  EXPECT_TRUE(read.journal.gestures[3].targets.at(1).dwell);
  const std::vector<std::pair<NailId, Constraint>>& nails = read.journal.gestures[5].content->nails;
  ASSERT_EQ(nails.size(), 4u);
  EXPECT_EQ(nails[2].first.value, 2);
  EXPECT_EQ(nails[3].first, NailId());

  OdeContacts contacts(read.journal.scene);
  SessionReplay replay(read.journal, contacts);
  while (!replay.done()) {
    const ReplayedGesture gesture = replay.next();
    EXPECT_TRUE(gesture.differences.empty()) << gesture.differences[0];
  }
}

TEST(Journal, BadGesturesOfAStudioAreRefused) {
  const std::string good = writeJournal({recordedInAStudio(), ""});
  const std::vector<std::vector<std::string>> cases = {
      {"\"meet_nails\": true", "\"meet_nails\": false", "/gestures/0/meet_nails", "true"},
      {"\"nail_on\": false", "\"nail_on\": 0", "/gestures/1/nail_on", "true or false"},
      {"\"nail_on\": false,", "", "/gestures/1", "exactly one of"},
      {"\"set_nail\": { \"body\": \"box\"", "\"set_nail\": { \"body\": \"hat\"", "/gestures/2/set_nail/body", "\"hat\""},
      {"{ \"vary\": \"position\", \"body\": \"box\" }", "{ \"vary\": \"colour\", \"body\": \"box\" }",
       "/gestures/3/also_vary/0/vary", "colour"},
      {"\"dwell\": true", "\"dwell\": 1", "/gestures/3/targets/1/dwell", "true or false"},
      {"\"grab_nail\": 1", "\"grab_nail\": -1", "/gestures/4/grab_nail", "the number of a nail"},
      {"\"ids\": [0, 1, 2, null]", "\"ids\": [0, 1, 2]", "/gestures/5/ids", "4, one for each constraint"},
      {"\"ids\": [0, 1, 2, null]", "\"ids\": [0, 1, 2, \"new\"]", "/gestures/5/ids/3", "or null"},
      {"\"duration\": 2.5", "\"duration\": -2.5", "/gestures/5/content/duration", "a number > 0"},
  };
  for (const std::vector<std::string>& broken : cases) {
    SCOPED_TRACE(broken[1]);
    std::string text = good;
    const std::size_t at = text.find(broken[0]);
    ASSERT_NE(at, std::string::npos) << broken[0];
    text.replace(at, broken[0].size(), broken[1]);
    try {
      parseJournal(text, "j.json");
      ADD_FAILURE() << "was read";
    } catch (const FormatError& error) {
      EXPECT_EQ(error.where(), broken[2]) << error.what();
      EXPECT_NE(std::string(error.what()).find(broken[3]), std::string::npos) << error.what();
    }
  }
}

struct BrokenJournal {
  const char *from, *to, *where, *message;
};

TEST(Journal, BadOnesAreRefused) {
  const std::string good = writeJournal({recorded(), ""});
  const BrokenJournal cases[] = {
      {"\"carom_journal\": 1", "\"carom_journal\": 2", "/carom_journal", "expected 1"},
      {"\"carom_journal\": 1,", "", "", "no member \"carom_journal\""},
      {"\"carom\": 1", "\"carom\": 7", "/scene/carom", "found 7"},
      {"\"density\": 600", "\"density\": -600", "/scene/bodies/1/density", "a number > 0"},
      {"\"measure_from\": \"grab\"", "\"measure_from\": \"now\"", "/options/measure_from", "one of grab, start"},
      {"\"drag_simulations\": 28", "\"drag_simulations\": -1", "/options/drag_simulations", "an integer"},
      {"\"ending\": \"cancel\"", "\"ending\": \"escape\"", "/gestures/3/ending", "release_nailed"},
      {"\"ending\": \"cancel\"", "\"end\": \"cancel\"", "/gestures/3/end", "an unknown member"},
      {"\"undo\": true", "\"undone\": true", "/gestures/5/undone", "an unknown member"},
      {"\"undo\": true", "\"undo\": true, \"redo\": true", "/gestures/5", "exactly one of"},
      {"\"unnail\": 2", "\"unnail\": \"2\"", "/gestures/7/unnail", "the number of a nail"},
      {"\"nail\": { \"body\": \"box\"", "\"nail\": { \"body\": \"hat\"", "/gestures/2/nail/body", "\"hat\""},
      {"\"drag\": { \"body\": \"box\", \"at\": 0.3", "\"drag\": { \"body\": \"box\", \"at\": 9", "/gestures/3/drag/at",
       "found 9"},
      {"{ \"vary\": \"orientation\", \"body\": \"box\" }", "{ \"vary\": \"colour\", \"body\": \"box\" }",
       "/gestures/1/controls/2/vary", "colour"},
  };
  for (const BrokenJournal& broken : cases) {
    SCOPED_TRACE(broken.to);
    std::string text = good;
    const std::size_t at = text.find(broken.from);
    ASSERT_NE(at, std::string::npos) << broken.from;
    text.replace(at, std::string(broken.from).size(), broken.to);
    try {
      parseJournal(text, "j.json");
      ADD_FAILURE() << "was read";
    } catch (const FormatError& error) {
      EXPECT_EQ(error.where(), broken.where) << error.what();
      EXPECT_NE(std::string(error.what()).find(broken.message), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).rfind("j.json", 0), 0u) << error.what();
    }
  }
}

TEST(Journal, TwoTargetsOfOneKindAreTwoNails) {
  SessionJournal journal = recorded();
  Constraint& nail = *journal.gestures[2].constraint;
  nail.targets = {{"point", {0, 0, 1}, Vec3(0.1, 0, 0)}, {"point", {0, 0, 1}, Vec3(-0.1, 0, 0)}};
  try {
    writeJournal({journal, ""});
    ADD_FAILURE() << "was written";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "/gestures/2/nail");
  }
}

}  // namespace
}  // namespace carom
