// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

#include "adjoint/base/errors.h"
#include "adjoint/impact/directed_solve.hpp"
#include "adjoint/numeric/wide.hpp"

// Equation 4.3, contacts of one instant together, each with u_n <= 0 before:
//   P_N: normal impulses, 0 <= P_N,k, u_n,k+ >= -e_k u_n,k, complementary;   P_I: the same with e = 0;
//   P_II: impulses that stop every active contact with friction altogether and the others along their normals;
//   P = P_N + kappa (P_II - P_I), kappa = 1 + min e_t cut back to where the first contact reaches its friction cone, or
//   comes off no faster than its e says.
// One contact gives 4.1 and 4.2. Energy: with |.| the norm of K, the change is
// 1/2 sum P_N,k (1 - e_k) u_n,k - kappa (1 - kappa/2) |P_II - P_I|^2 at the most, which is <= 0 for kappa in [0, 2].
// Where a kinematic body takes part, u need not be a velocity that impulses can undo. P_N still exists unless a body is
// squeezed between ones that nothing moves; where P would let a contact come off slower than its e says, P = P_N.
// What comes out is held against these conditions: where rounding has spoilt them there is no answer but NotComputable.
// Redundant contacts (a face on a plane) make K singular; impulses of least norm are taken, velocities are unique.
//
// Written for any number: doubles, numbers of 32 digits, and duals of either, which take the branch of the values. A
// `Problem` has the fields of ImpactProblem, a `Bar` those of ImpactProblemDerivative.

namespace carom::adjoint_detail {

/// |v|; at 0, where it has no derivative and nothing asks for one, without rates.
template <class S>
S normOf(const V3<S>& v) {
  using std::sqrt;
  const S square = v.dot(v);
  return square == S(0) ? S(0) : S(sqrt(square));
}

using Contacts = std::vector<int>;

template <class Problem>
bool hasFriction(const Problem& p, int k) {
  return p.pair[static_cast<std::size_t>(k)].friction > 0;
}

// Directions of the impulses of a list of contacts: their normals; all three of contacts with friction that `stick`.
template <class S, class Problem>
MatrixOf<S> directionsOf(const Problem& p, const Contacts& list, bool stick) {
  MatrixOf<S> C = MatrixOf<S>::Zero(p.u.size(), 3 * static_cast<Index>(list.size()));
  Index at = 0;
  for (int k : list) {
    if (stick && hasFriction(p, k)) {
      C.template block<3, 3>(3 * k, at).setIdentity();
      at += 3;
    } else {
      C.template block<3, 1>(3 * k, at++) = p.normal[static_cast<std::size_t>(k)];
    }
  }
  return C.leftCols(at);
}

// Its adjoint.
template <class S, class Problem, class Bar>
void addDirections(const Problem& p, const Contacts& list, bool stick, const MatrixOf<S>& C_bar, Bar& bar) {
  Index at = 0;
  for (int k : list) {
    const bool whole = stick && hasFriction(p, k);
    if (!whole) bar.normal[static_cast<std::size_t>(k)] += C_bar.template block<3, 1>(3 * k, at);
    at += whole ? 3 : 1;
  }
}

// The branch of the law with its three solves.
template <class S>
struct Branch {
  using T = Value<S>;
  Contacts normal_active, plastic_active, directions;  // directions: contacts of P_II, their union
  bool friction = false;
  S kappa = 0;
  int limit = -1;       // contact that cuts kappa back, -1: none does
  bool by_cone = true;  // its friction cone does; else it parts as slowly as it may
  int lowest_e_t = -1;  // contact that gives kappa when none does
  double margin = 1;
  VectorOf<S> P_N, d;
  std::vector<DirectedSolve<S>> solves;  // P_N, P_I, P_II

  template <class Problem>
  explicit Branch(const Problem& p) {
    const int n = static_cast<int>(p.normal.size());
    Contacts all(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) all[static_cast<std::size_t>(k)] = k;
    const MatrixOf<S> N = directionsOf<S>(p, all, false);
    const MatrixOf<S> A = N.transpose() * p.K * N;
    const VectorOf<S> u_n = N.transpose() * p.u;
    normal_active = activeContactsOf<T>(valuesOf(A), valuesOf(VectorOf<S>(share(p, all).cwiseProduct(u_n))), !p.driven);
    solves.emplace_back(p, directionsOf<S>(p, normal_active, false), share(p, normal_active));
    P_N = solves[0].impulse();
    d = VectorOf<S>::Zero(3 * n);
    P_N_gain = p.K * P_N;
    if (!parts(p))
      throw NotComputable(p.driven ? "no impulses part its contacts, one of which moves by itself"
                                   : "the impulses that part all of its contacts are lost in rounding");
    friction = std::any_of(p.pair.begin(), p.pair.end(), [](const auto& c) { return c.friction > 0; });
    if (!friction) return;
    plastic_active = activeContactsOf<T>(valuesOf(A), valuesOf(u_n), !p.driven);
    std::set_union(normal_active.begin(), normal_active.end(), plastic_active.begin(), plastic_active.end(),
                   std::back_inserter(directions));
    solves.emplace_back(p, directionsOf<S>(p, plastic_active, false), ones(plastic_active.size()));
    const MatrixOf<S> C = directionsOf<S>(p, directions, true);
    solves.emplace_back(p, C, ones(static_cast<std::size_t>(C.cols())));
    d = solves[2].impulse() - solves[1].impulse();
    d_gain = p.K * d;
    cutBack(p);
    if (!p.driven) cutToPart(p);
    if (parts(p)) return;
    if (!p.driven) throw NotComputable("the impulses of friction that part all of its contacts are lost in rounding");
    leaveOutFriction();
  }

