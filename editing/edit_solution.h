#pragma once

#include <string>

#include "editing/edit_search.h"

/// The stages of solving an edit. Internal to editing/.
namespace carom {

/// Where a search ended.
struct EditSolution {
  EditPointPtr point;  ///< the best that was found
  EditPointPtr start;
  EditStatus status = EditStatus::not_converged;
  std::string message;  ///< why, when it is not solved
};

EditSolution findSolution(EditSearch& search);

/// Searches across impact sequences: looks at points spread over the bounds (or some natural scales around the start),
/// goes from the most promising onto the constraints, and minimises the change from the best of those. Null when none
/// reaches them.
EditPointPtr searchElsewhere(EditSearch& search);

/// Smallest change near `from` that meets `rows`, then all rows as well as possible. With a signature, within that
/// impact sequence. Returns the point where it ended; the search remembers the best of all.
EditPointPtr minimiseChange(EditSearch& search, const EditPointPtr& from, const std::vector<int>& rows,
                            const std::string* signature, int max_iterations);
/// The same within the impact sequence of a point that meets all rows.
EditPointPtr minimiseWithin(EditSearch& search, const EditPointPtr& point);

}  // namespace carom
