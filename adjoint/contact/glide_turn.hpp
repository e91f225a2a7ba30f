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

  ClockSeries(const GlideSlip<S>& slip, const V3<S>& m, const ClockStart<S>& at, const S& h)
      : ClockSeries(slip.slope(), slip.friction(), m, at, h) {}
  ClockSeries(const V3<S>& slope, const S& friction, const V3<S>& m, const ClockStart<S>& at, const S& h) {
    V3<S> s = at.s;
    spin[0] = at.spin;
    u[0] = at.u;
    for (std::size_t j = 0; j + 1 < kTerms; ++j) {
      const S share = h / (static_cast<double>(j) + 1), t = u[j] * share;
      const V3<S> next = (slope * u[j] - s * friction) * share;
      u[j + 1] = (slope.dot(s) - friction * u[j]) * share;
      s = next;
      spin[j + 1] = m.cross(V3<S>(slope * t - s));
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
      if (slip_.isStraightFrom(xi)) return turnOver<S>(at.spin, rateAt(at), rest) * turnOf(q);
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
  // Over this length series of 30 terms are exact to rounding: always over the first one; over longer ones where what
  // is left to turn is so little that the last terms, and those of their products of order n, are nothing.
  double lengthAt(const Start& at) const {
    const double decay = primalOf(slip_.friction()) + primalsOf(slip_.slope()).norm();
    const double turning = primalOf(at.u) * (primalsOf(at.spin).norm() + std::sqrt(rate()));
    const double safe = 1.2 / (decay + turning);
    if (clockGrows() || !(turning < 0.1 * decay)) return safe;
    const double unit = 1 / decay, angle = turning * unit;
    double products = 1, share = 1;  // angle^(n - 1)/n!
    for (int n = 2; n < 10; ++n) {
      share *= angle / n;
      products = std::max(products, share * elementary::pow(n, kTurnTerms - 2.0));
    }
    const double last = std::max(lastTurning(at, unit) * unit * products, 1e-60);
    const double stretch = std::min(8.0, elementary::pow(1e-18 / last, 1.0 / (kTurnTerms - 1)));
    return std::max(safe, std::min(stretch * unit, 1.2 / turning));
  }
  Q4<S> segment(const Start& at, const S& h) const;
  const V3<S>& lever() const { return m_; }
  /// Of the angular velocity, where the slip goes along a line.
  V3<S> rateAt(const Start& at) const { return m_.cross(at.s) * (slip_.friction() / at.u); }
  /// Of the angular velocity from a start to the end of the slip.
  V3<S> change(const Start& at, const S& end) const {
    return m_.cross(V3<S>(slip_.slope() * (end - at.t) + at.s));
  }

 private:
  // What the last two terms of a series of |s| w over a length are, at most.
  double lastTurning(const Start& at, double length) const {
    const ClockStart<double> start{primalsOf(at.s), primalsOf(at.spin), primalOf(at.u), primalOf(at.t)};
    const Vec3 slope = primalsOf(slip_.slope()), lever = primalsOf(m_);
    const ClockSeries<double> series(slope, primalOf(slip_.friction()), lever, start, length);
    double most = 0;
    for (const std::size_t last : {ClockSeries<double>::kTerms - 2, ClockSeries<double>::kTerms - 1}) {
      double sum = 0;
      for (std::size_t i = 0; i <= last; ++i) sum += std::abs(series.u[i]) * series.spin[last - i].norm();
      most = std::max(most, sum);
    }
    return most;
  }
  bool clockGrows() const { return primalsOf(slip_.slope()).norm() > primalOf(slip_.friction()); }
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
