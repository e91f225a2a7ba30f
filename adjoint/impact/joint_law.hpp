// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "adjoint/base/errors.h"
#include "adjoint/base/types.h"
#include "adjoint/contact/cone_program.hpp"
#include "adjoint/contact/cone_rates.hpp"
#include "adjoint/impact/directed_solve.hpp"
#include "adjoint/impact/impact_jam.hpp"
#include "adjoint/impact/pushing_contacts.hpp"
#include "adjoint/numeric/double_double.hpp"

// Equation 4.4, contacts of one instant together, each with u_n <= 0 before:
//   P_N: normal impulses, 0 <= P_N,k, u_n,k+ >= -e_k u_n,k, complementary; those of held contacts have either sign and
//   e = 0;
//   P = P_N + X, X the least of X.K X/2 + kappa (u + K P_N).X with P in the cones of contacts with P_N > 0, whose
//   velocities along the normals X leaves alone; kappa = 1 + min e_t;
//   a contact that X would slow down below -e u_n joins, with u_n+ = -e u_n and its own cone: the first one on the way
//   from P_N to P, and so on. kappa is 1 at the most then.
// X = 0 is admissible, so X.K X <= -kappa (u + K P_N).X, and the energy grows by (1/2 - 1/kappa) X.K X over that
// after P_N at the most: never for kappa <= 2. Where a contact joins, the point of the way is admissible for the next
// X, and is below as well. After P_N the energy has grown by 1/2 sum P_N (1 - e) u_n, which is no growth either.
// Where a kinematic body takes part, u need not be a velocity that impulses can undo. P_N still exists unless a body is
// squeezed between ones that nothing moves; where no P is found or lets a contact come off slower than its e says, it
// is P_N. What comes out is held against these conditions: where rounding has spoilt them there is no answer but
// NotComputable. Redundant contacts (a face on a plane) make K singular; velocities are unique.
//
// Written for any number: doubles, numbers of 32 digits, and duals of either, which take the branch of the values. A
// `Problem` has the fields of ImpactProblem, a `Bar` those of ImpactProblemDerivative.

namespace carom::adjoint_detail {

// Normals of a list of contacts as columns.
template <class S, class Problem>
MatrixOf<S> normalsOf(const Problem& p, const Contacts& list) {
  MatrixOf<S> N = MatrixOf<S>::Zero(p.u.size(), static_cast<Index>(list.size()));
  Index at = 0;
  for (int k : list) N.template block<3, 1>(3 * k, at++) = p.normal[static_cast<std::size_t>(k)];
  return N;
}

// The branch of the law with its solutions.
template <class S>
class Branch {
 public:
  using T = Value<S>;
  Contacts normal_active, joined;  // contacts of P_N; those that friction would press down
  S kappa = 0;
  int lowest_e_t = -1;                    // contact that gives kappa, -1: none does
  VectorOf<S> P_N, b;                     // b = u + K P_N
  std::vector<DirectedSolve<S>> normal;   // one: P_N
  Contacts list, held;                    // contacts of X; those that are held
  std::unique_ptr<ConeSolution<S>> cone;  // X; null: 0

  /// `from_zero`: friction that is 0 is to vary.
  template <class Problem>
  Branch(const Problem& p, bool from_zero) {
    const int n = static_cast<int>(p.normal.size());
    for (int k = 0; k < n; ++k)
      if (isConstrained(p, k)) held.push_back(k);
    solveNormal(p, n);
    if (!parts(p) || pulls(p))
      throw NotComputable(p.driven ? "no impulses separate its contacts, one of which is with a kinematic body"
                                   : "the impulses that separate all of its contacts are lost in rounding");
    const bool rubs = std::any_of(normal_active.begin(), normal_active.end(),
                                  [&](int k) { return hasFriction(p, k) && !isPulled(p, k); });
    if (normal_active.empty() || !(rubs || from_zero)) return;
    setKappa(p, rubs);
    if (lowest_e_t < 0) return;
    if (p.driven && rubs && jams(p)) throw NotComputable("friction at contacts with a kinematic body would grow without bound: it wedges what it strikes");
    try {
      addFriction(p);
      if (parts(p)) return;
    } catch (const NotComputable&) {
      if (rubs && !p.driven) throw;
      leaveOutFriction();
      return;
    }
    if (!p.driven) throw NotComputable("the friction impulses that separate all of its contacts are lost in rounding");
    leaveOutFriction();
  }

  VectorOf<S> P;

