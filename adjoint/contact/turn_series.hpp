// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/path_inputs.hpp"

namespace carom::adjoint_detail {

/// Quaternions (w, x, y, z) of any kind of number.
template <class S>
using Q4 = Eigen::Matrix<S, 4, 1>;

/// The product (0, a) q.
template <class S>
Q4<S> turnedBy(const V3<S>& a, const Q4<S>& q) {
  return {-(a[0] * q[1] + a[1] * q[2] + a[2] * q[3]), a[0] * q[0] + a[1] * q[3] - a[2] * q[2],
          a[1] * q[0] + a[2] * q[1] - a[0] * q[3], a[2] * q[0] + a[0] * q[2] - a[1] * q[1]};
}

template <class S>
Q4<S> productOf(const Q4<S>& a, const Q4<S>& b) {
  const V3<S> imaginary = a.template tail<3>();
  return turnedBy(imaginary, b) + b * a[0];
}

/// The rotation matrix of a quaternion of any length.
template <class S>
M3<S> turnOf(const Q4<S>& q) {
  const S w = q[0];
  const V3<S> u = q.template tail<3>();
  const S length2 = w * w + u.squaredNorm();
  M3<S> E = u * (u.transpose() * 2.0) + skew(u) * (w * 2.0);
  const S diagonal = w * w - u.squaredNorm();
  for (int i = 0; i < 3; ++i) E(i, i) += diagonal;
  return E / length2;
}

/// exp([a]x): the turn by a rotation vector.
template <class S>
M3<S> turnBy(const V3<S>& a) {
  using elementary::cos, elementary::sin, std::sqrt;
  const S h2 = a.squaredNorm() / 4.0;  // of half the angle
  S cosine = 1, sine_share = 1;        // cos h, sin h / h
  if (primalOf(h2) < 0.25) {
    for (int k = 10; k >= 1; --k) {
      cosine = 1.0 - h2 / (2.0 * k * (2 * k - 1)) * cosine;
      sine_share = 1.0 - h2 / (2.0 * k * (2 * k + 1)) * sine_share;
    }
  } else {
    const S h = sqrt(h2);
    cosine = cos(h);
    sine_share = sin(h) / h;
  }
  Q4<S> q;
  q << cosine, a * (0.5 * sine_share);
  return turnOf(q);
}

/// Most terms of a series; segments are short enough for these to be enough, rates included.
inline constexpr int kTurnTerms = 30;

/// The quaternion after q' = (a + b t) q / 2 from 1 over a stretch h with (|a| + |b| h) h of at most about two radians.
template <class S>
Q4<S> turnSegment(const V3<S>& a, const V3<S>& b, const S& h) {
  const V3<S> ah = a * (0.5 * h), bh = b * (0.5 * h * h);
  Q4<S> before = Q4<S>::Zero(), term = Q4<S>::UnitX(), sum = term;
  int small = 0;
  for (int j = 0; j < kTurnTerms && small < 2; ++j) {
    Q4<S> next = turnedBy(ah, term);
    if (j > 0) next += turnedBy(bh, before);
    before = term;
    term = next / (j + 1.0);
    sum += term;
    if constexpr (kOrderOf<S> == 0) small = term.squaredNorm() < 1e-36 ? small + 1 : 0;
  }
  return sum;
}

/// The turn over [0, t] at the angular velocity a + b t (11.8).
template <class S>
M3<S> turnOver(const V3<S>& a, const V3<S>& b, const S& t) {
  const double end = primalOf(t), slope = primalsOf(b).norm();
  if constexpr (kOrderOf<S> == 0) {
    // The axis does not turn, or by nothing that counts.
    if (!(a.cross(b).norm() * end * end * end > 1e-17)) return turnBy<S>(a * t + b * (0.5 * t * t));
  }
  if (carom::isZero(b)) return turnBy<S>(a * t);
  if (carom::isZero(a)) return turnBy<S>(b * (0.5 * t * t));
  Q4<S> q = Q4<S>::UnitX();
  S now = 0;
  while (true) {
    const V3<S> spin = a + b * now;
    const double step = 1.6 / (primalsOf(spin).norm() + std::sqrt(slope));
    const bool last = !(primalOf(now) + step < end);
    const S h = last ? S(t - now) : S(step);
    q = productOf(turnSegment<S>(spin, b, h), q);
    if (last) return turnOf(q);
    now += h;
  }
}

}  // namespace carom::adjoint_detail
