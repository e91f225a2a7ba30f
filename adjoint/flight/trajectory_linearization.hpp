// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "adjoint/scene/body_model.h"

/// First derivatives of a trajectory, forward and reverse.
namespace carom::adjoint_detail {

/// From the start of an arc to one time, fixed. Not for use from two threads at once.
class TrajectoryLinearization {
 public:
  virtual ~TrajectoryLinearization() = default;
  /// Of the state at that time.
  virtual StateDerivative tangent(const StateDerivative& dstart, const SceneTangent& dscene,
                                  const BodyModelDerivative& dmodel) const = 0;
  /// Its adjoint: that at the start; adds to those of the scene and of the model.
  virtual StateDerivative pullback(const StateDerivative& end_bar, SceneGradient& scene_bar,
                                   BodyModelDerivative& model_bar) const = 0;
};

/// The row of the guard of a trajectory by the state at its end, and by all else.
struct PathGuard {
  StateDerivative by_state;
  double by_time = 0;  ///< beyond that by the state: of supports that move
  std::function<double(const SceneTangent&, const BodyModelDerivative&)> tangent;
  std::function<void(double sigma, SceneGradient&, BodyModelDerivative&)> pullback;
};

/// What a trajectory does to the state with which it starts, of one participant, at the time of the event.
struct PathStart {
  std::size_t participant = 0;
  std::function<StateDerivative(const StateDerivative&, const SceneTangent&, const BodyModelDerivative&)> tangent;
  std::function<StateDerivative(const StateDerivative& bar, SceneGradient&, BodyModelDerivative&)> pullback;
};

}  // namespace carom::adjoint_detail