  template <class Problem>
  static bool isConstrained(const Problem& p, int k) {
    return !p.held.empty() && p.held[static_cast<std::size_t>(k)];
  }
  static bool isIn(const Contacts& contacts, int k) { return std::binary_search(contacts.begin(), contacts.end(), k); }

  // A held contact that does not push has no friction, and X may not pull there: else the pressure of other contacts, and
  // with it their friction, would grow at will against that pull.
  template <class Problem>
  bool isPulled(const Problem& p, int k) const {
    return isConstrained(p, k) && isIn(normal_active, k) && !isLoaded(p, k);
  }
  // What nothing loads has a P_N of rounding, of either sign, which must not decide whether it has friction.
  template <class Problem>
  bool isLoaded(const Problem& p, int k) const {
    const V3<S>& n = p.normal[static_cast<std::size_t>(k)];
    const S gives = loadOf(k, n) * n.dot(V3<S>(p.K.template block<3, 3>(3 * k, 3 * k) * n));
    return valueOf(gives) > T(kUnloaded) * fastest_;
  }
  S loadOf(int k, const V3<S>& n) const { return n.dot(V3<S>(P_N.template segment<3>(3 * k))); }
  // The state of contact k in its cone; without friction it slides.
  ConeState stateOf(int k) const {
    const auto at = std::ranges::lower_bound(list, k);
    if (cone && at != list.end() && *at == k)
      return cone->terms().at.state[static_cast<std::size_t>(at - list.begin())];
    return isIn(normal_active, k) ? ConeState::slides : ConeState::apex;
  }

  // How near X is to another branch: shares of cones that are not full, speeds of what slides, and what held contacts
  // push or pull with.
  double margin() const {
    if (!cone) return 1;
    const ConeTerms<S>& t = cone->terms();
    const ConeProgramOf<S>& q = *t.program;
    double least = 1, fastest = 0;
    for (Index i = 0; i < q.b.size(); ++i) fastest = std::max(fastest, std::abs(rounded(valueOf(q.b[i]))));
    for (std::size_t k = 0; k < list.size(); ++k) {
      const double mu = rounded(valueOf(q.friction[k]));
      if (fastest > 0 && isIn(held, list[k]))
        least = std::min(least, std::abs(rounded(valueOf(speedOf(q, k)))) / fastest);
      if (!(mu > 0) || !(fastest > 0)) continue;
      const Vec3 n = roundedOf(q.normal[k]), f = roundedOf(V3<S>(t.f.template segment<3>(3 * static_cast<Index>(k)))),
                 v = roundedOf(V3<S>(t.V.template segment<3>(3 * static_cast<Index>(k))));
      const double pressure = n.dot(f) + rounded(valueOf(q.offset[k])), side = (f - n.dot(f) * n).norm();
      const double slip = (v - n.dot(v) * n).norm();
      if (t.at.state[k] == ConeState::inside)
        least = std::min(least, pressure > 0 ? (mu * pressure - side) / ((1 + mu) * pressure) : 0);
      if (t.at.state[k] == ConeState::slides) least = std::min(least, slip / fastest);
      if (t.at.state[k] == ConeState::apex) least = std::min(least, (n.dot(v) - mu * slip) / fastest);
    }
    return std::max(least, 0.0);
  }
  // What the normal impulse of a contact gives it.
  S speedOf(const ConeProgramOf<S>& q, std::size_t k) const {
    const auto row = 3 * static_cast<Index>(k);
    return loadOf(list[k], q.normal[k]) * q.normal[k].dot(V3<S>(q.K.template block<3, 3>(row, row) * q.normal[k]));
  }

 private:
  template <class Problem>
  static bool hasFriction(const Problem& p, int k) {
    return p.pair[static_cast<std::size_t>(k)].friction > 0;
  }
  static Vec3 roundedOf(const V3<S>& v) {
    return {rounded(valueOf(v[0])), rounded(valueOf(v[1])), rounded(valueOf(v[2]))};
  }

