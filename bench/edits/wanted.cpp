// SPDX-License-Identifier: MIT
#include "bench/edits/wanted.h"

#include <iterator>
#include <stdexcept>
#include <string>

namespace carom::bench {
namespace {

Wanted thrown(int index) {
  constexpr int kCombined = kThrownFamilies * kThrownGoals;
  const int family = index % kThrownFamilies, goal = index / kThrownFamilies % kThrownGoals, round = index / kCombined;
  // Rounds shift the number of impacts; 3 has no factor in common with 16 or 8, so all combinations come.
  const int impacts = 1 + (round + 3 * family + 2 * goal) % kMostImpacts;
  return {static_cast<Family>(family), static_cast<Goal>(goal), impacts, index % 3 == 2};
}

/// As many tasks of a family, after those of the blocks before it.
struct Block {
  Family family;
  int tasks;
};
constexpr Block kBlocks[] = {
    {Family::chain, 96}, {Family::encounter, 48}, {Family::hit, 72},      {Family::required, 60},
    {Family::rack, 24},  {Family::speed, 30},     {Family::distance, 30},
};

// The k-th of a family.
Wanted anywhere(Family family, int k) {
  Wanted w;
  w.family = family;
  const bool at_impact = k % 2 == 1;
  w.goal = at_impact ? Goal::at_an_impact : Goal::at_a_time;
  switch (family) {
    case Family::chain:
      w.balls = 1 + k / 2 % 3, w.rails = k / 6 % 4;
      break;
    case Family::hit:
      w.kind = k, w.goal = k / 2 % 3 == 2 ? Goal::impact_comes : Goal::at_an_impact;
      break;
    case Family::required:
      w.kind = k, w.goal = Goal::impact_comes;
      break;
    case Family::speed:
      w.kind = k, w.goal = k % 4 == 3 ? Goal::at_an_impact : Goal::at_a_time;
      break;
    case Family::distance:
      w.kind = k, w.goal = Goal::at_a_time;
      break;
    case Family::rack:
      w.balls = 2 + k % 3, w.goal = Goal::at_a_time;
      break;
    default:
      break;
  }
  return w;
}

}  // namespace

const char* nameOf(Family family) {
  constexpr const char* kNames[] = {"ball", "box",    "hull", "meeting", "chain",   "encounter",
                                    "hit",  "required", "rack", "speed",   "distance"};
  static_assert(std::size(kNames) == kFamilies);
  return kNames[static_cast<int>(family)];
}

const char* nameOf(Goal goal) {
  constexpr const char* kNames[] = {"at_a_time", "at_an_impact", "pose", "two_nails", "impact_comes"};
  return kNames[static_cast<int>(goal)];
}

Wanted wantedOf(int index) {
  if (index >= 0 && index < kThrownTasks) return thrown(index);
  int k = index - kThrownTasks;
  for (const Block& block : kBlocks) {
    if (k >= 0 && k < block.tasks) return anywhere(block.family, k);
    k -= block.tasks;
  }
  throw std::out_of_range("found task " + std::to_string(index) + ", expected one of 0 to " +
                          std::to_string(kTasks - 1));
}

}  // namespace carom::bench
