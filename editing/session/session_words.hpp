// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/sequence_changes.h"

/// The sentences of sessions. Internal to editing/.
namespace carom::editing_detail {

/// "at 0.6 s", "at its impact 3 with 'table'", "between 1 s and 2 s".
std::string wordsOf(const When& at);
/// "'hat' at 0.6 s"; of one that holds regions alone "'hat'".
std::string wordsOf(const Constraint& constraint);

/// Why a motion ends before its duration: a sentence; empty for one that does not.
std::string earlyEnd(const Motion& motion);
/// Who meets whom otherwise than before: a sentence; empty where nothing changed.
std::string otherImpacts(const std::vector<SequenceChange>& changes, const Motion& before, const Motion& after);

}  // namespace carom::editing_detail
