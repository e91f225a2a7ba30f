// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

#include "editing/edit_options.h"

/// How much work a search does. Internal to editing/.
namespace carom::editing_detail {

/// When a search ends that has a solution, all of it in steps of simulations. The allowance is the work that is done without
/// a clearly smaller change: with w for the work up to the last one found, least + w min(largest_share, w / whole), times a
/// factor where the neighbours are many or much is expected of local solves, and `most` at most. It grows with w because what took
/// long to find is often followed by smaller ones that take as long again. A search whose work would exceed `usual`, which is
/// enough for most edits, goes on until `unusual`.
struct StoppingRule {
  double least, whole, largest_share, most, usual = 0, unusual = 0;
  int rounds;  ///< without a clearly smaller change, at least; times the factor
  double least_expected = 1, most_expected = 1;  ///< limits of the factor by what is expected of local solves
  double in_all = std::numeric_limits<double>::infinity();  ///< no round begins after this much work

  double allowance(double found, double factor) const;
};

/// The work of a search, all of it counted: the same on every machine and any number of threads.
struct SearchPlan {
  int first_rounds;       ///< until a first solution
  StoppingRule stopping;  ///< after it, with rounds for smaller changes
  int small_rounds;       ///< the most of them without one, where the best is a small change within the start's sequence
  /// Of the samples of one round, in steps of simulations (SimulateOptions::step_limit): until a first solution, twice
  /// as much with each round, and after it.
  double first_steps, improving_steps;
  double unusual_multiple = 1;  ///< so many times improving_steps once the work exceeds StoppingRule::usual
  int least_samples, most_samples;  ///< of one round; the more, the cheaper one of them is
  std::size_t local_solves;         ///< points of a round from which steps go onto the constraints
  std::size_t minimised;            ///< of those that arrive, the smallest, within their sequences
  bool first_ends = false;          ///< the first solution that is confirmed ends the search, as its local solve left it
};

/// The plan of an effort.
const SearchPlan& planOf(Effort effort);

}  // namespace carom::editing_detail