  template <class Problem>
  void solveNormal(const Problem& p, int n) {
    Contacts all(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) all[static_cast<std::size_t>(k)] = k;
    const MatrixOf<S> N = normalsOf<S>(p, all);
    const VectorOf<S> u_n = N.transpose() * p.u;
    const MatrixOf<T> A = valuesOf(MatrixOf<S>(N.transpose() * p.K * N));
    const VectorOf<T> asked = valuesOf(VectorOf<S>(share(p, all).cwiseProduct(u_n)));
    push(p, activeContactsOf<T>(A, asked, !p.driven, p.held));
    if (!p.driven && !parts(p)) push(p, pushingByProgram<T, S>(p, share(p, all), A, asked));
    Contacts loaded;
    for (const int k : normal_active)
      if (isConstrained(p, k) || isLoaded(p, k)) loaded.push_back(k);
    if (loaded.size() < normal_active.size()) push(p, std::move(loaded));
  }
  template <class Problem>
  void push(const Problem& p, Contacts contacts) {
    normal_active = std::move(contacts);
    normal.clear();
    normal.emplace_back(p, normalsOf<S>(p, normal_active), share(p, normal_active));
    P = P_N = normal[0].impulse();
    b = p.u + p.K * P_N;
    fastest_ = T(0);
    for (const VectorOf<T>& v : {valuesOf(p.u), valuesOf(b)})
      for (Index i = 0; i < v.size(); ++i) fastest_ = std::max(fastest_, v[i] < T(0) ? T(-v[i]) : v[i]);
  }
  template <class Problem>
  static VectorOf<S> share(const Problem& p, const Contacts& contacts) {
    VectorOf<S> s(static_cast<Index>(contacts.size()));
    for (std::size_t c = 0; c < contacts.size(); ++c)
      s[static_cast<Index>(c)] =
          isConstrained(p, contacts[c]) ? S(1) : S(1 + p.pair[static_cast<std::size_t>(contacts[c])].elasticity);
    return s;
  }
  template <class Problem>
  void setKappa(const Problem& p, bool rubs) {
    for (int k : normal_active) {
      const S bound = 1 + p.pair[static_cast<std::size_t>(k)].tangential_elasticity;
      if (!isPulled(p, k) && (hasFriction(p, k) || !rubs) && (lowest_e_t < 0 || bound < kappa))
        kappa = bound, lowest_e_t = k;
    }
  }
  template <class Problem>
  bool jams(const Problem& p) const {
    std::vector<double> friction;
    std::vector<Vec3> normals;
    for (int k : normal_active) {
      friction.push_back(isPulled(p, k) ? 0 : rounded(valueOf(p.pair[static_cast<std::size_t>(k)].friction)));
      normals.push_back(roundedOf(p.normal[static_cast<std::size_t>(k)]));
    }
    return frictionGrows(roundedAll(p.K), roundedAll(b), normal_active, normals, friction);
  }
  static Eigen::MatrixXd roundedAll(const MatrixOf<S>& M) {
    return M.unaryExpr([](const S& x) { return static_cast<double>(rounded(valueOf(x))); });
  }
  void leaveOutFriction() {
    P = P_N, lowest_e_t = -1;
    cone.reset(), list.clear(), joined.clear();
  }

  // The least velocity along the normal of contact k after the impact, and what its velocity is after P_N.
  template <class Problem>
  static S leastOf(const Problem& p, int k) {
    const auto kk = static_cast<std::size_t>(k);
    if (isConstrained(p, k)) return S(0);
    return -p.pair[kk].elasticity * p.normal[kk].dot(V3<S>(p.u.template segment<3>(3 * k)));
  }
  template <class Problem>
  S afterNormal(const Problem& p, int k) const {
    return p.normal[static_cast<std::size_t>(k)].dot(V3<S>(b.template segment<3>(3 * k)));
  }

  template <class Problem>
  ConeProgramOf<S> program(const Problem& p) const {
    const auto n = static_cast<Index>(list.size());
    ConeProgramOf<S> q;
    q.K.resize(3 * n, 3 * n);
    q.b.resize(3 * n);
    for (Index i = 0; i < n; ++i) {
      const int k = list[static_cast<std::size_t>(i)];
      const auto kk = static_cast<std::size_t>(k);
      for (Index j = 0; j < n; ++j)
        q.K.template block<3, 3>(3 * i, 3 * j) = p.K.template block<3, 3>(3 * k, 3 * list[static_cast<std::size_t>(j)]);
      q.b.template segment<3>(3 * i) = kappa * b.template segment<3>(3 * k);
      const bool joins = isIn(joined, k);
      q.normal.push_back(p.normal[kk]);
      q.friction.push_back(p.pair[kk].friction);
      if (isPulled(p, k)) q.friction.back() = S(0);
      q.offset.push_back(joins || isPulled(p, k) ? S(0) : loadOf(k, p.normal[kk]));
      q.free.push_back(false);
      q.equal.push_back(static_cast<int>(i));
      q.rise.push_back(joins ? S(leastOf(p, k) - afterNormal(p, k)) : S(0));
    }
    return q;
  }

