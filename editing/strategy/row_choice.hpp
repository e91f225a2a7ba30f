// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// Which rows the solver gets. Internal to editing/.
namespace carom::editing_detail {

/// Redundant rows would stop the solver, and rows that nothing influences cannot be met.
struct RowChoice {
  std::vector<int> rows;      ///< independent, of those that hold a number: for the solver; the others are left to
                              ///< verification
  EditPointPtr from;          ///< where they are independent: the start, or a point beside it
  std::string contradiction;  ///< not empty: these constraints cannot be met together; sentences that name them
};

/// Looks at the derivatives at the start, and where rows depend on each other there, also at points beside it: what
/// holds at all of them is taken as true of the whole impact sequence, the rest as a coincidence.
RowChoice chooseRows(EditEvaluator& evaluator, const EditPointPtr& start);

}  // namespace carom::editing_detail
