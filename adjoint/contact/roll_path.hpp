// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/contact/turn_series.hpp"

namespace carom::adjoint_detail {

/// Pure rolling on a face (11.7): a constant acceleration, and an angular velocity that is linear in time. What the
/// face fixes of the start (the velocity into it, the spin that rolling has) is taken from the rest of it, and
/// what it slips is stopped by friction at the contact, as it is at once where it is next to nothing: (11.29).
template <class S>
class RollPath {
 public:
  static RollPath ball(const PathInputs<S>& in) {
    const S inertia = ballInertia(in), k = inertia / (in.mass * in.reach * in.reach);
    RollPath path(in);
    path.v0_ = alongFace(in.normal, in.v);
    path.stopSlip(k, V3<S>(path.v0_ - (in.L / inertia).cross(in.normal) * in.reach));
    path.acceleration_ = alongFace(in.normal, in.gravity) / (1.0 + k);
    path.pivot_ = in.normal * (in.normal.dot(in.L) / inertia);
    path.ball_inertia_ = inertia;
    return path;
  }
  /// About its axis, which lies along the face; only what is across the axis moves it.
  static RollPath axle(const PathInputs<S>& in) {
    const S inertia = in.axis.dot(in.J * in.axis), k = inertia / (in.mass * in.reach * in.reach);
    const V3<S> axis = alongFace<S>(in.normal, in.R * in.axis), across = axis.cross(in.normal);
    const S length2 = axis.squaredNorm();
    RollPath path(in);
    path.v0_ = across * (across.dot(in.v) / length2);
    path.stopSlip(k, V3<S>(path.v0_ - across * (in.reach * V3<S>(in.R * in.axis).dot(in.L) / inertia)));
    path.acceleration_ = across * (across.dot(in.gravity) / (length2 * (1.0 + k)));
    return path;
  }

  PathCenter<S> centerAt(const S& t) const {
    const V3<S> v = v0_ + acceleration_ * t;
    return {in_.x + (v0_ + v) * (0.5 * t), v};
  }
  V3<S> spinAt(const S& t) const { return spinOf(centerAt(t).v); }
  V3<S> spinRate() const { return in_.normal.cross(acceleration_) / in_.reach; }
  /// `turning`: with the orientation; else it stays that of the start.
  PathState<S> stateAt(const S& t, bool turning = true) const {
    const PathCenter<S> center = centerAt(t);
    M3<S> R = in_.R;
    if (turning) R = turnOver<S>(spinAt(S(0)), spinRate(), t) * R;
    return {center.x, center.v, momentum(R, spinOf(center.v)), R};
  }
  StateDerivativeOf<S> rateAt(const S& t) const {
    const V3<S> v = centerAt(t).v;
    return {v, spinOf(v), acceleration_, momentum(in_.R, spinRate())};  // about axes of symmetry, so R may be any
  }
  const V3<S>& acceleration() const { return acceleration_; }

 private:
  explicit RollPath(const PathInputs<S>& in) : in_(in) {}
  void stopSlip(const S& k, const V3<S>& slip) {
    if (primalOf(in_.friction) > 0) v0_ -= slip * (k / (1.0 + k));
  }
  V3<S> spinOf(const V3<S>& v) const { return in_.normal.cross(v) / in_.reach + pivot_; }
  V3<S> momentum(const M3<S>& R, const V3<S>& spin) const {
    if (ball_inertia_) return spin * *ball_inertia_;
    return R * (in_.J * (R.transpose() * spin));
  }

  PathInputs<S> in_;
  V3<S> v0_, acceleration_, pivot_ = V3<S>::Zero();
  std::optional<S> ball_inertia_;
};

}  // namespace carom::adjoint_detail