  VectorOf<S> P_N_gain, d_gain;  // of velocity, by P_N and by d

  // Velocities along the normal of contact k: before, gained by P_N and by d; and the size of what they are made of.
  struct Normal {
    T before, by_P_N, by_d, size;
  };
  template <class Problem>
  Normal alongNormal(const Problem& p, int k) const {
    using std::abs;
    const auto kk = static_cast<std::size_t>(k);
    const V3<T> n = valuesOf(p.normal[kk]), u = valuesOf(V3<S>(p.u.template segment<3>(3 * k))),
                N = valuesOf(V3<S>(P_N_gain.template segment<3>(3 * k)));
    Normal v{n.dot(u), n.dot(N), T(0), T(u.cwiseAbs().maxCoeff()) + T(N.cwiseAbs().maxCoeff())};
    if (d_gain.size() == 0) return v;
    const V3<T> D = valuesOf(V3<S>(d_gain.template segment<3>(3 * k)));
    v.by_d = n.dot(D);
    v.size += T(D.cwiseAbs().maxCoeff());
    return v;
  }
  // Rounding of a contact's velocities: of its own, and far less of the fastest one's.
  template <class Problem>
  std::vector<Normal> alongNormals(const Problem& p) const {
    std::vector<Normal> all;
    T fastest = T(0);
    for (int k = 0; k < static_cast<int>(p.normal.size()); ++k) {
      all.push_back(alongNormal(p, k));
      if (all.back().size > fastest) fastest = all.back().size;
    }
    for (Normal& v : all) v.size = T(1e-9) * v.size + T(1e-12) * fastest;
    return all;
  }

  // Whether every contact comes off as fast as its e says. Surfaces of bodies that nothing moves may go different ways:
  // no impulses stop the others on all of them then.
  template <class Problem>
  bool parts(const Problem& p) const {
    const std::vector<Normal> along = alongNormals(p);
    for (std::size_t k = 0; k < along.size(); ++k) {
      const Normal& v = along[k];
      const T e = valueOf(S(p.pair[k].elasticity));
      if (!(v.before + v.by_P_N + valueOf(kappa) * v.by_d >= -e * v.before - v.size)) return false;
    }
    return true;
  }
  static bool isIn(const Contacts& list, int k) { return std::binary_search(list.begin(), list.end(), k); }

  // P_II - P_I may slow down contacts that P_N parts without pushing them: kappa stops where the first of them comes off
  // as slowly as its e lets it.
  template <class Problem>
  void cutToPart(const Problem& p) {
    const std::vector<Normal> along = alongNormals(p);
    for (int k = 0; k < static_cast<int>(along.size()); ++k) {
      const auto kk = static_cast<std::size_t>(k);
      const Normal& v = along[kk];
      if (isIn(plastic_active, k) || !(valueOf(kappa) * v.by_d < -v.size)) continue;
      if (isIn(normal_active, k)) return leaveOutFriction();  // it comes off as slowly as it may already
      const S spare = spareOf(p, k), loss = lossOf(p, k);
      if (!(spare > 0)) return leaveOutFriction();
      if (spare < kappa * loss) kappa = spare / loss, limit = k, by_cone = false;
    }
  }
  // What contact k has above the least speed that it may part with, after P_N; and what d takes of it.
  template <class Problem>
  S spareOf(const Problem& p, int k) const {
    const auto kk = static_cast<std::size_t>(k);
    const V3<S> u = p.u.template segment<3>(3 * k), gain = P_N_gain.template segment<3>(3 * k);
    const S e = p.pair[kk].elasticity;
    return (1 + e) * p.normal[kk].dot(u) + p.normal[kk].dot(gain);
  }
  template <class Problem>
  S lossOf(const Problem& p, int k) const {
    return -p.normal[static_cast<std::size_t>(k)].dot(V3<S>(d_gain.template segment<3>(3 * k)));
  }
  void leaveOutFriction() {
    friction = false;
    kappa = 0;
    d.setZero();
    limit = lowest_e_t = -1;
    margin = 1;
  }

