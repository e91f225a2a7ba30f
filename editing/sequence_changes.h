// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom {

/// One difference between two impact sequences.
struct SequenceChange {
  /// What differs.
  enum class Kind {
    went,   ///< an impact no longer happens
    came,   ///< an impact happens that did not
    moved,  ///< at other features
    mode,   ///< it sticks instead of sliding, ...
    order,    ///< the same impacts in another order
    contact,  ///< persistent contact begins, continues or ends differently
    passed,   ///< an impact is before the last constraint in one of the motions, and after it in the other
  };
  Kind kind = Kind::order;  ///< what differs
  int before = -1;          ///< event of the motion before, -1 if none
  int after = -1;           ///< event of the motion after, -1 if none
  bool matters = true;      ///< to the constraints: false if all of it is after the last of them
  std::string sentence; ///< as text
};
/// The word in answers: "went", "came", ...
const char* nameOf(SequenceChange::Kind kind);

/// Differences between the impact sequences of two motions of the same bodies; the first `held_after` and
/// `held_before` events can affect constraints. Empty exactly if the signatures of all events, and of those, are
/// equal; contains one that matters exactly if the latter differ.
std::vector<SequenceChange> wholeSequenceChanges(const Motion& before, std::size_t held_before, const Motion& after,
                                                 std::size_t held_after);

/// Differences between the first `count_after` and `count_before` impacts of two motions of the same bodies. Impacts
/// of the same bodies are matched in order with as few insertions and deletions as possible; empty exactly if the
/// signatures are equal.
std::vector<SequenceChange> sequenceChanges(const Motion& before, std::size_t count_before, const Motion& after,
                                            std::size_t count_after);

}  // namespace carom
