// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/shooting/multiple_shooting.h"
#include "editing/solve/edit_search.h"

/// The stages of solving an edit. Internal to editing/.
namespace carom {

/// Where a search ended.
struct EditSolution {
  EditPointPtr point;  ///< the best that was found
  EditPointPtr start;
  std::vector<EditPointPtr> others;  ///< distinct solutions, `point` among them, when alternatives are asked for
  ShootingReport shooting;
  EditStatus status = EditStatus::not_converged;
  std::string message;  ///< why, when it is not solved
};

EditSolution findSolution(EditSearch& search);

/// Smallest change near `from` that meets `rows` (of those that hold a number; ranges count always), then all rows as
/// well as possible. With a signature, within that impact sequence. Returns the point where it ended; the search
/// remembers the best of all.
EditPointPtr minimiseChange(EditSearch& search, const EditPointPtr& from, const std::vector<int>& rows,
                            const std::string* signature, int max_iterations);
/// The same within the impact sequence of a point that meets all rows.
EditPointPtr minimiseWithin(EditSearch& search, const EditPointPtr& point, int max_iterations);
/// The same along the impact sequence of a point as if its features had no edges (adjoint/simulate/replay.h). Returns the point
/// where that ended, with the motion that it really has, which may be of another sequence; or null.
EditPointPtr followSequence(EditSearch& search, const EditPointPtr& from, const std::vector<int>& rows,
                            int max_iterations);

}  // namespace carom
