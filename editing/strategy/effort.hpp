// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

#include "editing/edit_options.h"

/// How much work a search does. Internal to editing/.
namespace carom::editing_detail {

/// How long a search goes on without a clearly smaller change, in steps of simulations: what took long to find is often
/// followed by smaller ones that take as long again. With w for the work up to the last one that was found, so much more is
/// done without another: least + w min(largest_share, w / whole), a multiple of it where the neighbours are many or
/// much is expected of landings, and `most` at most. A search that would end with more than `usual` in all, which most edits do
/// with, goes on until `unusual`.
struct Patience {
  double least, whole, largest_share, most, usual = 0, unusual = 0;
  int rounds;  ///< as many, or the multiple, at least
  double least_expected = 1, most_expected = 1;  ///< limits of the multiple by what is expected of landings
  double in_all = std::numeric_limits<double>::infinity();  ///< no round begins once so much is done

  double after(double work, double multiple) const;
};

/// The work of a search, all of it counted: the same on every machine and any number of threads.
struct SearchPlan {
  int first_rounds;      ///< until a first solution
  Patience patience;     ///< after it, with rounds for smaller changes
  int small_rounds;      ///< the most of them without one, where the best is a small change within the start's sequence
  /// Of the samples of one round, in steps of simulations (SimulateOptions::step_limit): until a first solution, twice
  /// as much with each round, and after it.
  double first_steps, improving_steps;
  double unusual_multiple = 1;  ///< so many times improving_steps once more work is done than is usual (Patience)
  int least_samples, most_samples;  ///< of one round; the more, the cheaper one of them is
  std::size_t landings;             ///< points of a round from which steps go onto the constraints
  std::size_t minimised;            ///< of those that arrive, the smallest, within their sequences
};

/// The plan of an effort.
const SearchPlan& planOf(Effort effort);

}  // namespace carom::editing_detail
