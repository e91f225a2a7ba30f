// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/session_journal.h"

namespace carom {

/// A nail with its id, and whether it is enforced.
struct SessionHistoryNail {
  NailId id;              ///< which
  Constraint constraint;  ///< its targets
  bool on = true;         ///< see EditSession::setNailOn
};

/// State of a session after a step, without the motion, which follows from it.
struct SessionHistoryPoint {
  Scene scene;                            ///< at that step
  double duration = 1;                    ///< s
  std::vector<Control> controls;          ///< what may vary
  std::vector<SessionHistoryNail> nails;  ///< oldest first
  std::string step;  ///< of the past and the future: name of the step between it and the one nearer to now
};

/// A session with all its undo and redo steps, so that it can be resumed without solving again.
struct SessionHistory {
  std::vector<SessionHistoryPoint> past;    ///< oldest first: undo leads to the last one
  SessionHistoryPoint now;                  ///< current state
  std::vector<SessionHistoryPoint> future;  ///< redo leads to the last one
  int next_nail = 0;                        ///< id of the next nail
  SessionJournal journal;                   ///< its initial state, and its gestures so far
};

}  // namespace carom
