// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>

#include "bench/edits/best_known.h"

namespace carom::bench {

/// Gives rows and exact gradients of the tasks to another program: one request a line, one line of JSON in answer.
///   task INDEX        {"numbers", "times", "lower", "upper", "row_lower", "row_upper", "hidden_changes", "hidden",
///   "best"}:
///                     bounds of the changes (null where there is none) and of the scaled rows, objectives
///   rows Y...         {"available", "rows", "jacobian"} at these changes: scaled rows by changes; without rows where
///   the
///                     motion lacks one
///   judge Y...        {"met", "objective", "residual"}, as of an answer of carom's
///   offer NAME Y...   the same, and keeps it in the file of the best known if it is met, and smaller
/// Ends with the input. Throws std::runtime_error for other requests.
void serve(std::uint64_t seed, std::istream& in, std::ostream& out, BestKnown& best);

}  // namespace carom::bench
