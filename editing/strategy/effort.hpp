// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "editing/edit_options.h"

/// How much work a search does. Internal to editing/.
namespace carom::editing_detail {

/// The work of a search, all of it counted: the same on every machine and any number of threads.
struct SearchPlan {
  int first_rounds;      ///< until a first solution
  int improving_rounds;  ///< after it, for smaller changes
  /// So many in a row without a clearly smaller change end them: where the impacts are those of the start or few, and
  /// where they are many others.
  int idle_rounds, idle_rounds_of_many;
  /// Of the samples of one round, in steps of simulations (SimulateOptions::step_limit): until a first solution, twice
  /// as much with each round, and after it.
  double first_steps, improving_steps;
  int least_samples, most_samples;  ///< of one round; the more, the cheaper one of them is
  std::size_t landings;             ///< points of a round from which steps go onto the constraints
  std::size_t minimised;            ///< of those that arrive, the smallest, within their sequences
};

/// The plan of an effort.
const SearchPlan& planOf(Effort effort);

}  // namespace carom::editing_detail
