// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/output.h"
#include "explore/worlds/exploration.h"
#include "explore/worlds/summary.h"

/// What `carom explore` answers.
namespace carom::cli {

struct ExploreAnswer {
  const Exploration& exploration;
  const WorldTable& table;
  ExploreSummary summary;
  std::vector<NearWorld> nearest;
  std::uint64_t asked;  ///< worlds; more than in the table where it was stopped
};

void printExploration(Output& out, const ExploreAnswer& answer);
std::string exploreJson(const ExploreAnswer& answer);

}  // namespace carom::cli
