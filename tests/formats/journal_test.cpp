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
  session.nail("box", nthImpact(1, "floor"), {.position = Vec3(0.7, any, any)});
  session.grab("box", 0.3, {.orientation = true});
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
      {"\"drag_simulations\": 14", "\"drag_simulations\": -1", "/options/drag_simulations", "an integer"},
      {"\"ending\": \"cancel\"", "\"ending\": \"escape\"", "/gestures/3/ending", "release_nailed"},
      {"\"ending\": \"cancel\"", "\"end\": \"cancel\"", "/gestures/3/end", "an unknown member"},
      {"\"undo\": true", "\"undone\": true", "/gestures/4/undone", "an unknown member"},
      {"\"undo\": true", "\"undo\": true, \"redo\": true", "/gestures/4", "exactly one of"},
      {"\"unnail\": 2", "\"unnail\": \"2\"", "/gestures/6/unnail", "the number of a nail"},
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
