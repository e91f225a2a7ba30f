// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/session.h"

namespace carom {

/// What became of one gesture when it was played again.
struct ReplayedGesture {
  SessionUpdate update;                  ///< at its end
  int updates = 0;                       ///< calls of dragTo and dwell
  double slowest_milliseconds = 0;       ///< of them
  std::vector<std::string> differences;  ///< from what the journal says came of it; empty: the same bits
};

/// Plays a journal again, gesture by gesture, with the work limits of the journal and without a clock: updates that the
/// clock cut, or a stop, end where they did. The same journal gives the same bits.
class SessionReplay {
 public:
  /// Keeps the journal and `contacts` by reference. Throws InputError for a journal that makes no sense.
  SessionReplay(const SessionJournal& journal, ContactSource& contacts);

  /// All gestures were played.
  bool done() const { return next_ == journal_.gestures.size(); }
  /// Throws InputError naming "/gestures/<i>" for a gesture that cannot be done.
  ReplayedGesture next();

  /// As it is after the gestures so far.
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
