// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/contact/cone_program.hpp"
#include "adjoint/impact/complementarity.hpp"
#include "adjoint/numeric/dual.hpp"

namespace carom::adjoint_detail {

using Contacts = std::vector<int>;

/// Far more contacts than a body has ways to move lose the active set; without friction they are a cone program, too.
template <class T, class S, class Problem>
Contacts pushingByProgram(const Problem& p, const VectorOf<S>& shares, const MatrixOf<T>& A, const VectorOf<T>& b) {
  const std::size_t n = p.normal.size();
  ConeProgramOf<T> q{valuesOf(p.K),           valuesOf(p.u), {}, std::vector<T>(n, T(0)),
                     std::vector<T>(n, T(0)), p.held,        {}, {}};
  q.free.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    q.b.template segment<3>(3 * static_cast<Index>(k)) *= valueOf(shares[static_cast<Index>(k)]);
    q.normal.push_back(valuesOf(p.normal[k]));
  }
  const ConePointOf<T> at = solveConeProgram<T>(q);
  VectorOf<T> y = VectorOf<T>::Zero(static_cast<Index>(n));
  for (std::size_t k = 0; k < n; ++k)
    if (at.state[k] != ConeState::apex) y[static_cast<Index>(k)] = at.pressure[k];
  return pushingContactsOf<T>(A, b, y, p.held);
}

}  // namespace carom::adjoint_detail
