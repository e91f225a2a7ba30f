// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/numeric/dual.hpp"
#include "adjoint/numeric/double_double.hpp"

namespace carom::adjoint_detail {

/// Of the eigenvalues that are not 0, the ratio of the largest to the least.
struct Spectrum {
  bool singular = false;
  double condition = 1;
};

/// A generalised inverse of a symmetric M, found in units of the rows in which its numbers are of like size. T is
/// double or DoubleDouble. `spectrum`, if given, is filled. Throws NotComputable for numbers that are not finite.
template <class T>
MatrixOf<T> symmetricInverse(const MatrixOf<T>& M, const VectorOf<T>& units, Spectrum* spectrum = nullptr);

/// Units of force of each contact in which the diagonal of K, 3 rows a contact, is alike: powers of 2.
template <class T>
std::vector<T> forceUnits(const MatrixOf<T>& K);

}  // namespace carom::adjoint_detail
