// SPDX-License-Identifier: MIT
#pragma once

#include "editing/solve/edit_evaluator.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// From a point that meets the constraints, along the boundaries of its impact sequence, towards the smallest change within
/// them. Each step goes to the minimum of |z|^2 / 2 subject to the rows and the boundaries as they are linear around the
/// point; along the boundaries that hinder it, with what ReducedHessian has learned of their bends. Where it misses an
/// impact, it is led back to it; it is shortened until the sequence stays and the change falls. Returns the last point,
/// or the first where none is smaller.
EditPointPtr minimiseAlongBoundary(EditEvaluator& evaluator, EditPointPtr point, int max_steps);

}  // namespace carom::editing_detail
