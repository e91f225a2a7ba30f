// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/body_pass.hpp"

namespace carom::adjoint_detail {

/// Exactly.
template <class S>
bool isZeroMatrix(const M3<S>& m) {
  return carom::isZero<S>(m.col(0)) && carom::isZero<S>(m.col(1)) && carom::isZero<S>(m.col(2));
}

/// What is read of a state, in any kind of number S, see seed.hpp; R and L are of the state, a `Seed` has the weights of a StateSeed.
template <class S, class Model, class Seed>
StateDerivativeOf<S> seedPullbackOf(const Model& model, const M3<S>& R, const V3<S>& L, const Seed& seed,
                                    BodyModelDerivativeOf<S>& model_bar) {
  StateDerivativeOf<S> bar;
  bar.x = seed.position + seed.center_of_mass;
  bar.theta = seed.orientation;
  bar.v = seed.velocity;
  if (!model.moving) return bar;
  model_bar.mass += seed.mass;
  if (!isZeroMatrix(seed.inertia)) model_bar.addInertiaBar(model.R_BG * seed.inertia * model.R_BG.transpose());
  const M3<S> R_WG = model.shapeToWorld(R);
  bar.theta += seed.position.cross(R_WG * model.center);  // -p_bar.(theta x c_W)
  model_bar.center -= R_WG.transpose() * seed.position;
  const V3<S>& w_bar = seed.angular_velocity;
  if (carom::isZero(w_bar)) return bar;
  const V3<S> A_w_bar = model.inverseInertiaWorld(R) * w_bar, omega = spinOf(model, R, L);
  bar.L = A_w_bar;
  // w_bar.(theta x omega) - A w_bar.(theta x L)
  bar.theta += omega.cross(w_bar) - L.cross(A_w_bar);
  model_bar.addInertiaBar(-(R.transpose() * A_w_bar) * (R.transpose() * omega).transpose());
  return bar;
}

}  // namespace carom::adjoint_detail
