// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/solve/edit_search.h"

/// Edits of long motions. Internal to editing/.
namespace carom {

/// What is to be said about multiple shooting in one edit.
struct ShootingReport {
  double growth = 0;    ///< of the start's motion, see growthOf; 0: not measured
  int segments = 0;     ///< 0: the motion was taken whole
  bool solved = false;  ///< in segments
  std::string why_not;  ///< a sentence: why there are no segments although they were asked for
};

/// Measures the growth, and says whether the motion is to be cut: as the options say, or else by the growth.
bool wantsSegments(const EditSearch& search, const EditPoint& start, ShootingReport& report);

/// Smallest change that meets `rows` (of those that hold a number; ranges count always) within the impact sequence of
/// `from`, with the states in the middle of flights as variables. What comes out is simulated whole and brought onto
/// the constraints once more. Returns the point where it ended; null where the motion cannot be cut, or what came out
/// cannot be simulated.
EditPointPtr shootInSegments(EditSearch& search, const EditPointPtr& from, const std::vector<int>& rows,
                             int max_iterations, ShootingReport& report);

/// A sentence for the result; empty where there is nothing worth saying.
std::string describe(const ShootingReport& report, const EditOptions& options, bool solved);

}  // namespace carom
