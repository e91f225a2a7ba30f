// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/glide_turn.hpp"

namespace carom::adjoint_detail {

/// Sliding on a face with Coulomb's friction, until the slip is 0 (11.1 to 11.6): a uniform ball, or a body that does
/// not turn. With 1/f = 1 + m r^2/I (1 for a block) and the slip s = v_t + w x (-r n) at the contact:
///   v = v0 + g t + f (s - s0 - g t),  w = w0 + (1 - f)/r n x (g t + s0 - s).
template <class S>
class GlidePath {
 public:
  static GlidePath ball(const PathInputs<S>& in) {
    const S inertia = ballInertia(in), k = inertia / (in.mass * in.reach * in.reach);
    const V3<S> spin = in.L / inertia, v = alongFace(in.normal, in.v);
    const V3<S> s = v - spin.cross(in.normal) * in.reach;
    const double scale = primalsOf(v).norm() + primalOf(in.reach) * primalsOf(spin).norm();
    return GlidePath(in, s, scale, k / (1.0 + k), inertia);
  }
  static GlidePath block(const PathInputs<S>& in) {
    const V3<S> s = alongFace(in.normal, in.v);
    return GlidePath(in, s, primalsOf(s).norm(), S(1), S(0));
  }

  const std::optional<S>& end() const { return end_; }
  const GlideSlip<S>& slip() const { return slip_; }
  bool isPastEnd(const S& t) const { return end_ && !(primalOf(t) < primalOf(*end_)); }
  V3<S> directionAt(const S& t) const { return (isPastEnd(t) ? slip_.atEnd() : slip_.at(t)).direction; }
  PathCenter<S> centerAt(const S& t) const {
    if (!isPastEnd(t)) return centerOf(slip_.at(t), t);
    PathCenter<S> center = centerOf(slip_.atEnd(), *end_);
    advance(center, beyondEnd(t));
    return center;
  }
  /// At the time of a slip.
  PathCenter<S> centerOf(const Slip<S>& slip, const S& t) const {
    const V3<S> &g = slip_.slope(), &s0 = slip_.start();
    return {in_.x + (v0_ + g * (0.5 * t)) * t + (slip.integral - (s0 + g * (0.5 * t)) * t) * share_,
            v0_ + g * t + (slip.s - s0 - g * t) * share_};
  }
  V3<S> spinAt(const S& t) const {
    if (!isPastEnd(t)) return spinOf(slip_.at(t), t);
    return spinOf(slip_.atEnd(), *end_) + accelerationOfSpin(slip_.atEnd().direction) * beyondEnd(t);
  }
  /// `turning`: with the orientation; else it stays that of the start.
  PathState<S> stateAt(const S& t, bool turning = true) const;
  PathState<S> stateAtEnd(bool turning = true) const;
  /// At the end of the slip, and past it, the limit from before.
  StateDerivativeOf<S> rateAt(const S& t) const {
    const bool past = isPastEnd(t);
    const Slip<S> slip = past ? slip_.atEnd() : slip_.at(t);
    const S now = past ? *end_ : t;
    return {centerOf(slip, now).v, spinOf(slip, now), acceleration(slip.direction),
            accelerationOfSpin(slip.direction) * inertia_};
  }
  V3<S> acceleration(const V3<S>& direction) const { return slip_.slope() - direction * (share_ * slip_.friction()); }
  V3<S> accelerationOfSpin(const V3<S>& direction) const { return lever_.cross(direction) * slip_.friction(); }
  const V3<S>& lever() const { return lever_; }
  const V3<S>& startSpin() const { return spin_; }

 private:
  GlidePath(const PathInputs<S>& in, const V3<S>& s, double scale, const S& share, const S& inertia)
      : in_(in),
        v0_(alongFace(in.normal, in.v)),
        share_(share),
        inertia_(inertia),
        turns_(primalOf(inertia) > 0),
        slip_(in.begins ? ratesOnly(s) : s, alongFace(in.normal, in.gravity), in.friction * pressingGravity(in) / share, scale) {
    if (turns_) {
      lever_ = in.normal * ((1.0 - share) / in.reach);
      spin_ = in.L / inertia;
    }
    end_ = slip_.end();
  }

  // A slip that begins is 0, and only what it varies by counts.
  static V3<S> ratesOnly(V3<S> s) {
    for (S& x : s) x -= primalOf(x);
    return s;
  }
  // What an end that moves along has of the time past it: nothing but rates.
  S beyondEnd(const S& t) const {
    S late = t - *end_;
    return late - primalOf(late);
  }
  void advance(PathCenter<S>& center, const S& late) const {
    if constexpr (kOrderOf<S> > 0) {
      const V3<S> a = acceleration(slip_.atEnd().direction);
      center.x += (center.v + a * (0.5 * late)) * late;
      center.v += a * late;
    }
  }
  V3<S> spinOf(const Slip<S>& slip, const S& t) const {
    if (!turns_) return V3<S>::Zero();
    return spin_ + lever_.cross(V3<S>(slip_.slope() * t + slip_.start() - slip.s));
  }
  M3<S> turnOverTime(const S& t, bool to_end) const {
    if (!slip_.moving() || (kOrderOf<S> == 0 && slip_.straight())) {
      const Slip<S> start = slip_.at(S(0));
      return turnOver<S>(spinOf(start, S(0)), accelerationOfSpin(start.direction), t);
    }
    return GlideTurn<S>(slip_, spin_, lever_).over(t, to_end);
  }

  PathInputs<S> in_;
  V3<S> v0_, lever_ = V3<S>::Zero(), spin_ = V3<S>::Zero();
  S share_, inertia_;
  bool turns_;
  GlideSlip<S> slip_;
  std::optional<S> end_;
};

template <class S>
PathState<S> GlidePath<S>::stateAt(const S& t, bool turning) const {
  if (isPastEnd(t)) {
    PathState<S> state = stateAtEnd(turning);
    if constexpr (kOrderOf<S> > 0) {
      const S late = beyondEnd(t);
      PathCenter<S> center{state.x, state.v};
      advance(center, late);
      state.x = center.x, state.v = center.v;
      if (turns_ && turning) state.R = turnBy<S>(spinOf(slip_.atEnd(), *end_) * late) * state.R;
      state.L += accelerationOfSpin(slip_.atEnd().direction) * (inertia_ * late);
    }
    return state;
  }
  const Slip<S> slip = slip_.at(t);
  const PathCenter<S> center = centerOf(slip, t);
  PathState<S> state{center.x, center.v, spinOf(slip, t) * inertia_, in_.R};
  if (turns_ && turning) state.R = turnOverTime(t, false) * in_.R;
  return state;
}

// The slip is 0 to the last bit that the state can hold: a block is at rest, and a ball has the spin of its velocity.
template <class S>
PathState<S> GlidePath<S>::stateAtEnd(bool turning) const {
  const Slip<S> slip = slip_.atEnd();
  const PathCenter<S> center = centerOf(slip, *end_);
  if (!turns_) return {center.x, V3<S>::Zero(), V3<S>::Zero(), in_.R};
  const V3<S> &n = in_.normal, spin = n.cross(center.v) / in_.reach + n * n.dot(spin_);
  PathState<S> state{center.x, center.v, spin * inertia_, in_.R};
  if (turning) state.R = turnOverTime(*end_, true) * in_.R;
  return state;
}

}  // namespace carom::adjoint_detail
