// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/joint_law.hpp"

// The adjoint of equation 4.4.

namespace carom::adjoint_detail {

// Adjoint of P - P_N: to the problem, and to P_N.
template <class S, class Problem, class Bar>
void frictionPullback(const Problem& p, const Branch<S>& branch, const VectorOf<S>& P_bar, VectorOf<S>& P_N_bar,
                      Bar& bar) {
  const Contacts& list = branch.list;
  const auto n = static_cast<Index>(list.size());
  VectorOf<S> X_bar(3 * n), b_bar = VectorOf<S>::Zero(p.u.size());  // b_bar: of b = u + K P_N
  for (Index c = 0; c < n; ++c)
    X_bar.template segment<3>(3 * c) = P_bar.template segment<3>(3 * list[static_cast<std::size_t>(c)]);
  const ConeBarOf<S> cone = branch.cone->pullback(X_bar);
  S kappa_bar = S(0);
  for (Index c = 0; c < n; ++c) {
    const int k = list[static_cast<std::size_t>(c)];
    const auto cc = static_cast<std::size_t>(c), kk = static_cast<std::size_t>(k);
    for (Index d = 0; d < n; ++d)
      bar.K.template block<3, 3>(3 * k, 3 * list[static_cast<std::size_t>(d)]) +=
          cone.K.template block<3, 3>(3 * c, 3 * d);
    const V3<S> own = cone.b.template segment<3>(3 * c), before = branch.b.template segment<3>(3 * k);
    kappa_bar += own.dot(before);
    b_bar.template segment<3>(3 * k) += branch.kappa * own;
    bar.normal[kk] += cone.normal[cc];
    if (branch.isPulled(p, k)) continue;
    bar.pair[kk].friction += cone.friction[cc];
    if (!Branch<S>::isIn(branch.joined, k)) {
      P_N_bar.template segment<3>(3 * k) += cone.offset[cc] * p.normal[kk];
      bar.normal[kk] += cone.offset[cc] * V3<S>(branch.P_N.template segment<3>(3 * k));
      continue;
    }
    // rise = -e n.u - n.b
    const S rise = cone.rise[cc], e = p.pair[kk].elasticity;
    const V3<S> u = p.u.template segment<3>(3 * k);
    bar.normal[kk] -= rise * (e * u + before);
    bar.pair[kk].elasticity -= rise * p.normal[kk].dot(u);
    bar.u.template segment<3>(3 * k) -= rise * e * p.normal[kk];
    b_bar.template segment<3>(3 * k) -= rise * p.normal[kk];
  }
  if (branch.lowest_e_t >= 0) bar.pair[static_cast<std::size_t>(branch.lowest_e_t)].tangential_elasticity += kappa_bar;
  bar.u += b_bar;
  bar.K += b_bar * branch.P_N.transpose();
  P_N_bar += p.K * b_bar;
}

template <class S, class Problem, class Bar>
void jointPullback(const Problem& p, const VectorOf<S>& P_bar, Bar& bar) {
  const Branch<S> branch(p, true);
  VectorOf<S> P_N_bar = P_bar;
  if (branch.cone) frictionPullback(p, branch, P_bar, P_N_bar, bar);
  VectorOf<S> share_bar;
  MatrixOf<S> N_bar;
  branch.normal[0].pullback(p, P_N_bar, bar, N_bar, share_bar);
  for (std::size_t c = 0; c < branch.normal_active.size(); ++c) {
    const int k = branch.normal_active[c];
    bar.normal[static_cast<std::size_t>(k)] += N_bar.template block<3, 1>(3 * k, static_cast<Index>(c));
    if (!Branch<S>::isConstrained(p, k)) bar.pair[static_cast<std::size_t>(k)].elasticity += share_bar[static_cast<Index>(c)];
  }
}

}  // namespace carom::adjoint_detail
