// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/edit_result.h"
#include "editing/solve/edit_evaluator.hpp"

/// The stages of solving an edit. Internal to editing/.
namespace carom::editing_detail {

/// Where a search ended.
struct EditSolution {
  EditPointPtr point;  ///< the best that was found
  EditPointPtr start;
  std::vector<EditPointPtr> others;  ///< distinct solutions, `point` among them, when alternatives are asked for
  double growth = 0;                 ///< of the start's motion, see growthOf; 0: not measured
  EditStatus status = EditStatus::not_converged;
  std::string message;  ///< why, when it is not solved; else what is to be said of a boundary that is near
  bool tells_all = false;  ///< the message is a proof that names what would have to be otherwise, see Impossible: nothing is tried
  std::vector<WhyNot::Inside> inside = {};  ///< as there
  std::string contradiction;  ///< which constraints are in conflict in the start's impacts; may be empty
};

EditSolution findSolution(EditEvaluator& evaluator);

}  // namespace carom::editing_detail
