// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "cli/output.h"

/// The impacts of a motion for people.
namespace carom::cli {

/// More impacts than these are summed up.
inline constexpr std::size_t kMostListed = 50;

/// The events that people are told of, in their order: impacts, and changes of what lasts. Bounces too low to be
/// impacts are left out.
std::vector<std::size_t> toldEvents(const Motion& motion);

/// One row for each of them; impacts are numbered.
void printImpacts(Output& out, const Motion& motion);

/// How many impacts there are by mode, pair and body, and the ones that stand out.
void printImpactSummary(Output& out, const Motion& motion);

/// A sequence of impacts, one line each; of more than kMostListed only the first, unless `all` are asked for.
void printSequence(Output& out, const std::vector<std::string>& sequence, bool all);

/// The same of two motions, one changed into the other. Of long ones only what follows where they part.
void printSequences(Output& out, const std::vector<std::string>& before, const std::vector<std::string>& after,
                    bool all);

}  // namespace carom::cli
