// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/body_model.h"

/// Reverse passes of one body, in any kind of number S: its start as written and its mass properties. A `Model` is a
/// BodyModel or a DualModel.
namespace carom::adjoint_detail {

/// What the functions below ask of a BodyModel; of a DualModel see dual_state.hpp.
inline Vec3 spinOf(const BodyModel& m, const Mat3& R, const Vec3& L) {
  return R * m.inverse_inertia.cwiseProduct(R.transpose() * L);
}
inline Mat3 inertiaWorld(const BodyModel& m, const Mat3& R) { return R * m.inertia.asDiagonal() * R.transpose(); }

/// See body_model.h; R_WG and w are the orientation and the angular velocity as written.
template <class S, class Model>
void startPullbackOf(const Model& model, const M3<S>& R_WG, const V3<S>& w, const StateDerivativeOf<S>& bar,
                     BodyDerivativeOf<S>& body_bar, BodyModelDerivativeOf<S>& model_bar) {
  body_bar.position += bar.x;
  body_bar.orientation += bar.theta;
  if (!model.moving) return;
  const M3<S> R = R_WG * model.R_BG.transpose(), J = inertiaWorld(model, R);
  body_bar.orientation += (R_WG * model.center).cross(bar.x);
  model_bar.center += R_WG.transpose() * bar.x;
  body_bar.velocity += bar.v;
  const V3<S> w_bar = J * bar.L, Jw = J * w;
  body_bar.angular_velocity += w_bar;
  // L_bar.(dtheta x Jw) = dtheta.(Jw x L_bar);  -w_bar.(dtheta x w) = -dtheta.(w x w_bar)
  body_bar.orientation += Jw.cross(bar.L) - w.cross(w_bar);
  model_bar.addInertiaBar((R.transpose() * bar.L) * (R.transpose() * w).transpose());
}

/// See body_model.h; `solid` has the fields of SolidProperties, of no rates where nothing follows from the shape.
template <class S, class Model, class Solid>
void modelPullbackOf(const Body& body, const Model& model, const S& density, const Solid& solid,
                     const BodyModelDerivativeOf<S>& model_bar, BodyDerivativeOf<S>& body_bar) {
  const bool derived = !body.kinematic && body.inertia.source == Inertia::Source::derived;
  if (!derived && !body.kinematic) body_bar.inertia += model_bar.inertia;
  S mass_bar = model_bar.mass;
  M3<S> dJ_G_bar = M3<S>::Zero();
  if (derived) {
    // <dJ_bar, dJ> with dJ symmetric: half of each product stands on either side of the diagonal
    M3<S> dJ_bar = model_bar.inertia.asDiagonal();
    dJ_bar(1, 2) = dJ_bar(2, 1) = 0.5 * model_bar.products[0];
    dJ_bar(0, 2) = dJ_bar(2, 0) = 0.5 * model_bar.products[1];
    dJ_bar(0, 1) = dJ_bar(1, 0) = 0.5 * model_bar.products[2];
    dJ_G_bar = model.R_BG.transpose() * dJ_bar * model.R_BG;
    mass_bar += dJ_G_bar.cwiseProduct(solid.unit_inertia).sum();
  }
  for (std::size_t d = 0; d < solid.rates.size(); ++d) {
    const auto& rate = solid.rates[d];
    S& size_bar = body_bar.size[static_cast<Eigen::Index>(d)];
    if (derived) size_bar += model.mass * dJ_G_bar.cwiseProduct(rate.unit_inertia).sum();
    if (!body.center_of_mass) size_bar += model_bar.center.dot(rate.center);
    if (body.density && !body.kinematic) size_bar += mass_bar * density * rate.volume;
  }
  if (body.kinematic) return;  // its centre alone follows from what is written
  (body.density ? body_bar.density : body_bar.mass) += body.density ? S(mass_bar * solid.volume) : mass_bar;
}

}  // namespace carom::adjoint_detail
