// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/dual.hpp"

namespace carom::adjoint_detail {

/// A^-1 of a symmetric A of 3 rows, of doubles or of numbers of 32 digits, by LDL^T. Compiled once for each: a triangular
/// solve of several columns takes Eigen a second.
template <class T>
M3<T> inverseOfThree(const M3<T>& A);

}  // namespace carom::adjoint_detail
