// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "adjoint/motion/contact_source.h"
#include "editing/edit_result.h"
#include "editing/session_snapshot.h"

namespace carom {

/// Other motions that meet what a session holds.
struct SessionAlternatives {
  std::vector<EditAlternative> found;  ///< verified; by increasing objective, those much_dearer last
  double least = 0;  ///< objective of the smallest change found, the current motion's included
  std::string message;  ///< why there are none; empty otherwise
};

/// Searches for at most `most` solutions other than the current motion, each the smallest change of its kind from the
/// start of the last gesture (SessionSnapshot::began), as EditOptions::alternatives does, for five seconds. Once a stop is requested it
/// ends without any. For the thread that owns `contacts`.
SessionAlternatives alternativesTo(const SessionSnapshot& snapshot, ContactSource& contacts, int most,
                                   std::stop_token stop = {});

}  // namespace carom