  static VectorOf<S> ones(std::size_t n) { return VectorOf<S>::Ones(static_cast<Index>(n)); }
  template <class Problem>
  static VectorOf<S> share(const Problem& p, const Contacts& list) {
    VectorOf<S> s(static_cast<Index>(list.size()));
    for (std::size_t c = 0; c < list.size(); ++c)
      s[static_cast<Index>(c)] = 1 + p.pair[static_cast<std::size_t>(list[c])].elasticity;
    return s;
  }
  template <class Problem>
  void cutBack(const Problem& p) {
    kappa = 2;
    for (int k : directions) {
      const S bound = 1 + p.pair[static_cast<std::size_t>(k)].tangential_elasticity;
      if (hasFriction(p, k) && (lowest_e_t < 0 || bound < kappa)) kappa = bound, lowest_e_t = k;
    }
    if (lowest_e_t < 0) kappa = 0;
    for (int k : directions) {
      const auto kk = static_cast<std::size_t>(k);
      const V3<S> dk = d.template segment<3>(3 * k), n = p.normal[kk];
      const S mu = p.pair[kk].friction, d_n = n.dot(dk), along = n.dot(P_N.template segment<3>(3 * k));
      const S P_n = along > 0 ? along : S(0);
      const S s = mu > 0 ? S(normOf<S>(dk - d_n * n) / mu) : S(0), slope = s - d_n;
      if (slope > 0 && P_n < kappa * slope) kappa = P_n / slope, limit = k;
      const double whole = rounded(valueOf(S(P_n + kappa * d_n))), tangential = rounded(valueOf(S(kappa * s))),
                   m = rounded(valueOf(mu));
      if (whole > 0) margin = std::min(margin, std::abs(whole - tangential) * (m > 0 ? m / (1 + m) : 1) / whole);
    }
  }
};

// What follows from the adjoint of kappa where a contact limits it.
template <class S, class Problem, class Bar>
void limitPullback(const Problem& p, const Branch<S>& b, const S& kappa_bar, Bar& bar, VectorOf<S>& P_N_bar,
                   VectorOf<S>& d_bar) {
  const auto k = static_cast<std::size_t>(b.limit);
  const Index at = 3 * b.limit;
  if (!b.by_cone) {  // kappa loss = spare
    const S w = kappa_bar / b.lossOf(p, b.limit), e1 = 1 + p.pair[k].elasticity;
    const V3<S> u = p.u.template segment<3>(at), n = p.normal[k];
    const VectorOf<S> both = b.P_N + b.kappa * b.d;
    const MatrixOf<S> row = p.K.middleRows(at, 3);
    bar.pair[k].elasticity += w * n.dot(u);
    bar.normal[k] += w * (e1 * u + row * both);
    bar.u.template segment<3>(at) += w * e1 * n;
    bar.K.middleRows(at, 3) += w * n * both.transpose();
    const VectorOf<S> back = w * (row.transpose() * n);
    P_N_bar += back;
    d_bar += b.kappa * back;
    return;
  }
  const V3<S> n = p.normal[k], d = b.d.template segment<3>(at), P = b.P_N.template segment<3>(at);
  const S mu = p.pair[k].friction, d_n = n.dot(d), P_n = n.dot(P);
  S P_n_bar, d_n_bar;
  if (mu > 0) {
    const V3<S> d_t = d - d_n * n;
    const S s = normOf<S>(d_t), w = kappa_bar / (s - mu * d_n), s_bar = -b.kappa * w;
    bar.pair[k].friction += w * (P_n + b.kappa * d_n);
    P_n_bar = mu * w;
    d_n_bar = b.kappa * mu * w;
    d_bar.template segment<3>(at) += s_bar / s * d_t;
    bar.normal[k] -= s_bar / s * d_n * d_t;
  } else {
    P_n_bar = -kappa_bar / d_n;
    d_n_bar = b.kappa * P_n_bar;
  }
  P_N_bar.template segment<3>(at) += P_n_bar * n;
  d_bar.template segment<3>(at) += d_n_bar * n;
  bar.normal[k] += P_n_bar * P + d_n_bar * d;
}

template <class S, class Problem, class Bar>
void jointPullback(const Problem& p, const VectorOf<S>& P_bar, Bar& bar) {
  const Branch<S> b(p);
  VectorOf<S> P_N_bar = P_bar, share_bar;
  MatrixOf<S> C_bar;
  if (b.friction) {
    VectorOf<S> d_bar = b.kappa * P_bar;
    const S kappa_bar = P_bar.dot(b.d);
    if (b.limit >= 0)
      limitPullback<S>(p, b, kappa_bar, bar, P_N_bar, d_bar);
    else if (b.lowest_e_t >= 0)
      bar.pair[static_cast<std::size_t>(b.lowest_e_t)].tangential_elasticity += kappa_bar;
    b.solves[1].pullback(p, VectorOf<S>(-d_bar), bar, C_bar, share_bar);
    addDirections<S>(p, b.plastic_active, false, C_bar, bar);
    b.solves[2].pullback(p, d_bar, bar, C_bar, share_bar);
    addDirections<S>(p, b.directions, true, C_bar, bar);
  }
  b.solves[0].pullback(p, P_N_bar, bar, C_bar, share_bar);
  addDirections<S>(p, b.normal_active, false, C_bar, bar);
  for (std::size_t c = 0; c < b.normal_active.size(); ++c)
    bar.pair[static_cast<std::size_t>(b.normal_active[c])].elasticity += share_bar[static_cast<Index>(c)];
}

}  // namespace carom::adjoint_detail
