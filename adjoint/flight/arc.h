// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "adjoint/flight/rotation_sensitivity.h"
#include "adjoint/scene/body_model.h"

namespace carom {

namespace adjoint_detail {
class TriaxialRotation;
class IntegratedPath;
struct ContactPath;
}

/// What a body does on an arc: it flies freely, or stays in contact with what stands still, where it rests, slides at a
/// contact at least, rolls, or turns about corners and edges that stay where they are; see docs/equations.md section 11.
enum class ArcKind { flight, rest, slide, roll, pivot };
/// "flight", "rest", "slide", "roll" or "pivot".
const char* nameOf(ArcKind kind);

/// How the rotation of a flight is carried; see docs/equations.md section 2.
enum class Tier { none, spherical, symmetric, triaxial };
/// "none", "spherical", "symmetric" or "triaxial".
const char* nameOf(Tier tier);

/// Pose and velocity at one time: x and v of the centre of mass, R = R_WG (shape axes to world). With Tier::none R is
/// the start's.
struct Kinematics {
  Vec3 x = Vec3::Zero();      ///< m, centre of mass
  Mat3 R = Mat3::Identity();  ///< shape axes to world
  Vec3 v = Vec3::Zero();      ///< m/s
  Vec3 w = Vec3::Zero();      ///< rad/s, world axes
};

/// One stretch of a world-line from `start()` on: free flight of one body, known in closed form or as Taylor segments, or
/// a path in lasting contact. A fixed body has one arc, which stays where it is.
class Arc {
 public:
  /// A flight under the scene's gravity, or the model's share of it, from the given state.
  Arc(const BodyModel& model, Tier tier, const Vec3& gravity, double start, const State& state);
  /// A path in lasting contact.
  Arc(const BodyModel& model, Tier tier, const adjoint_detail::ContactPath& path, double start, const State& state);
  Arc(const Arc& other);             ///< keeps what was made available
  Arc& operator=(const Arc& other);  ///< the same
  Arc(Arc&&) noexcept;               ///< leaves an arc that can only be destroyed or assigned to
  Arc& operator=(Arc&&) noexcept;    ///< the same
  ~Arc();

  /// A copy that has an integrated path in common with this one: that grows in both. A path of many steps is dear to copy.
  Arc view() const;
  /// A copy for another motion, which keeps the model of the body itself. It has to be the same model.
  Arc withModel(const BodyModel& model) const;

  ArcKind kind() const;                                     ///< flight, or how the body stays in contact
  /// Of a body in lasting contact; null for a flight.
  const adjoint_detail::ContactPath* path() const { return path_.get(); }
  Tier tier() const { return tier_; }                       ///< of its rotation
  double start() const { return start_; }                   ///< s
  const State& startState() const { return state_; }        ///< at the start
  const BodyModel& model() const { return *model_; }        ///< of its body
  /// Of the centre of mass at the start, m/s^2; the same all the time but for a body that slides round a bend.
  const Vec3& acceleration() const { return acceleration_; }
  /// |acceleration(t) - acceleration()| is at most this over the whole arc, m/s^2; 0 for a flight.
  double accelerationVariation() const;
  bool moving() const { return model_->moving; }            ///< false for a fixed body

  /// Makes the motion up to time t available to the functions below (only Tier::triaxial has work to do). Throws
  /// InputError for a time that is not finite, NotComputable where the rotation cannot be followed that far.
  void extendTo(double t);
  /// Up to here the motion is available; infinite where all of it is.
  double availableUntil() const;
  /// Of a path that is integrated, up to where it is known or ends; else infinite. A later time is none of the path.
  double knownUntil() const;

  /// Series that carry the rotation so far: the work that `extendTo` has done.
  std::size_t series() const;
  /// The integrated path in contact that it is; null for any other arc.
  adjoint_detail::IntegratedPath* integrated() const;

  State stateAt(double t) const;  ///< at time t, which must be available
  /// The same as pose and velocities.
  Kinematics kinematicsAt(double t) const { return kinematicsOf(stateAt(t)); }
  /// Of a state of this body.
  Kinematics kinematicsOf(const State& state) const;
  Vec3 positionAt(double t) const;  ///< m, of the centre of mass
  Vec3 velocityAt(double t) const;  ///< m/s, of the centre of mass
  /// d(state)/dt of the flow at time t, where the state is `state`: (v, omega, acceleration, dL/dt). L is constant in
  /// flight.
  StateDerivative rateAt(double t, const State& state) const;
  /// The same at its start.
  StateDerivative startRate() const { return rateAt(start_, startState()); }

  /// Bound over the whole arc: |omega| <= spinBound(), rad/s.
  double spinBound() const { return spin_bound_; }
  /// Bound over the whole arc: |d omega/dt| <= spinRateBound(), rad/s^2.
  double spinRateBound() const { return spin_rate_bound_; }

  /// An axis of the body, in shape axes, that precesses about L at the constant rate precession() (rad/s): that of
  /// symmetry; zero where every axis does, nothing for a triaxial body.
  std::optional<Vec3> steadyAxis() const;
  /// Rate of that precession, rad/s.
  double precession() const { return state_.L.norm() * model_->inverse_inertia[(symmetry_axis_ + 1) % 3]; }

  /// Sensitivity of the rotation from start() to t. `tier` is the one the derivative needs: Tier::triaxial gives
  /// dtheta_dI for free, independent moments, and with `products` dtheta_dproducts; Tier::symmetric and
  /// Tier::spherical give dtheta_dI for changes that keep the symmetry.
  RotationSensitivity rotationSensitivity(double t, Tier tier, bool products = false) const;

 private:
  Arc(const Arc& other, std::unique_ptr<adjoint_detail::ContactPath> path);
  Quat rotationAt(double elapsed) const;
  void takeBounds();

  const BodyModel* model_;  // outlives the arc: held by the Motion
  Tier tier_;
  int symmetry_axis_ = 2;
  double start_;
  double spin_bound_ = 0, spin_rate_bound_ = 0;
  // Apart, so that most arcs are small.
  std::unique_ptr<adjoint_detail::TriaxialRotation> triaxial_;
  std::unique_ptr<adjoint_detail::ContactPath> path_;  // null: a flight
  Vec3 acceleration_;
  State state_;
};

/// Tangent of the flight from arc.start() to t at fixed times: ds(t) from ds(start), dg and the model's derivative.
StateDerivative flightTangent(const Arc& arc, double t, const RotationSensitivity& S, const StateDerivative& dstart,
                              const Vec3& dgravity, const BodyModelDerivative& dmodel);
/// Its adjoint: from the adjoint at t to the adjoint at start; adds to those of gravity and the model.
StateDerivative flightPullback(const Arc& arc, double t, const RotationSensitivity& S, const StateDerivative& end_bar,
                               Vec3& gravity_bar, BodyModelDerivative& model_bar);

}  // namespace carom
