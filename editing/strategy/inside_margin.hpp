// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/solve/edit_evaluator.hpp"

/// Answers that graze. Internal to editing/.
namespace carom::editing_detail {

/// A solution moved away from a boundary beyond which an impact that a constraint needs is lost.
struct MovedInside {
  EditPointPtr point;   ///< null: it is far enough from each, or moving it costs too much
  std::string message;  ///< what was done, or what it would have cost, in a sentence; empty where it is far enough
};
/// The smallest change is often one whose hit only just grazes. Where a needed impact is lost at a change of less than
/// EditOptions::graze_margin, to first order, the point goes that far inside, or the largest share of it
/// (kInsideShares) that makes the objective larger by no more than kInsideCost of it.
MovedInside movedInside(EditEvaluator& evaluator, const EditPointPtr& point);

}  // namespace carom::editing_detail
