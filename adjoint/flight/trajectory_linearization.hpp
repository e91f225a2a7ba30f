// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

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

/// The same of a trajectory that several bodies share, from the starts of their arcs, in the order of their slots.
class SharedLinearization {
 public:
  struct Member {
    int body, arc;
  };
  /// What it starts from, or the adjoints of that.
  struct Starts {
    std::vector<StateDerivative> state;
    std::vector<BodyModelDerivative> model;
    explicit Starts(std::size_t members) : state(members), model(members) {}
  };
  virtual ~SharedLinearization() = default;

  const std::vector<Member>& members() const { return members_; }
  /// Of the state of the body of a slot.
  virtual StateDerivative tangent(std::size_t slot, const Starts& starts, const SceneTangent& dscene) const = 0;
  /// Its adjoint; adds to those of the scene.
  virtual Starts pullback(std::size_t slot, const StateDerivative& end_bar, SceneGradient& scene_bar) const = 0;

 protected:
  std::vector<Member> members_;
};

/// The row of the guard of a trajectory by the states of its bodies at its end, and by all else: of the first participants of its event, in
/// their order.
struct PathGuard {
  std::vector<StateDerivative> by_state;
  double by_time = 0;  ///< beyond that by the states: of supports that move
  std::function<double(const SceneTangent&, std::span<const BodyModelDerivative>)> tangent;
  std::function<void(double sigma, SceneGradient&, std::span<BodyModelDerivative>)> pullback;
};

/// What a trajectory does to the state with which it starts, of one participant, at the time of the event.
struct PathStart {
  std::size_t participant = 0;
  std::function<StateDerivative(const StateDerivative&, const SceneTangent&, const BodyModelDerivative&)> tangent;
  std::function<StateDerivative(const StateDerivative& bar, SceneGradient&, BodyModelDerivative&)> pullback;
};

}  // namespace carom::adjoint_detail
