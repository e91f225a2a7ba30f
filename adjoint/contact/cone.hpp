// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/numeric/dual.hpp"
#include "adjoint/numeric/double_double.hpp"

/// Forces, or impulses, of friction of several contacts as one convex problem.
namespace carom::adjoint_detail {

/// Minimise f.K f/2 + b.f over f with, of every contact, |f_t| <= mu (f_n + offset) and f_n + offset >= 0, and of the
/// contacts `equal`, n.(K f) = rise. K is symmetric and positive semidefinite. f = 0 need not be admissible.
template <class S>
struct ConeProgramOf {
  MatrixOf<S> K;              ///< 3N x 3N
  VectorOf<S> b;              ///< 3N
  std::vector<V3<S>> normal;  ///< N
  std::vector<S> friction;    ///< N, mu
  std::vector<S> offset;      ///< N
  std::vector<char> free;     ///< N: along its normal alone, with either sign, whatever mu and offset
  std::vector<int> equal;     ///< contacts, in increasing order
  std::vector<S> rise;        ///< one of each of `equal`

  int contacts() const { return static_cast<int>(normal.size()); }
};

/// Where the solution stands in the cone of a contact: at its apex, on its side, inside, or free of it.
enum class ConeState : char { apex, slides, inside, free };

/// A point of the program: the active set, and what varies on it.
template <class S>
struct ConePointOf {
  std::vector<ConeState> state;  ///< N
  std::vector<V3<S>> f;          ///< N, used where inside
  std::vector<S> pressure;       ///< N, f_n + offset where it slides; f_n where free
  std::vector<V3<S>> direction;  ///< N, of f_t where it slides, a unit vector; 0 where mu = 0 and nothing slips
  VectorOf<S> lambda;            ///< multipliers of `equal`
};

}  // namespace carom::adjoint_detail
