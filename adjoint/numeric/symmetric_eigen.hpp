// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/dual.hpp"

namespace carom::adjoint_detail {

/// A = V diag(values) V^T of a symmetric matrix of doubles or of numbers of 32 digits, V orthonormal, values in increasing
/// order. Eigen's solver, which takes half a minute to compile, is compiled once for each. Entries must be finite.
template <class T>
struct SymmetricEigen {
  explicit SymmetricEigen(const MatrixOf<T>& A);

  VectorOf<T> values;
  MatrixOf<T> vectors;
};

}  // namespace carom::adjoint_detail
