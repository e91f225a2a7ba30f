// SPDX-License-Identifier: MIT
#pragma once

namespace carom::bench {

/// What is thrown.
enum class Family { ball, box, hull, meeting };
/// What is held: places or velocities at a time; at an impact, whose time is free or not; place and orientation; places
/// at two times or of two bodies.
enum class Goal { at_a_time, at_an_impact, pose, two_nails };

inline constexpr int kFamilies = 4, kGoals = 4, kMostImpacts = 8;
const char* nameOf(Family family);
const char* nameOf(Goal goal);

/// What task number `index` has to be like. All families and goals come equally often, each with every number of
/// impacts; every third task needs another impact sequence.
struct Wanted {
  Family family = Family::ball;
  Goal goal = Goal::at_a_time;
  int impacts = 1;  ///< of all bodies together, up to the last constraint, in the hidden throw
  bool other_sequence = false;
};
Wanted wantedOf(int index);

}  // namespace carom::bench
