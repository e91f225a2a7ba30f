// SPDX-License-Identifier: MIT
#include "adjoint/contact/symmetric_inverse.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/symmetric_eigen.hpp"

namespace carom::adjoint_detail {

using Eigen::Index;

namespace {

// Of the largest eigenvalue: less is 0. Normals and points are doubles: what they make of redundant contacts is of size
// 1e-32 in numbers of 32 digits.
template <class T>
constexpr double kNull = 1e-12;
template <>
constexpr double kNull<DoubleDouble> = 1e-28;

}  // namespace

template <class T>
std::vector<T> forceUnits(const MatrixOf<T>& K) {
  std::vector<T> units;
  for (Index k = 0; k < K.rows(); k += 3) {
    const double mean = rounded(T(K(k, k) + K(k + 1, k + 1) + K(k + 2, k + 2))) / 3;
    const bool usable = mean > 0 && std::isfinite(mean);
    units.push_back(usable ? std::ldexp(1.0, -static_cast<int>(std::floor(std::ilogb(mean) / 2.0))) : 1.0);
  }
  return units;
}

template <class T>
MatrixOf<T> symmetricInverse(const MatrixOf<T>& M, const VectorOf<T>& units, Spectrum* spectrum) {
  using std::sqrt;
  if (M.rows() == 0) return M;
  VectorOf<T> S = units;
  for (Index i = 0; i < S.size(); ++i) {  // a contact about to be released is stiff
    T most = T(1);
    for (Index j = 0; j < S.size(); ++j) most = std::max({most, T(S[i] * M(i, j) * S[j]), T(-S[i] * M(i, j) * S[j])});
    S[i] /= sqrt(most);
  }
  const MatrixOf<T> even = S.asDiagonal() * M * S.asDiagonal();
  if (!even.unaryExpr([](const T& x) { return rounded(x); }).allFinite())
    throw NotComputable("the effective masses of its contacts are beyond the range of doubles");
  const SymmetricEigen<T> eigen(even);
  VectorOf<T> values = eigen.values;
  T most = T(0);
  for (Index i = 0; i < values.size(); ++i) most = std::max({most, values[i], T(-values[i])});
  const T least = T(kNull<T>) * most;
  Spectrum found;
  for (Index i = 0; i < values.size(); ++i) {
    const bool counts = values[i] > least || values[i] < -least;
    if (!counts)
      found.singular = true;
    else
      found.condition = std::max(found.condition, std::abs(rounded(T(most / values[i]))));
    values[i] = counts ? T(T(1) / values[i]) : T(0);
  }
  if (spectrum != nullptr) *spectrum = found;
  const MatrixOf<T> scaled = S.asDiagonal() * eigen.vectors;
  return scaled * values.asDiagonal() * scaled.transpose();
}

template std::vector<double> forceUnits(const MatrixOf<double>&);
template std::vector<DoubleDouble> forceUnits(const MatrixOf<DoubleDouble>&);
template MatrixOf<double> symmetricInverse(const MatrixOf<double>&, const VectorOf<double>&, Spectrum*);
template MatrixOf<DoubleDouble> symmetricInverse(const MatrixOf<DoubleDouble>&, const VectorOf<DoubleDouble>&, Spectrum*);

}  // namespace carom::adjoint_detail
