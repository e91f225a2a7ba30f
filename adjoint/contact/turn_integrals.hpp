// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/turn_series.hpp"

namespace carom::adjoint_detail {

/// The turn E over [0, t] at the angular velocity a + b t, and the integrals of E^T and of t E^T: with them (11.10)
///   theta(t) = E (theta0 + M0 da + M1 db).
template <class S>
struct TurnIntegrals {
  M3<S> E = M3<S>::Identity(), M0 = M3<S>::Zero(), M1 = M3<S>::Zero();

  TurnIntegrals(const V3<S>& a, const V3<S>& b, const S& t) {
    const double end = primalOf(t);
    const bool steady = kOrderOf<S> == 0 ? primalsOf(b).norm() * end * end < 1e-17 : carom::isZero(b);
    if (steady) {
      atConstantSpin(a * t, t);
    } else {
      bySegments(a, b, t);
    }
  }

 private:
  // By c_k(x) = sum over j of (-x)^j/(k + 2j)!, as in section 9 of the equations.
  void atConstantSpin(const V3<S>& angle, const S& t) {
    using elementary::cos, elementary::sin, std::sqrt;
    const S x = angle.squaredNorm();
    S c2, c3, c4;
    if (primalOf(x) < 1) {
      const auto share = [&x](int k) {
        S sum = 1;
        for (int j = 11; j >= 1; --j) sum = 1.0 - x * sum / static_cast<double>((k + 2 * j - 1) * (k + 2 * j));
        return sum;
      };
      c2 = share(2) / 2.0, c3 = share(3) / 6.0, c4 = share(4) / 24.0;
    } else {
      const S length = sqrt(x);
      c2 = (1.0 - cos(length)) / x;
      c3 = (1.0 - sin(length) / length) / x;
      c4 = (0.5 - c2) / x;
    }
    const M3<S> U = skew(angle), U2 = U * U;
    E = turnBy<S>(angle);
    M0 = (M3<S>::Identity() - U * c2 + U2 * c3) * t;
    M1 = (M3<S>::Identity() * S(0.5) - U * (c2 - c3) + U2 * (c3 - c4)) * (t * t);
  }

  void bySegments(const V3<S>& a, const V3<S>& b, const S& t) {
    const double end = primalOf(t), slope = primalsOf(b).norm();
    Q4<S> q = Q4<S>::UnitX();
    S now = 0;
    for (bool last = false; !last;) {
      const V3<S> spin = a + b * now;
      const double step = 1.2 / (primalsOf(spin).norm() + std::sqrt(slope));
      last = !(primalOf(now) + step < end);
      const S h = last ? S(t - now) : S(step);
      addSegment(spin, b, h, now);
      q = productOf(turnSegment<S>(spin, b, h), q);
      E = turnOf(q);
      now += h;
    }
  }
  void addSegment(const V3<S>& spin, const V3<S>& b, const S& h, const S& now) {
    const M3<S> first = skew(spin) * h, second = skew(b) * (h * h);
    M3<S> before = M3<S>::Zero(), term = M3<S>::Identity(), K0 = term, K1 = term * S(0.5);
    int small = 0;
    for (int j = 0; j < kTurnTerms && small < 2; ++j) {
      const M3<S> next = (first * term + second * before) / (j + 1.0);
      before = term;
      term = next;
      K0 += term / (j + 2.0);
      K1 += term / (j + 3.0);
      if constexpr (kOrderOf<S> == 0) small = term.squaredNorm() < 1e-36 ? small + 1 : 0;
    }
    const M3<S> back = E.transpose();
    M0 += back * K0.transpose() * h;
    M1 += back * (K1.transpose() * h + K0.transpose() * now) * h;
  }
};

}  // namespace carom::adjoint_detail
