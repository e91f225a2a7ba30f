// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "adjoint/base/types.h"
#include "adjoint/contact/decay_integrals.hpp"
#include "adjoint/contact/slip_clock.hpp"

namespace carom::adjoint_detail {

/// Slip s, its integral over time, and its direction.
template <class S>
struct Slip {
  V3<S> s, integral, direction;
};

/// Solution of s' = g - c s/|s| in a plane (11.3 to 11.6). On the clock dt = |s| d xi the equations of s and |s| are
/// linear with constant coefficients, a = |g|:
///   |s| = exp(-c xi) (u cosh(a xi) + h sinh(a xi)/a),   u = |s0|, h = s0.g,
///   s = exp(-c xi) (s0 + g (u sinh(a xi)/a + h (cosh(a xi) - 1)/a^2)),
/// and times and integrals of s are sums of integrals of exponentials. Where a is small they are power series in a^2,
/// smooth where the direction of g is not defined; else they are split by that direction.
template <class S>
class GlideSlip {
 public:
  /// `scale`: the speeds that s0 is a difference of, whose rounding it has.
  GlideSlip(const V3<S>& s0, const V3<S>& g, const S& c, double scale)
      : s0_(s0), g_(g), c_(c), h_(s0.dot(g)), scale_(scale) {
    using std::sqrt;
    const Vec3 s = primalsOf(s0), slope = primalsOf(g);
    const double friction = primalOf(c), a = slope.norm(), speed = s.norm();
    moving_ = speed > 0;
    if (moving_) u_ = sqrt(s0.squaredNorm());
    straight_ = !moving_ || s.cross(slope).norm() <= 16 * std::numeric_limits<double>::epsilon() * scale *
                                                         std::max(a, friction);
    reverses_ = moving_ && straight_ && a >= friction && s.dot(slope) < 0 && a > 0;
    steep_ = a > kSmallSlope * friction;
    if (a > 0 && (steep_ || !moving_)) split();
    clock_ = clock(a);
  }

  bool straight() const { return straight_; }
  /// When the slip is 0; nothing where it never is, or is at the start.
  std::optional<S> end() const {
    if (!moving_) return std::nullopt;
    if (reverses_) return S(Q_ / (c_ + a_));
    if (!(primalOf(c_) > clock_.a)) return std::nullopt;
    if (steep_) return S(P_ / (c_ - a_) + Q_ / (c_ + a_));
    return S((c_ * u_ + h_) / (c_ * c_ - g_.squaredNorm()));
  }
  /// At the end, with the limits from before.
  Slip<S> atEnd() const;
  /// At a time before the end.
  Slip<S> at(const S& t) const {
    if (!moving_) return fromRest(t);
    if constexpr (kOrderOf<S> == 0) {
      if (straight_) return alongLine(t);
    }
    return onClock(xiAt(t));
  }
  Slip<S> onClock(const S& xi) const { return useSteep(xi) ? atSteep(xi) : atLevel(xi); }

  /// The clock at a time before the end, and back; slip and speed on it.
  S xiAt(const S& t) const {
    S xi = clock_.xiAt(primalOf(t));
    for (int k = 0; k < kOrderOf<S>; ++k) xi -= (timeAt(xi) - t) / speedAt(xi);
    return xi;
  }
  S timeAt(const S& xi) const {
    if (useSteep(xi)) return P_ * decayIntegral<S>(c_ - a_, xi) + Q_ * decayIntegral<S>(c_ + a_, xi);
    const int terms = termsAt(xi);
    const Moments<S> m = decayMoments(c_, xi, 2 * terms + 2);
    return u_ * series(m, 0, 1, terms) + h_ * series(m, 1, 1, terms);
  }
  S speedAt(const S& xi) const;
  V3<S> slipAt(const S& xi) const;
  /// Whether there is slip at the start.
  bool moving() const { return moving_; }
  const V3<S>& start() const { return s0_; }
  const V3<S>& slope() const { return g_; }
  const S& friction() const { return c_; }
  double scale() const { return scale_; }
  bool isStraightFrom(const S& xi) const { return clock_.tiltAt(primalOf(xi)) < 1e-19; }

 private:
  static constexpr double kSmallSlope = 0.2;

