// SPDX-License-Identifier: MIT
#include "bench/edits/wanted.h"

namespace carom::bench {

const char* nameOf(Family family) {
  constexpr const char* kNames[] = {"ball", "box", "hull", "meeting"};
  return kNames[static_cast<int>(family)];
}

const char* nameOf(Goal goal) {
  constexpr const char* kNames[] = {"at_a_time", "at_an_impact", "pose", "two_nails"};
  return kNames[static_cast<int>(goal)];
}

Wanted wantedOf(int index) {
  const int family = index % kFamilies, goal = index / kFamilies % kGoals, round = index / (kFamilies * kGoals);
  // Rounds shift the number of impacts; 3 has no factor in common with 16 or 8, so all combinations come.
  const int impacts = 1 + (round + 3 * family + 2 * goal) % kMostImpacts;
  return {static_cast<Family>(family), static_cast<Goal>(goal), impacts, index % 3 == 2};
}

}  // namespace carom::bench
