// SPDX-License-Identifier: MIT
#pragma once

namespace carom::bench {

/// What happens. The first four are throws whose start is near a hidden one and has everything that is held; the others
/// start anywhere, and what they hold may not come at all there: balls on a table that strike one another and rails;
/// two flights that miss each other; an impact with a body that is missed; a required sequence of impacts; a rack of
/// balls that is broken; throws of which a speed, an energy, a height or an impulse is held; two bodies
/// that are as far from each other as is wanted.
enum class Family { ball, box, hull, meeting, chain, encounter, hit, required, rack, speed, distance };
/// What is held: places or velocities at a time; at an impact, whose time is free or not; place and orientation; places
/// at two times or of two bodies; nothing but that an impact comes.
enum class Goal { at_a_time, at_an_impact, pose, two_nails, impact_comes };

inline constexpr int kFamilies = 11, kThrownFamilies = 4, kGoals = 5, kThrownGoals = 4, kMostImpacts = 8;
/// Throws with a start near by, then all others.
inline constexpr int kThrownTasks = 300, kTasks = 660;
const char* nameOf(Family family);
const char* nameOf(Goal goal);

/// What task number `index` has to be like.
struct Wanted {
  Family family = Family::ball;
  Goal goal = Goal::at_a_time;
  int impacts = 1;  ///< of all bodies together, up to the last constraint, in the hidden throw
  /// The impacts of the hidden throw up to the last constraint are others than those of the start.
  bool other_sequence = false;
  int balls = 0;  ///< chain: that are struck one after another; rack: its layers
  int rails = 0;  ///< chain: struck on the way
  int kind = 0;   ///< hit, required, speed: which of several
};
/// Of 0 ... kTasks - 1. Of the throws all families and goals come equally often, each with every number of impacts;
/// every third needs another impact sequence. Of the others `impacts` and `other_sequence` are left to the draw.
/// Throws std::out_of_range for other numbers.
Wanted wantedOf(int index);

}  // namespace carom::bench
