// SPDX-License-Identifier: MIT
// Steps of a session as lines: it comes back without being played, to the same bits, and its journal plays the same.
#include "formats/documents/step_lines.hpp"

#include <gtest/gtest.h>

#include <random>

#include "editing/session_replay.h"
#include "formats/base/format_error.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {
namespace {

using namespace formats_detail;

constexpr const char* kThrow = R"({
  "carom": 1, "duration": 1.1, "name": "A throw",
  "materials": { "felt": { "elasticity": 0.5, "friction": 0.4 } },
  "bodies": [
    { "name": "floor", "fixed": true, "material": "felt", "shape": { "plane": { "normal": [0, 0, 1] } } },
    { "name": "box", "material": "felt", "density": 600, "shape": { "box": { "size": [0.3, 0.2, 0.1] } },
      "position": [0, 0, 1], "orientation": [0.9, 0.3, -0.1, 0.3], "velocity": [1.5, 0.2, 1],
      "angular_velocity": [1, 2, 0.5] }
  ],
  "controls": [{ "vary": "velocity", "body": "box" }, { "vary": "angular_velocity", "body": "box", "weight": 0.5 },
               { "vary": "orientation", "body": "box" }],
  "constraints": [{ "body": "box", "at": 0.5, "position": [5, 0, 1] }]
})";

/// A session, and its steps as they are appended.
struct Recorded {
  Document document = parseDocument(kThrow, "throw");
  OdeContacts contacts{document.scene};
  EditSession session;
  std::string text, before;

  static SessionOptions options() {
    SessionOptions options;
    options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
    options.release_iterations = 40, options.unmet_nails_off = true;
    return options;
  }
  Recorded()
      : session(document.scene, contacts, document.duration, document.controls, document.constraints, options()) {
    text = firstStepLine(session, document, kThrow);
  }
  Document now() const {
    Document now = documentOf(session, document.folder);
    now.name = document.name;
    return now;
  }
  void append() { text += stepLine(session, session.journal().gestures.size() - 1, now(), before); }
  void drag(double by, bool cancel = false) {
    session.grab("box", 0.4);
    session.dragTo(session.grabbedPlace() + Vec3(by, -by, 0.5 * by));
    cancel ? session.cancel() : session.release();
    append();
  }
};

void expectSame(const EditSession& a, const EditSession& b) {
  EXPECT_EQ(a.scene().bodies, b.scene().bodies);
  EXPECT_EQ(a.undoName(), b.undoName());
  EXPECT_EQ(a.redoName(), b.redoName());
  ASSERT_EQ(a.nails(), b.nails());
  for (std::size_t i = 0; i < a.nails().size(); ++i) EXPECT_EQ(a.nailStates()[i].on, b.nailStates()[i].on);
}

void play(Recorded& r, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-0.03, 0.03);
  for (int k = 0; k < 8; ++k) {
    switch (random() % 6) {
      case 0:
        if (r.session.canUndo()) r.session.undo(), r.append();
        break;
      case 1:
        if (r.session.canRedo()) r.session.redo(), r.append();
        break;
      case 2:
        r.session.nailAsItIs("box", 0.2), r.append();
        break;
      case 3:
        r.session.setNailOn(r.session.nails().back(), random() % 2 == 0), r.append();
        break;
      default:
        r.drag(by(random), random() % 4 == 0);
    }
  }
}

TEST(StepLines, ComeBackToTheSameBitsAndPlayTheSame) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Recorded r;
    play(r, seed);
    EXPECT_TRUE(areStepLines(r.text));
    const StepLines read = readStepLines(r.text, "steps", "");
    EXPECT_EQ(read.opened, kThrow);
    EXPECT_EQ(read.bytes, r.text.size());
    OdeContacts contacts(read.history.journal.scene);
    EditSession other(read.history, contacts);
    expectSame(other, r.session);
    r.drag(0.01), other.grab("box", 0.4);
    other.dragTo(other.grabbedPlace() + Vec3(0.01, -0.01, 0.005));
    other.release();
    expectSame(other, r.session);
    while (other.canUndo()) other.undo(), r.session.undo(), expectSame(other, r.session);
    const SessionJournal& played = read.journal.journal;
    OdeContacts again(played.scene);
    SessionReplay replay(played, again);
    while (!replay.done()) {
      const ReplayedGesture gesture = replay.next();
      EXPECT_TRUE(gesture.differences.empty()) << gesture.differences[0];
    }
  }
}

TEST(StepLines, ATornLineIsLeftOut) {
  Recorded r;
  r.drag(0.01), r.drag(0.02);
  const std::string whole = r.text;
  r.drag(0.015);
  for (std::size_t size = whole.size(); size < r.text.size(); size += 37) {
    const StepLines read = readStepLines(std::string_view(r.text).substr(0, size), "steps", "");
    EXPECT_EQ(read.bytes, whole.size());
    EXPECT_EQ(read.history.past.size(), 2u);
  }
  EXPECT_THROW(readStepLines(std::string_view(r.text).substr(0, 40), "steps", ""), FormatError);
  EXPECT_THROW(readStepLines("{\"carom_steps\":1}\n", "steps", ""), FormatError);
  EXPECT_THROW(readStepLines(r.text + "{\"gesture\":{\"undo\":true}}\n", "steps", ""), FormatError);
  EXPECT_THROW(readStepLines(r.text + "nonsense\n", "steps", ""), FormatError);
  const StepLines saved = readStepLines(r.text + savedLine("{}"), "steps", "");
  EXPECT_EQ(saved.saved, "{}");
  EXPECT_EQ(saved.history.past.size(), 3u);
}

}  // namespace
}  // namespace carom
