// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "editing/session.h"

namespace carom {

/// Outcome of one replayed gesture.
struct ReplayedGesture {
  SessionUpdate update;                  ///< at its end
  int updates = 0;                       ///< calls of dragTo and dwell
  double slowest_milliseconds = 0;       ///< of them
  std::vector<std::string> differences;  ///< from the outcome in the journal; empty: the same bits
};

/// Replays a journal, gesture by gesture, with its work limits and without time limits: updates ended by a time-out
/// or a stop end at the same point. The same journal gives the same bits.
class SessionReplay {
 public:
  /// Keeps the journal and `contacts` by reference. Throws InputError for an invalid journal.
  SessionReplay(const SessionJournal& journal, ContactSource& contacts);

  /// Whether all gestures were replayed.
  bool done() const { return next_ == journal_.gestures.size(); }
  /// Replays the next gesture. Throws InputError naming "/gestures/<i>" for an invalid one.
  ReplayedGesture next();

  /// The session after the gestures so far.
  const EditSession& session() const { return session_; }

 private:
  void play(const SessionGesture& gesture, ReplayedGesture& out);
  void playDrag(const SessionGesture& gesture, ReplayedGesture& out);
  void compare(const SessionGesture& gesture, ReplayedGesture& out) const;

  const SessionJournal& journal_;
  EditSession session_;
  std::size_t next_ = 0;
};

}  // namespace carom
