// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion.h"
#include "cli/output.h"

/// The impacts of a motion for people.
namespace carom::cli {

/// More impacts than these are summed up.
inline constexpr std::size_t kMostListed = 50;

/// One row an impact.
void printImpacts(Output& out, const Motion& motion);

/// How many there are by mode, pair and body, and the ones that stand out.
void printImpactSummary(Output& out, const Motion& motion);

}  // namespace carom::cli
