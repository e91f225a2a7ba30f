// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/complementarity.hpp"
#include "adjoint/numeric/dual.hpp"

/// Solves of least norm for any number, with their adjoints.
namespace carom::adjoint_detail {

using Eigen::Index;

template <class S>
struct LeastNorm : LeastNormSolveOf<S> {
  using LeastNormSolveOf<S>::LeastNormSolveOf;
};
/// LeastNormSolve of duals, at constant rank:
///   dA^+ = -A^+ dA A^+ + A^+ A^+ dA (1 - A A^+) + (1 - A A^+) dA A^+ A^+.
template <int N, class T>
struct LeastNorm<Dual<N, T>> {
  using S = Dual<N, T>;
  MatrixOf<S> inverse, rest;
  VectorOf<S> y, inverse_y;

  LeastNorm(const MatrixOf<S>& A, const VectorOf<S>& b) {
    const LeastNormSolveOf<T> now(valuesOf(A), valuesOf(b));
    inverse = now.inverse.template cast<S>();
    y = now.y.template cast<S>();  // its rates from those of A and b: those of A^+ have lost digits
    rest = now.rest.template cast<S>();
    const MatrixOf<T> twice = now.inverse * now.inverse;
    for (std::size_t i = 0; i < N; ++i) {
      const MatrixOf<T> dA = ratesOf(A, i), across = now.rest * dA * now.inverse, up = now.rest * dA * twice;
      setRates(inverse, MatrixOf<T>(up + up.transpose() - now.inverse * dA * now.inverse), i);
      setRates(rest, MatrixOf<T>(-across - across.transpose()), i);
      setRates(y, now.tangent(dA, ratesOf(b, i)), i);
    }
    inverse_y = inverse * y;
  }
};

// Impulses P = C y from directions C (contacts x directions) that are to receive the velocity change -s o (C^T u).
template <class S>
struct DirectedSolve {
  MatrixOf<S> C;
  VectorOf<S> share;  // s
  LeastNorm<S> solve;

  template <class Problem>
  DirectedSolve(const Problem& p, MatrixOf<S> directions, VectorOf<S> shares)
      : C(std::move(directions)),
        share(std::move(shares)),
        solve(C.transpose() * p.K * C, share.cwiseProduct(C.transpose() * p.u)) {}

  VectorOf<S> impulse() const { return C * solve.y; }

  template <class Problem, class Bar>
  void pullback(const Problem& p, const VectorOf<S>& P_bar, Bar& bar, MatrixOf<S>& C_bar,
                VectorOf<S>& share_bar) const {
    // the adjoint of LeastNorm
    const VectorOf<S> y_bar = C.transpose() * P_bar, b_bar = -solve.inverse * y_bar;
    const MatrixOf<S> A_bar =
        b_bar * solve.y.transpose() + (solve.rest.transpose() * y_bar) * solve.inverse_y.transpose();
    const VectorOf<S> v_bar = share.cwiseProduct(b_bar);
    share_bar = b_bar.cwiseProduct(C.transpose() * p.u);
    C_bar = P_bar * solve.y.transpose() + p.K * C * (A_bar + A_bar.transpose()) + p.u * v_bar.transpose();
    bar.K += C * A_bar * C.transpose();
    bar.u += C * v_bar;
  }
};

}  // namespace carom::adjoint_detail
