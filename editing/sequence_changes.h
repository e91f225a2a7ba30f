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
  };
  Kind kind = Kind::order;  ///< what differs
  int before = -1;          ///< event of the motion before, -1 where there is none
  int after = -1;           ///< event of the motion after, -1 where there is none
  std::string sentence;     ///< for people
};
/// The word of the documents: "went", "came", ...
const char* nameOf(SequenceChange::Kind kind);

/// How the first `count_after` impacts of one motion differ from the first `count_before` of another, of the same
/// bodies. Impacts of the same bodies are matched in order, so that as few as possible come and go; empty exactly where
/// the signatures are equal.
std::vector<SequenceChange> sequenceChanges(const Motion& before, std::size_t count_before, const Motion& after,
                                            std::size_t count_after);

}  // namespace carom