  template <class Problem>
  void addFriction(const Problem& p) {
    const int n = static_cast<int>(p.normal.size());
    std::vector<T> from;  // velocities along the normals from where the way to P goes on
    for (int k = 0; k < n; ++k) from.push_back(valueOf(afterNormal(p, k)));
    for (int round = 0; round <= n; ++round) {
      list.clear();
      std::ranges::set_union(normal_active, joined, std::back_inserter(list));
      ConeProgramOf<S> q = program(p);
      const ConePointOf<T> at = solveConeProgram<T>(valuesOf(q));
      cone = std::make_unique<ConeSolution<S>>(std::move(q), at);
      P = P_N;
      for (std::size_t c = 0; c < list.size(); ++c)
        P.template segment<3>(3 * list[c]) += cone->terms().f.template segment<3>(3 * static_cast<Index>(c));
      if (!join(p, from)) return;
    }
  }

  // Contacts that P presses down: the first ones on the way to it join, and the way goes on from there.
  template <class Problem>
  bool join(const Problem& p, std::vector<T>& from) {
    const std::vector<Normal> along = alongNormals(p);
    T first = T(2);
    std::vector<T> when(along.size(), T(2));
    for (int k = 0; k < static_cast<int>(along.size()); ++k) {
      const auto kk = static_cast<std::size_t>(k);
      const T least = valueOf(leastOf(p, k)), to = along[kk].after;
      if (isIn(list, k) || !(to < least - T(kTouch) * along[kk].size)) continue;
      const T spare = from[kk] - least;
      when[kk] = spare > T(0) ? T(spare / (from[kk] - to)) : T(0);
      if (when[kk] < first) first = when[kk];
    }
    if (first > T(1)) return false;
    for (int k = 0; k < static_cast<int>(along.size()); ++k) {
      const auto kk = static_cast<std::size_t>(k);
      from[kk] += first * (along[kk].after - from[kk]);
      if (when[kk] > first + T(1e-9)) continue;
      joined.insert(std::ranges::upper_bound(joined, k), k);
    }
    if (kappa > S(1)) kappa = S(1), lowest_e_t = -1;
    return true;
  }

  T fastest_ = T(0);  // component of a velocity at the contacts, before or after P_N
  // Places are doubles: their rounding is in what numbers of 32 digits make of them, too. These serve unlike masses.
  static constexpr double kUnloaded = std::is_same_v<T, double> ? 1e-12 : 1e-14;
  static constexpr double kTouch = std::is_same_v<T, double> ? 1e-12 : 1e-24;

  // Velocities along the normals before and after P, and the size of what they are made of.
  struct Normal {
    T before, after, size;
  };
  template <class Problem>
  std::vector<Normal> alongNormals(const Problem& p) const {
    const VectorOf<T> u = valuesOf(p.u), gain = valuesOf(p.K) * valuesOf(P);
    std::vector<Normal> all;
    T fastest = T(0);
    for (std::size_t k = 0; k < p.normal.size(); ++k) {
      const V3<T> n = valuesOf(p.normal[k]), before = u.template segment<3>(3 * static_cast<Index>(k)),
                  gained = gain.template segment<3>(3 * static_cast<Index>(k));
      all.push_back({n.dot(before), n.dot(V3<T>(before + gained)),
                     T(before.cwiseAbs().maxCoeff()) + T(gained.cwiseAbs().maxCoeff())});
      if (all.back().size > fastest) fastest = all.back().size;
    }
    // rounding of a contact's velocities: of its own, and far less of the fastest one's
    for (Normal& v : all) v.size = v.size + T(1e-3) * fastest;
    return all;
  }

  // Whether every contact comes off as fast as its e says. Surfaces of bodies that nothing moves may go different ways:
  // no impulses stop the others on all of them then.
  template <class Problem>
  bool pulls(const Problem& p) const {
    const VectorOf<S>& y = normal[0].solve.y;
    T most = T(0);
    for (Index c = 0; c < y.size(); ++c) most = std::max(most, valueOf(y[c]));
    for (std::size_t c = 0; c < normal_active.size(); ++c)
      if (!isConstrained(p, normal_active[c]) && valueOf(y[static_cast<Index>(c)]) < T(-1e-9) * most) return true;
    return false;
  }
  template <class Problem>
  bool parts(const Problem& p) const {
    const std::vector<Normal> along = alongNormals(p);
    for (std::size_t k = 0; k < along.size(); ++k) {
      const Normal& v = along[k];
      if (!(v.after >= valueOf(leastOf(p, static_cast<int>(k))) - T(1e-9) * v.size)) return false;
    }
    return true;
  }
};

}  // namespace carom::adjoint_detail
