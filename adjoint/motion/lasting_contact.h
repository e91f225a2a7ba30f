// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom {

/// An interval of persistent contact: a body rests, slides, rolls or pivots on a fixed one, or rests on another that rests, at
/// the same features throughout. Of two bodies that rest on each other it is listed once, with that on top.
struct LastingContact {
  int body = -1;                      ///< on a path in contact
  int with = -1;                      ///< what it is in contact with
  ArcKind kind = ArcKind::rest;       ///< what it does there
  std::vector<FeaturePair> features;  ///< where the two touch, as in the contacts of events
  double from = 0;                    ///< s
  double to = 0;                      ///< s; Motion::end if it continues
};

/// All persistent contacts of a motion, by increasing start time; for a body on several others, one each. A hit after
/// which the body continues in the same way at the same features does not split its interval: the hit is among the
/// events. Empty intervals are omitted. Throws InputError for a motion whose events were not recorded.
std::vector<LastingContact> lastingContacts(const Motion& motion);

/// Changes of contact mode at an event, as text: "ball rolls", "die pivots", "die comes to rest"; empty if nothing
/// changes, or if the motion ends there. Throws InputError for an invalid event.
std::string describeChanges(const Motion& motion, int event);

}  // namespace carom
