// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "adjoint/derivative/derivative_tape.h"

namespace carom {
namespace adjoint_detail {
class Influence;
}

/// Directional derivative of a BodyState; a world rotation vector for the orientation. `time` is the rate of the
/// instant itself (0 at a fixed time).
struct BodyStateRate {
  Vec3 position = Vec3::Zero();          ///< of the position
  Vec3 orientation = Vec3::Zero();       ///< of the orientation
  Vec3 velocity = Vec3::Zero();          ///< of the velocity
  Vec3 angular_velocity = Vec3::Zero();  ///< of the angular velocity
  Vec3 center_of_mass = Vec3::Zero();  ///< m/unit, of the position of the centre of mass
  double time = 0;                     ///< of the instant
  double mass = 0;                     ///< of the body's mass
  Mat3 inertia = Mat3::Zero();         ///< of its inertia tensor about the centre of mass, axes of the shape
  Eigen::VectorXd size = {};           ///< of the dimensions of its shape; empty: constant
  Vec3 gravity = Vec3::Zero();         ///< of the scene's gravity

  /// Rate of a functional: the sum of weights times rates.
  double dot(const StateSeed& seed) const;
};

/// Forward pass: directional derivative of the whole motion when the scene changes along `direction`. Equations 5.1
/// and 5.2 of docs/equations.md. Functions throw InputError for invalid bodies, arcs, events and instants.
class MotionTangent {
 public:
  /// Of the state of a body at an instant.
  BodyStateRate at(int body, const Instant& instant) const;
  /// Of the state at the start of an arc, at the fixed time at which it starts.
  const StateDerivative& start(int body, int arc) const;
  /// Of the mass properties of a body.
  const BodyModelDerivative& model(int body) const;
  /// d(time of event).
  double eventTime(int event) const;

 private:
  friend MotionTangent tangent(DerivativeTape& tape, const SceneTangent& direction,
                               const adjoint_detail::Influence* influence);
  DerivativeTape* tape_ = nullptr;
  SceneTangent direction_;  // only gravity without persistent contact: a flight needs no more
  std::vector<BodyModelDerivative> dmodels_;
  std::vector<std::vector<StateDerivative>> starts_;  // of every arc of every body, at fixed time
  std::vector<double> event_time_;
  std::vector<Eigen::VectorXd> sizes_;  // of every body; empty: constant
  StateDerivative stateTangent(int body, int arc, double t) const;
};

/// The tape must outlive the result. Throws InputError for a direction whose dimensions are not those of the scene,
/// or numbers that are not finite; NotComputable as `adjoint`.
MotionTangent tangent(DerivativeTape& tape, const SceneTangent& direction);

}  // namespace carom
