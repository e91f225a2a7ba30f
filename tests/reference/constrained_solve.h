// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <vector>

#include "tests/reference/real.h"

namespace carom::reference {

using RealRows = std::vector<std::vector<Real>>;

/// The rows of a matrix that the others follow from, by Gram and Schmidt with the largest first; what is
/// left of the others is less than `least` of it.
inline std::vector<std::size_t> independentRows(RealRows rows, const Real& least = Real("1e-25")) {
  std::vector<std::size_t> chosen;
  Real largest = 0;
  for (std::size_t round = 0; round < rows.size(); ++round) {
    std::size_t best = 0;
    Real most = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Real square = 0;
      for (const Real& x : rows[i]) square += x * x;
      if (square > most) most = square, best = i;
    }
    if (round == 0) largest = most;
    if (!(most > largest * least * least)) break;
    chosen.push_back(best);
    const std::vector<Real> along = rows[best];
    for (std::vector<Real>& row : rows) {
      Real share = 0;
      for (std::size_t c = 0; c < along.size(); ++c) share += row[c] * along[c];
      for (std::size_t c = 0; c < along.size(); ++c) row[c] -= share / most * along[c];
    }
    for (Real& x : rows[best]) x = 0;
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// By elimination with pivots.
inline RealRows inverseOf(RealRows A) {
  const std::size_t n = A.size();
  RealRows X(n, std::vector<Real>(n));
  for (std::size_t i = 0; i < n; ++i) X[i][i] = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (abs(A[r][c]) > abs(A[pivot][c])) pivot = r;
    if (A[pivot][c] == 0) throw std::runtime_error("a matrix of the reference is singular");
    std::swap(A[c], A[pivot]), std::swap(X[c], X[pivot]);
    const Real over = 1 / A[c][c];
    for (std::size_t j = 0; j < n; ++j) A[c][j] *= over, X[c][j] *= over;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const Real f = A[r][c];
      for (std::size_t j = 0; j < n; ++j) A[r][j] -= f * A[c][j], X[r][j] -= f * X[c][j];
    }
  }
  return X;
}

/// B y = b for the y of least norm, whatever the rank of B.
class ConstrainedSolve {
 public:
  ConstrainedSolve() = default;
  explicit ConstrainedSolve(const RealRows& B) : rows(independentRows(B)) {
    const std::size_t r = rows.size();
    RealRows A(r, std::vector<Real>(r));
    isSquare = r == B.size();
    for (std::size_t i = 0; i < r; ++i)
      for (std::size_t j = 0; j < r; ++j) {
        if (isSquare) A[i][j] = B[i][j];
        for (std::size_t c = 0; c < B.size() && !isSquare; ++c) A[i][j] += B[rows[i]][c] * B[rows[j]][c];
      }
    inverse = inverseOf(A);
  }
  std::vector<Real> times(const std::vector<Real>& b) const {
    std::vector<Real> x(b.size());
    for (std::size_t i = 0; i < b.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) x[i] += inverse[i][j] * b[j];
    return x;
  }

  std::vector<std::size_t> rows;  ///< independent ones
  bool isSquare = true;           ///< all are
  RealRows inverse;               ///< of B, or of B B^T of the independent rows
};

}  // namespace carom::reference