  bool useSteep(const S& xi) const {
    return steep_ && clock_.a * primalOf(xi) > kSmallSlope * std::max(1.0, clock_.c * primalOf(xi));
  }
  void split() {
    using std::sqrt;
    a_ = sqrt(g_.squaredNorm());
    along_ = g_ / a_;
    const S part = s0_.dot(along_);
    across_ = s0_ - along_ * part;
    if (!moving_) return;
    P_ = Q_ = 0;
    if (primalOf(part) < 0) {
      Q_ = 0.5 * (u_ - part);
      if (!reverses_) P_ = 0.25 * across_.squaredNorm() / Q_;
    } else {
      P_ = 0.5 * (u_ + part);
      Q_ = 0.25 * across_.squaredNorm() / P_;
    }
  }
  SlipClock clock(double a) const {
    if (!moving_) return {0, 0, a, primalOf(c_)};
    if (steep_) return {primalOf(P_), primalOf(Q_), a, primalOf(c_)};
    const double u = primalOf(u_), part = a > 0 ? primalOf(h_) / a : 0;
    return {0.5 * (u + part), 0.5 * (u - part), a, primalOf(c_)};
  }

  // How many terms of the series in a^2 make a difference, with those that only rates see.
  int termsAt(const S& xi) const {
    const double y = primalOf(xi), ratio = clock_.a * (clock_.c * y > 1 ? 1 / clock_.c : y);
    double power = 1;
    int terms = 3;
    for (; terms < 15 && power > 1e-18; ++terms) power *= ratio * ratio;
    return terms;
  }
  // Sum of (factor a^2)^j m[offset + 2j].
  S series(const Moments<S>& m, std::size_t offset, double factor, int terms) const {
    const S a2 = g_.squaredNorm() * factor;
    S sum = 0;
    for (int j = terms; j-- > 0;) sum = sum * a2 + m[offset + 2 * static_cast<std::size_t>(j)];
    return sum;
  }
  // Sum over j > 0 of (4^j - 1) a^(2j - 2) m[offset + 2j].
  S doubled(const Moments<S>& m, std::size_t offset, int terms) const {
    const S a2 = g_.squaredNorm();
    S sum = 0;
    for (int j = terms; j-- > 1;)
      sum = sum * a2 + m[offset + 2 * static_cast<std::size_t>(j)] * (std::ldexp(1.0, 2 * j) - 1);
    return sum;
  }

  std::array<S, 3> hyperbolic(const S& xi) const;

  // Of a slip that goes straight. The one of a slope is better known: a slow slip is rounding of the speeds that it is a
  // difference of, and a steep slope would not let what it has across live on.
  V3<S> lineDirection() const {
    if (!steep_) return s0_ / u_;
    return primalOf(h_) < 0 ? V3<S>(-along_) : along_;
  }
  Slip<S> alongLine(const S& t) const {
    const V3<S> direction = lineDirection();
    return {s0_ + (g_ - direction * c_) * t, (s0_ + (g_ - direction * c_) * (0.5 * t)) * t, direction};
  }
  // Slip that begins goes along the slope. Rates of the slip at the start count as far as they do.
  Slip<S> fromRest(const S& t) const;
  Slip<S> atSteep(const S& xi) const;
  Slip<S> atLevel(const S& xi) const;

