// SPDX-License-Identifier: MIT
// A session that goes on from its history is the session: the same bits in all that it does, back and forth.
#include <gtest/gtest.h>

#include <random>

#include "adjoint/base/errors.h"
#include "editing/session_history.h"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;

void expectSame(const EditSession& a, const EditSession& b, const std::string& where) {
  EXPECT_TRUE(sameScene(a.scene(), b.scene())) << where;
  EXPECT_EQ(a.scene().bodies, b.scene().bodies) << where;
  EXPECT_EQ(a.duration(), b.duration()) << where;
  EXPECT_EQ(a.undoName(), b.undoName()) << where;
  EXPECT_EQ(a.redoName(), b.redoName()) << where;
  EXPECT_EQ(a.controls().size(), b.controls().size()) << where;
  ASSERT_EQ(a.nails(), b.nails()) << where;
  const std::vector<NailState> of_a = a.nailStates(), of_b = b.nailStates();
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    EXPECT_EQ(of_a[i].on, of_b[i].on) << where;
    EXPECT_EQ(of_a[i].met, of_b[i].met) << where;
  }
  EXPECT_EQ(a.motion().signature(), b.motion().signature()) << where;
  EXPECT_EQ(a.journal().gestures.size(), b.journal().gestures.size()) << where;
  EXPECT_EQ(a.options().sequence, b.options().sequence) << where;
}

/// One gesture of any kind, chosen by a seed.
void gesture(EditSession& session, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-0.04, 0.04);
  switch (random() % 9) {
    case 0:
      session.undo();
      break;
    case 1:
      session.redo();
      break;
    case 2:
      session.nailAsItIs("box", 0.2);
      break;
    case 3:
      if (!session.nails().empty()) session.setNailOn(session.nails().back(), random() % 2 == 0);
      break;
    case 4: {
      SessionContent content = session.content();
      content.scene.bodies[1].velocity.x() += by(random);
      session.setContent(content, "a number");
      break;
    }
    case 8:
      session.keepSequence(random() % 2 == 0);
      break;
    case 5:
      session.grab("box", 0.4);
      session.dragTo(session.grabbedPlace() + Vec3(by(random), by(random), by(random)));
      session.cancel();
      break;
    default:
      session.grab("box", 0.3 + 0.1 * static_cast<double>(random() % 5));
      session.dragTo(session.grabbedPlace() + Vec3(by(random), by(random), by(random)));
      if (random() % 3 == 0)
        session.releaseNailed(NailAt::where_it_got);
      else
        session.release();
  }
}

TEST(SessionResume, GoesOnFromAnywhereWithTheSameBits) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    BoxSession s;
    for (unsigned k = 0; k < 6; ++k) gesture(s.session, 100 * seed + k);
    OdeContacts contacts(s.scene);
    EditSession other(s.session.history(), contacts);
    expectSame(other, s.session, "resumed");
    for (unsigned k = 6; k < 10; ++k) {
      gesture(s.session, 100 * seed + k), gesture(other, 100 * seed + k);
      expectSame(other, s.session, "after gesture " + std::to_string(k));
    }
    while (s.session.canUndo()) {
      s.session.undo(), other.undo();
      expectSame(other, s.session, "undone");
    }
    EXPECT_EQ(other.scene().bodies, s.scene.bodies) << "undo goes to the beginning";
    expectSameAgain(other, s.scene);
  }
}

TEST(SessionResume, RefusesWhatItCannotKnow) {
  BoxSession s;
  s.session.grab("box", 0.4);
  EXPECT_THROW(s.session.history(), InputError) << "in a gesture there is none";
  s.session.cancel();
  SessionHistory history = s.session.history();
  history.journal.options.measure_from = MeasureFrom::start;
  OdeContacts contacts(s.scene);
  EXPECT_THROW(EditSession(history, contacts), InputError);
}

}  // namespace
}  // namespace carom
