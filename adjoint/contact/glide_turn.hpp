// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/glide_slip.hpp"
#include "adjoint/contact/turn_series.hpp"

namespace carom::adjoint_detail {

/// Where a segment of the clock starts: slip, its speed, the angular velocity, and the time.
template <class S>
struct ClockStart {
  V3<S> s, spin;
  S u, t;
};

/// Angular velocity w = w0 + m x (g t + s0 - s) and speed |s| of the slip over a segment of the clock, by the powers of
/// its share.
template <class S>
struct ClockSeries {
  static constexpr std::size_t kTerms = kTurnTerms;
  std::array<V3<S>, kTerms> spin;
  std::array<S, kTerms> u;

  ClockSeries(const GlideSlip<S>& slip, const V3<S>& m, const ClockStart<S>& at, const S& h) {
    V3<S> s = at.s;
    spin[0] = at.spin;
    u[0] = at.u;
    for (std::size_t j = 0; j + 1 < kTerms; ++j) {
      const S share = h / (static_cast<double>(j) + 1), t = u[j] * share;
      const V3<S> next = (slip.slope() * u[j] - s * slip.friction()) * share;
      u[j + 1] = (slip.slope().dot(s) - slip.friction() * u[j]) * share;
      s = next;
      spin[j + 1] = m.cross(V3<S>(slip.slope() * t - s));
    }
  }
};

/// How a ball turns while it glides on a curve: at w = w0 + m x (g t + s0 - s) (11.2). On the clock of the slip w, s,
/// |s| and t are entire functions, so that the quaternion is a power series in it, taken in segments (11.9).
template <class S>
class GlideTurn {
 public:
  GlideTurn(const GlideSlip<S>& slip, const V3<S>& spin, const V3<S>& m) : slip_(slip), spin_(spin), m_(m) {}

  /// The turn over [0, t]; `to_end`: t is the end of the slip.
  M3<S> over(const S& t, bool to_end) const {
    const S last = to_end ? S(0) : slip_.xiAt(t);
    const double stop = to_end ? std::numeric_limits<double>::infinity() : primalOf(last);
    Q4<S> q = Q4<S>::UnitX();
    S xi = 0;
    while (true) {
      const Start at = startAt(xi);
      const S rest = t - at.t;
      if (isShort(at, primalOf(rest), primalOf(t))) return turnBy<S>(angleOver(at, xi, t, to_end)) * turnOf(q);
      const double step = lengthAt(at);
      const bool closing = !(primalOf(xi) + step < stop);
      const S h = closing ? S(last - xi) : S(step);
      q = productOf(segment(at, h), q);
      if (closing) return turnOf(q);
      xi += h;
    }
  }

  using Start = ClockStart<S>;
  Start startAt(const S& xi) const {
    Start at{slip_.slipAt(xi), V3<S>::Zero(), slip_.speedAt(xi), slip_.timeAt(xi)};
    at.spin = spin_ + m_.cross(V3<S>(slip_.slope() * at.t + slip_.start() - at.s));
    return at;
  }

  // So short that the axis does not turn: angles add. Where there are rates it must not turn by them either.
  bool isShort(const Start& at, double rest, double t, bool has_rates = kOrderOf<S> > 0) const {
    double turning = rate();
    if (has_rates)
      turning += primalsOf(m_).norm() * (primalsOf(slip_.slope()).norm() + primalsOf(slip_.start()).norm() / t);
    const double spin = primalsOf(at.spin).norm() + rate() * std::abs(rest);
    return (spin + turning * std::abs(rest)) * turning * std::abs(rest * rest * rest) < 1e-17;
  }
  V3<S> angleOver(const Start& at, const S& xi, const S& t, bool to_end) const {
    const S rest = t - at.t;
    const V3<S> covered = (to_end ? slip_.atEnd() : slip_.at(t)).integral - slip_.onClock(xi).integral;
    return at.spin * rest + m_.cross(V3<S>(slip_.slope() * (0.5 * rest * rest) + at.s * rest - covered));
  }
  // Series of 30 terms are exact to rounding over this length.
  double lengthAt(const Start& at) const {
    const double u = primalOf(at.u), decay = primalOf(slip_.friction()) + primalsOf(slip_.slope()).norm();
    return 1.2 / (decay + u * (primalsOf(at.spin).norm() + std::sqrt(rate())));
  }
  Q4<S> segment(const Start& at, const S& h) const;
  const V3<S>& lever() const { return m_; }
  /// Of the angular velocity from a start to the end of the slip.
  V3<S> change(const Start& at, const S& end) const {
    return m_.cross(V3<S>(slip_.slope() * (end - at.t) + at.s));
  }

 private:
  // Of the angular velocity.
  double rate() const { return primalsOf(m_).norm() * primalOf(slip_.friction()); }

  const GlideSlip<S>& slip_;
  V3<S> spin_, m_;
};

template <class S>
Q4<S> GlideTurn<S>::segment(const Start& at, const S& h) const {
  const ClockSeries<S> series(slip_, m_, at, h);
  constexpr std::size_t kTerms = kTurnTerms;
  std::array<V3<S>, kTerms> turning;  // |s| w h/2
  std::array<Q4<S>, kTerms> q;
  q[0] = Q4<S>::UnitX();
  Q4<S> sum = q[0];
  const S half = 0.5 * h;
  int small = 0;
  for (std::size_t j = 0; j + 1 < kTerms && small < 2; ++j) {
    V3<S> product = V3<S>::Zero();
    for (std::size_t i = 0; i <= j; ++i) product += series.spin[j - i] * series.u[i];
    turning[j] = product * half;
    Q4<S> next = Q4<S>::Zero();
    for (std::size_t i = 0; i <= j; ++i) next += turnedBy(turning[i], q[j - i]);
    q[j + 1] = next / (static_cast<double>(j) + 1);
    sum += q[j + 1];
    if constexpr (kOrderOf<S> == 0) small = q[j + 1].squaredNorm() < 1e-36 ? small + 1 : 0;
  }
  return sum;
}

}  // namespace carom::adjoint_detail
