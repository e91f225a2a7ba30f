// SPDX-License-Identifier: MIT
#pragma once

#include "editing/nlp_evaluator.h"
#include "python/src/arrays.hpp"

namespace carom::python {

/// Values (count, rows) of all rows at points (count, variables), and their Jacobians (count, rows, variables), or None;
/// computed in that many threads.
nb::tuple rowsAt(const NlpEvaluator& evaluator, const ArrayLike& x, bool with_jacobian, int threads);

}  // namespace carom::python
