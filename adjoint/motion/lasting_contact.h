// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom {

/// A stretch of time in which a body rests, slides, rolls or pivots on one that stands still, all the time at the same
/// features.
struct LastingContact {
  int body = -1;                      ///< on a path in contact
  int with = -1;                      ///< what it is in contact with
  ArcKind kind = ArcKind::rest;       ///< what it does there
  std::vector<FeaturePair> features;  ///< where the two touch, as in the contacts of events
  double from = 0;                    ///< s
  double to = 0;                      ///< s; Motion::end where it goes on
};

/// All lasting contacts of a motion, in increasing order of when they begin; of a body on several others, one for each.
/// A body that is hit and goes on in the same way, at the same features, does so in one stretch: the hit is among the
/// events. What ends at the instant in which it begins is left out. Throws InputError for a motion whose events were
/// not recorded.
std::vector<LastingContact> lastingContacts(const Motion& motion);

/// How bodies go on after an event otherwise than before it, for people: "ball rolls", "die pivots", "die comes to rest"; empty where
/// nothing changes, and where the motion could not go on. Throws InputError for an event that is not there.
std::string describeChanges(const Motion& motion, int event);

}  // namespace carom
