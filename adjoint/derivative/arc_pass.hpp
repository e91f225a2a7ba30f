// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/flight/trajectory_linearization.hpp"

/// Derivatives over a stretch of an arc, whatever the body does on it: forward and reverse.
namespace carom::adjoint_detail {

/// Tangent of the state at time t, fixed, from that at the start of the arc.
StateDerivative arcTangent(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& dstart,
                           const SceneTangent& dscene, const BodyModelDerivative& dmodel);
/// Its adjoint: from that at t to that at the start; adds to those of the scene and of the model.
StateDerivative arcPullback(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& end_bar,
                            SceneGradient& scene_bar, BodyModelDerivative& model_bar);

/// The same of arc k of a body, which others may share: `start_of(body, arc)` and `model_of(body)` give what it starts from.
template <class StartOf, class ModelOf>
StateDerivative arcTangent(const Motion& motion, int body, int k, double t, const ArcSensitivity& S, const StartOf& start_of,
                           const SceneTangent& dscene, const ModelOf& model_of) {
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(k)];
  if (!S.shared) return arcTangent(arc, t, S, start_of(body, k), dscene, model_of(body));
  const std::vector<SharedLinearization::Member>& members = S.shared->members();
  SharedLinearization::Starts starts(members.size());
  for (std::size_t m = 0; m < members.size(); ++m) {
    starts.state[m] = start_of(members[m].body, members[m].arc);
    starts.model[m] = model_of(members[m].body);
  }
  return S.shared->tangent(static_cast<std::size_t>(arc.slot()), starts, dscene);
}
/// Its adjoint: calls arrive(body, arc, bar) for what they start from; adds to those of the scene and of the models.
template <class Arrive, class ModelBars>
void arcPullback(const Motion& motion, int body, int k, double t, const ArcSensitivity& S, const StateDerivative& end_bar, const Arrive& arrive,
                 SceneGradient& scene_bar, ModelBars& model_bars) {
  const auto b = static_cast<std::size_t>(body);
  const Arc& arc = motion.world_lines[b].arcs[static_cast<std::size_t>(k)];
  if (!S.shared) return arrive(body, k, arcPullback(arc, t, S, end_bar, scene_bar, model_bars[b]));
  const SharedLinearization::Starts bars = S.shared->pullback(static_cast<std::size_t>(arc.slot()), end_bar, scene_bar);
  for (std::size_t m = 0; m < bars.state.size(); ++m) {
    const auto [other, other_arc] = S.shared->members()[m];
    model_bars[static_cast<std::size_t>(other)] += bars.model[m];
    arrive(other, other_arc, bars.state[m]);
  }
}

}  // namespace carom::adjoint_detail
