// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/scene.h"

namespace carom::adjoint_detail {

/// The moving surface of a fixed or kinematic body (4.6 of docs/equations.md), with R its orientation and X its position:
///   beta = (1 - n n^T) B,  B = R beta0 + (R w0) x (p - X),
/// the velocity of its material at a contact at p with normal n, beside that of the body itself. World axes, m/s.
template <class S>
struct SurfaceMotion {
  V3<S> velocity, spin;  // beta0, w0, in the axes of the body
  M3<S> R;
  V3<S> X;

  /// Rates, or adjoints, of what beta depends on; theta: R <- exp([theta]x) R.
  struct Derivative {
    V3<S> point = V3<S>::Zero(), normal = V3<S>::Zero(), position = V3<S>::Zero(), theta = V3<S>::Zero();
    V3<S> velocity = V3<S>::Zero(), spin = V3<S>::Zero();
  };

  V3<S> at(const V3<S>& p, const V3<S>& n) const { return alongSurface(material(p), n); }

  V3<S> tangent(const V3<S>& p, const V3<S>& n, const Derivative& d) const {
    const V3<S> B = material(p), arm = p - X, turning = R * spin;
    const V3<S> dturning = d.theta.cross(turning) + R * d.spin;
    const V3<S> dB = d.theta.cross(V3<S>(R * velocity)) + R * d.velocity + dturning.cross(arm) +
                     turning.cross(V3<S>(d.point - d.position));
    return alongSurface(dB, n) - d.normal * n.dot(B) - n * d.normal.dot(B);
  }

  Derivative pullback(const V3<S>& p, const V3<S>& n, const V3<S>& bar) const {
    const V3<S> B = material(p), arm = p - X, turning = R * spin;
    const V3<S> B_bar = alongSurface(bar, n), turning_bar = arm.cross(B_bar);
    Derivative d;
    d.normal = -(n.dot(B) * bar) - n.dot(bar) * B;
    d.velocity = R.transpose() * B_bar;
    d.spin = R.transpose() * turning_bar;
    d.theta = V3<S>(R * velocity).cross(B_bar) + turning.cross(turning_bar);
    d.point = B_bar.cross(turning);
    d.position = -d.point;
    return d;
  }

 private:
  V3<S> material(const V3<S>& p) const { return R * velocity + V3<S>(R * spin).cross(V3<S>(p - X)); }
  static V3<S> alongSurface(const V3<S>& B, const V3<S>& n) { return B - n * n.dot(B); }
};

}  // namespace carom::adjoint_detail
