// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>

#include "adjoint/base/types.h"
#include "adjoint/impact/law.hpp"
#include "adjoint/numeric/dual.hpp"
#include "adjoint/numeric/inverse_of_three.hpp"
#include "adjoint/numeric/double_double.hpp"

/// The laws of one contact and their adjoints, for any number: doubles, and duals for second derivatives. A `Problem`
/// has the fields of ContactProblem, a `Bar` those of ImpactProblemDerivative.
namespace carom::adjoint_detail {

/// K^-1 b.
template <class S>
class Solve3 {
 public:
  explicit Solve3(const M3<S>& K) : factor_(K) {}
  V3<S> solve(const V3<S>& b) const { return factor_.solve(b); }

 private:
  Eigen::LDLT<M3<S>> factor_;
};
template <int N, class T>
class Solve3<Dual<N, T>> {
  using S = Dual<N, T>;

 public:
  explicit Solve3(const M3<S>& K) : inverse_(inverseOfThree<T>(valuesOf(K)).template cast<S>()) {
    const M3<T> inverse = valuesOf(inverse_);
    for (std::size_t i = 0; i < N; ++i) setRates(inverse_, M3<T>(-inverse * ratesOf(K, i) * inverse), i);
  }
  V3<S> solve(const V3<S>& b) const { return inverse_ * b; }

 private:
  M3<S> inverse_;
};

/// Equation 4.1: P = c n with c = -(1 + e) u_n / a, u_n = n.u, a = n.K n.
template <class S>
struct FrictionlessTerms {
  template <class Problem>
  explicit FrictionlessTerms(const Problem& p)
      : K(p.K),
        u(p.u),
        n(p.normal),
        e1(1 + p.pair.elasticity),
        Kn(K * n),
        u_n(n.dot(u)),
        a(n.dot(Kn)),
        c(-e1 * u_n / a) {}
  M3<S> K;
  V3<S> u, n;
  S e1;
  V3<S> Kn;
  S u_n, a, c;

  V3<S> impulse() const { return c * n; }

  template <class Bar>
  void pullback(const V3<S>& P_bar, Bar& bar) const {
    const S c_bar = n.dot(P_bar);
    const S u_n_bar = -e1 / a * c_bar, a_bar = -c / a * c_bar;
    bar.pair[0].elasticity -= u_n / a * c_bar;
    bar.normal[0] += c * P_bar + u_n_bar * u + 2 * a_bar * Kn;
    bar.u += u_n_bar * n;
    bar.K += a_bar * n * n.transpose();
  }
};

/// Equation 4.2, the algebraic law of Chatterjee and Ruina (1998):
///   P_I = -(u_n/a) n, P_II = -K^-1 u, d = P_II - P_I,
///   stick: P = (1 + e) P_I + (1 + e_t) d          where |P_t| <= mu P_n,
///   slide: P = (1 + e) P_I + kappa d, kappa = mu (1 + e) n.P_I / (|d_t| - mu n.d).
template <class S>
struct FrictionTerms {
  explicit FrictionTerms(const ContactProblemOf<S>& p);
  /// From now on the impulse before the friction cone cuts it back: the contact sticks where it lies in the cone.
  void stick() {
    slides = false;
    kappa = et1;
  }
  M3<S> K;
  V3<S> u, n;
  S mu, e1, et1;
  V3<S> Kn;
  S u_n, a;
  Solve3<S> factor;
  V3<S> P_I, P_II, d, d_t;
  S d_n = 0, s = 0, kappa = 0, slope = 0;
  double margin = 1;
  bool slides = false;

  V3<S> impulse() const { return e1 * P_I + kappa * d; }

  template <class Bar>
  void pullback(const V3<S>& P_bar, Bar& bar) const {
    V3<S> P_I_bar = e1 * P_bar, d_bar = kappa * P_bar, n_bar = V3<S>::Zero();
    S e_bar = P_bar.dot(P_I);
    const S kappa_bar = P_bar.dot(d);
    if (slides) {
      const S P_In = n.dot(P_I);
      const S top_bar = kappa_bar / slope, slope_bar = -kappa * top_bar;
      bar.pair[0].friction += e1 * P_In * top_bar - d_n * slope_bar;
      e_bar += mu * P_In * top_bar;
      const S P_In_bar = mu * e1 * top_bar, d_n_bar = -mu * slope_bar;
      n_bar += P_In_bar * P_I + d_n_bar * d - slope_bar * d_n / s * d_t;
      P_I_bar += P_In_bar * n;
      d_bar += slope_bar / s * d_t + d_n_bar * n;
    } else {
      bar.pair[0].tangential_elasticity += kappa_bar;
    }
    bar.pair[0].elasticity += e_bar;
    P_I_bar -= d_bar;
    const V3<S> z = factor.solve(d_bar);  // d P_II = -K^-1 (du + dK P_II)
    const S c_bar = P_I_bar.dot(n), u_n_bar = -c_bar / a, a_bar = u_n / (a * a) * c_bar;
    bar.normal[0] += n_bar - u_n / a * P_I_bar + u_n_bar * u + 2 * a_bar * Kn;
    bar.u += u_n_bar * n - z;
    bar.K += a_bar * n * n.transpose() - z * P_II.transpose();
  }
};

template <class S>
FrictionTerms<S>::FrictionTerms(const ContactProblemOf<S>& p)
    : K(p.K),
      u(p.u),
      n(p.normal),
      mu(p.pair.friction),
      e1(1 + p.pair.elasticity),
      et1(1 + p.pair.tangential_elasticity),
      Kn(K * n),
      u_n(n.dot(u)),
      a(n.dot(Kn)),
      factor(K) {
  P_I = -(u_n / a) * n;
  P_II = -factor.solve(u);
  d = P_II - P_I;
  d_n = n.dot(d);
  d_t = d - d_n * n;
  using std::abs;
  using T = Value<S>;
  const T s_now = valuesOf(d_t).norm();
  const S P_n = e1 * n.dot(P_I) + et1 * d_n;
  const T P_t = abs(valueOf(et1)) * s_now;
  slides = P_t > valueOf(mu * P_n);
  kappa = et1;
  margin = rounded(abs(valueOf(mu * P_n) - P_t) / ((1 + valueOf(mu)) * abs(valueOf(P_n))));
  if (slides) {
    s = d_t.norm();
    slope = s - mu * d_n;  // > mu e1 n.P_I / et1 > 0, because the stick impulse lies outside the cone
    kappa = mu * e1 * n.dot(P_I) / slope;
  }
}
extern template FrictionTerms<double>::FrictionTerms(const ContactProblemOf<double>&);  // in laws.cpp

/// Whether a contact without friction slips by more than rounding, so that 4.2 slides as friction grows from 0.
template <class S>
bool slipsWithoutFriction(const FrictionTerms<S>& t) {
  constexpr double kRounding = 1e-13;
  return t.slides && t.margin > kRounding;
}

/// Rate of the impulse of 4.1 as the coefficient of friction grows from 0, kappa = mu (1 + e) n.P_I/|d_t| + O(mu^2).
/// Without slip there is no friction either.
template <class S>
V3<S> rateByFrictionFromZero(const FrictionTerms<S>& t) {
  if (!slipsWithoutFriction(t)) return V3<S>::Zero();
  return (t.e1 * t.n.dot(t.P_I) / t.s) * t.d;
}

}  // namespace carom::adjoint_detail