  V3<S> s0_, g_, along_ = V3<S>::Zero(), across_ = V3<S>::Zero();
  S c_, h_, u_ = 0, a_ = 0, P_ = 0, Q_ = 0;
  double scale_;
  bool moving_ = false, straight_ = false, reverses_ = false, steep_ = false;
  SlipClock clock_{};
};

// exp(-c xi) times (cosh(a xi), sinh(a xi)/a, (cosh(a xi) - 1)/a^2).
template <class S>
std::array<S, 3> GlideSlip<S>::hyperbolic(const S& xi) const {
  using elementary::exp;
  using std::sqrt;
  const S a2 = g_.squaredNorm(), y = a2 * xi * xi, decay = exp(-(c_ * xi));
  if (primalOf(y) < 0.25) {
    S even = 1, odd = 1, second = 1;
    for (int k = 9; k >= 1; --k) {
      even = 1.0 + y * even / (2.0 * k * (2 * k - 1));
      odd = 1.0 + y * odd / (2.0 * k * (2 * k + 1));
      second = 1.0 + y * second / ((2.0 * k + 2) * (2 * k + 1));
    }
    return {decay * even, decay * odd * xi, decay * second * (0.5 * xi * xi)};
  }
  const S a = sqrt(a2), up = exp((a - c_) * xi), down = exp(-((a + c_) * xi));
  return {0.5 * (up + down), 0.5 * (up - down) / a, (0.5 * (up + down) - decay) / a2};
}

template <class S>
S GlideSlip<S>::speedAt(const S& xi) const {
  using elementary::exp;
  if (useSteep(xi)) return P_ * exp((a_ - c_) * xi) + Q_ * exp(-((a_ + c_) * xi));
  const std::array<S, 3> of = hyperbolic(xi);
  return u_ * of[0] + h_ * of[1];
}

template <class S>
V3<S> GlideSlip<S>::slipAt(const S& xi) const {
  using elementary::exp;
  const S decay = exp(-(c_ * xi));
  if (useSteep(xi))
    return along_ * (P_ * exp((a_ - c_) * xi) - Q_ * exp(-((a_ + c_) * xi))) + across_ * decay;
  const std::array<S, 3> of = hyperbolic(xi);
  return s0_ * decay + g_ * (u_ * of[1] + h_ * of[2]);
}

template <class S>
Slip<S> GlideSlip<S>::atEnd() const {
  using std::sqrt;
  const S c2 = c_ * c_, a2 = g_.squaredNorm();
  Slip<S> slip;
  slip.s = V3<S>::Zero();
  slip.direction = straight_ ? lineDirection() : V3<S>(g_ / sqrt(a2));  // it turns down the slope, be it ever so small
  if (steep_) {
    const S first = reverses_ ? S(0) : S(P_ * P_ / (2.0 * (c_ - a_)));
    const S across = reverses_ ? S(0) : S(P_ / (2.0 * c_ - a_));
    slip.integral = along_ * (first - Q_ * Q_ / (2.0 * (c_ + a_))) + across_ * (across + Q_ / (2.0 * c_ + a_));
  } else {
    const S twice = 4.0 * c2 - a2, once = 4.0 * (c2 - a2);
    slip.integral = s0_ * ((2.0 * c_ * u_ + h_) / twice) +
                    g_ * (u_ * u_ / once + (6.0 * c_ * u_ * h_ + 3.0 * h_ * h_) / (twice * once));
  }
  return slip;
}

template <class S>
Slip<S> GlideSlip<S>::fromRest(const S& t) const {
  // Without friction nothing needs a direction; with it and without a slope there is none, and nothing moves.
  if (!(clock_.a > clock_.c)) return {s0_, s0_ * t, V3<S>::Zero()};
  const S start = along_.dot(s0_), rate = a_ - c_;
  return {along_ * (start + rate * t), along_ * ((start + rate * (0.5 * t)) * t), along_};
}

template <class S>
Slip<S> GlideSlip<S>::atSteep(const S& xi) const {
  const V3<S> s = slipAt(xi);
  const S twice = 2.0 * c_;
  Slip<S> slip;
  slip.s = s;
  slip.direction = s / speedAt(xi);
  slip.integral =
      along_ * (P_ * P_ * decayIntegral<S>(2.0 * (c_ - a_), xi) - Q_ * Q_ * decayIntegral<S>(2.0 * (c_ + a_), xi)) +
      across_ * (P_ * decayIntegral<S>(twice - a_, xi) + Q_ * decayIntegral<S>(twice + a_, xi));
  return slip;
}

template <class S>
Slip<S> GlideSlip<S>::atLevel(const S& xi) const {
  const int terms = termsAt(xi);
  const Moments<S> m = decayMoments<S>(2.0 * c_, xi, 2 * terms + 2);
  Slip<S> slip;
  slip.s = slipAt(xi);
  slip.direction = slip.s / speedAt(xi);
  slip.integral = s0_ * (u_ * series(m, 0, 1, terms) + h_ * series(m, 1, 1, terms)) +
                  g_ * (u_ * u_ * series(m, 1, 4, terms) + u_ * h_ * doubled(m, 0, terms) +
                        h_ * h_ * doubled(m, 1, terms));
  return slip;
}

}  // namespace carom::adjoint_detail
