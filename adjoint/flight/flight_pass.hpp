// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/flight/rotation_sensitivity.h"
#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/body_model.h"

namespace carom::adjoint_detail {

/// Reverse pass of a flight in any kind of number S, see flightPullback; `gravity_factor`: the body's share of gravity.
template <class S>
StateDerivativeOf<S> flightPullbackOf(double gravity_factor, const S& elapsed, const RotationSensitivityOf<S>& rotation,
                                      const StateDerivativeOf<S>& end_bar, V3<S>& gravity_bar,
                                      BodyModelDerivativeOf<S>& model_bar) {
  StateDerivativeOf<S> d;
  d.x = end_bar.x;
  d.v = end_bar.v + elapsed * end_bar.x;
  d.theta = rotation.dtheta_dtheta.transpose() * end_bar.theta;
  d.L = end_bar.L + rotation.dtheta_dL.transpose() * end_bar.theta;
  gravity_bar += gravity_factor * V3<S>((0.5 * elapsed * elapsed) * end_bar.x + elapsed * end_bar.v);
  model_bar.inertia += rotation.dtheta_dI.transpose() * end_bar.theta;
  model_bar.products += rotation.dtheta_dproducts.transpose() * end_bar.theta;
  return d;
}

}  // namespace carom::adjoint_detail
