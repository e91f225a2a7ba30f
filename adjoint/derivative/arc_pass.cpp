// SPDX-License-Identifier: MIT
#include "adjoint/derivative/arc_pass.hpp"

#include "adjoint/flight/trajectory_linearization.hpp"

namespace carom::adjoint_detail {

StateDerivative arcTangent(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& dstart,
                           const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
  if (S.trajectory) return S.trajectory->tangent(dstart, dscene, dmodel);
  return flightTangent(arc, t, S, dstart, dscene.gravity, dmodel);
}

StateDerivative arcPullback(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& end_bar,
                            SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
  if (S.trajectory) return S.trajectory->pullback(end_bar, scene_bar, model_bar);
  return flightPullback(arc, t, S, end_bar, scene_bar.gravity, model_bar);
}

}  // namespace carom::adjoint_detail
