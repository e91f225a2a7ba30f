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
    moved,  ///< other features meet
    mode,   ///< it sticks where it slid, ...
    order,    ///< the same impacts in another order
    contact,  ///< contact that lasts begins, goes on or ends otherwise
    passed,   ///< an impact that comes before the last constraint in one of the motions, and after it in the other
  };
  Kind kind = Kind::order;  ///< what differs
  int before = -1;          ///< event of the motion before, -1 where there is none
  int after = -1;           ///< event of the motion after, -1 where there is none
  bool matters = true;      ///< to the constraints: false where all of it comes after the last of them
  std::string sentence;     ///< for people
};
/// The word of the documents: "went", "came", ...
const char* nameOf(SequenceChange::Kind kind);

/// How the impacts of one motion differ from those of another, of the same bodies, from begin to end; of these the first
/// `held_after` and `held_before` events can matter to constraints. Empty exactly where the signatures of all events, and of
/// those, are equal; one that matters is among them exactly where the latter differ.
std::vector<SequenceChange> wholeSequenceChanges(const Motion& before, std::size_t held_before, const Motion& after,
                                                 std::size_t held_after);

/// How the first `count_after` impacts of one motion differ from the first `count_before` of another, of the same
/// bodies. Impacts of the same bodies are matched in order, so that as few as possible come and go; empty exactly where
/// the signatures are equal.
std::vector<SequenceChange> sequenceChanges(const Motion& before, std::size_t count_before, const Motion& after,
                                            std::size_t count_after);

}  // namespace carom
