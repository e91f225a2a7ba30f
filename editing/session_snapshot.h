// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/edit_options.h"
#include "editing/session_journal.h"

namespace carom {

/// What the last gesture that solved asked for, and where the session is now, by value: for another thread.
struct SessionSnapshot {
  Scene began;             ///< at the start of the last gesture that solved; otherwise the current scene
  SessionContent content;  ///< where it ended
  /// Nails that are enforced and available, with the target of a drag as it was asked for.
  std::vector<Constraint> wanted;
  std::vector<NailId> nails;  ///< of each of `wanted` its nail; NailId(): the target of a drag that left none
  bool reached = true;        ///< they are met
  double tolerance = 1e-9;    ///< of every row, dimensionless
  SequencePolicy sequence = SequencePolicy::prefer_start;  ///< of the session
};

}  // namespace carom
