// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/session_journal.h"

namespace carom {

/// A nail with its number, and whether it is held.
struct SessionHistoryNail {
  NailId id;              ///< which
  Constraint constraint;  ///< what it holds
  bool on = true;         ///< see EditSession::setNailOn
};

/// What a session is at after a step: all but the motion, which comes of it.
struct SessionHistoryPoint {
  Scene scene;                            ///< as it is there
  double duration = 1;                    ///< s
  std::vector<Control> controls;          ///< what may vary
  std::vector<SessionHistoryNail> nails;  ///< oldest first
  std::string step;  ///< of the past and the future: name of the step between it and the one nearer to now
};

/// A session with all that undo and redo lead to, so that it can go on elsewhere without anything being solved again.
struct SessionHistory {
  std::vector<SessionHistoryPoint> past;    ///< oldest first: undo leads to the last one
  SessionHistoryPoint now;                  ///< where it is
  std::vector<SessionHistoryPoint> future;  ///< redo leads to the last one
  int next_nail = 0;                        ///< number of the next nail that is made
  SessionJournal journal;                   ///< how it began, and its gestures so far
};

}  // namespace carom
