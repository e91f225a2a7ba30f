// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "editing/nlp_evaluator.h"
#include "python/src/arrays.hpp"
#include "python/src/interruptible.hpp"

namespace carom::python {

/// All rows at many points, in C order.
struct RowsOfMany {
  std::vector<double> values;   ///< (count, rows)
  std::vector<double> entries;  ///< Jacobians (count, rows, variables); empty if they are not wanted
};

/// Evaluates points x (count, variables), in C order, in that many threads; without the GIL. Throws what the watch has met,
/// else what the first point throws that cannot be evaluated.
RowsOfMany rowsOfMany(const NlpEvaluator& evaluator, const double* x, std::size_t count, bool with_jacobian, int threads,
                      Watch& watch);

/// The same as arrays, values and Jacobians or None; with the GIL.
nb::tuple rowsAt(const NlpEvaluator& evaluator, const ArrayLike& x, bool with_jacobian, int threads);

}  // namespace carom::python
