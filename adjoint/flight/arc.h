// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "adjoint/base/times.h"
#include "adjoint/flight/rotation_sensitivity.h"
#include "adjoint/scene/body_model.h"

namespace carom {

namespace adjoint_detail {
class Trajectory;
struct ContactPath;
struct TrajectoryBounds;
}

/// Motion of a body on an arc: free flight, or persistent contact with fixed or kinematic bodies: rest, slide (at one
/// contact at least), roll, pivot (rotation about contacts that do not move: tipping, rocking), or ride (at rest on a
/// support that moves, or whose surface does); see docs/equations.md section 11.
enum class ArcKind { flight, rest, slide, roll, pivot, ride };
/// "flight", "rest", "slide", "roll", "pivot" or "ride".
const char* nameOf(ArcKind kind);

/// Cause of a transition: the slip ends, a contact reaches the boundary of its feature, or the force at a corner of a
/// body that slides without rotating vanishes (tips). For a body on corners, edges and faces that may rotate: the
/// force at a contact vanishes (lifts), it begins to slip, or its slip ends (sticks).
enum class TransitionCause : std::uint8_t { none, slip_ends, leaves, tips, lifts, slips, sticks };
/// "none", "slip_ends", "leaves", "tips", "lifts", "slips" or "sticks".
const char* nameOf(TransitionCause cause);

/// Rotation model of a flight; see docs/equations.md section 2.
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

/// One segment of a world-line from `start()` on: free flight of one body, in closed form or as Taylor segments, or a
/// trajectory in persistent contact. A fixed body has one constant arc. Copies share the trajectory: what one of them
/// extends is known to all.
class Arc {
 public:
  /// A flight from the given state, under the scene's gravity times the model's gravity factor.
  Arc(std::shared_ptr<const BodyModel> model, Tier tier, const Vec3& gravity, double start, const State& state);
  /// The same with a copy of the model.
  Arc(const BodyModel& model, Tier tier, const Vec3& gravity, double start, const State& state);
  /// On a trajectory; `slot`: which of the bodies that it moves.
  Arc(std::shared_ptr<const BodyModel> model, Tier tier, std::shared_ptr<adjoint_detail::Trajectory> trajectory,
      double start, const State& state, int slot = 0);

  /// A copy that is extended apart from this one.
  Arc fork() const;
  /// The same arc on a copy of its trajectory.
  Arc on(std::shared_ptr<adjoint_detail::Trajectory> trajectory) const;

  ArcKind kind() const;                                     ///< flight, or the kind of persistent contact
  bool isStraight() const { return straight_; }             ///< its acceleration is constant
  bool isFlight() const { return flies_; }                  ///< free flight, or a fixed body
  /// Whether it lies in persistent contact.
  bool inContact() const { return !flies_ && kind() != ArcKind::flight; }
  adjoint_detail::Trajectory& trajectory() const { return *trajectory_; }  ///< how it moves
  const std::shared_ptr<adjoint_detail::Trajectory>& shared() const { return trajectory_; }  ///< the same
  int slot() const { return slot_; }                        ///< which of the bodies of its trajectory
  /// Its closed form in persistent contact; null for any other arc.
  const adjoint_detail::ContactPath* closedForm() const;
  Tier tier() const { return tier_; }                       ///< of its rotation
  double start() const { return start_; }                   ///< s
  const State& startState() const { return state_; }        ///< at the start
  const BodyModel& model() const { return *model_; }        ///< of its body
  /// Of the centre of mass at the start, m/s^2; constant except on a curved slide and on integrated paths.
  const Vec3& acceleration() const { return acceleration_; }
  /// |acceleration(t) - acceleration()| is at most this over the whole arc, m/s^2; 0 for a flight.
  double accelerationVariation() const { return variation_; }
  bool moving() const { return model_->moving; }            ///< false for a fixed body
  /// Whether the body stays where it is whatever happens: fixed, or kinematic without velocity and angular velocity, its
  /// center of mass at its origin.
  bool stays() const;

  /// Extends the arc so that the functions below can be called up to time t (work only for Tier::triaxial and what is integrated).
  /// Throws InputError for a time that is not finite, NotComputable if the rotation cannot be computed that far.
  void extendTo(double t);
  /// Neither a bool nor a character is a time.
  template <NoTime T>
  void extendTo(T t) = delete;
  /// The functions below can be called up to this time; infinite if everywhere.
  double availableUntil() const;
  /// Of an integrated path, the time up to which it is computed, or its end; otherwise infinite. Later times are not
  /// on the path.
  double knownUntil() const;

  /// Number of pieces so far: the work done by `extendTo`.
  std::size_t series() const;
  /// Whether it is integrated step by step, as far as it is read.
  bool isIntegrated() const;

  State stateAt(double t) const;  ///< at time t, which must be available
  /// The same as pose and velocities.
  Kinematics kinematicsAt(double t) const { return kinematicsOf(stateAt(t)); }
  /// Of a state of this body.
  Kinematics kinematicsOf(const State& state) const;
  Vec3 positionAt(double t) const;  ///< m, of the centre of mass
  Vec3 velocityAt(double t) const;  ///< m/s, of the centre of mass
  /// Neither a bool nor a character is a time.
  template <NoTime T>
  State stateAt(T t) const = delete;
  /// The same.
  template <NoTime T>
  Kinematics kinematicsAt(T t) const = delete;
  /// The same.
  template <NoTime T>
  Vec3 positionAt(T t) const = delete;
  /// The same.
  template <NoTime T>
  Vec3 velocityAt(T t) const = delete;
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
  double precession() const;

  /// Sensitivity of the rotation from start() to t. `tier` is the one the derivative needs: Tier::triaxial gives
  /// dtheta_dI for free, independent moments, and with `products` dtheta_dproducts; Tier::symmetric and
  /// Tier::spherical give dtheta_dI for changes that keep the symmetry.
  RotationSensitivity rotationSensitivity(double t, Tier tier, bool products = false) const;

 private:
  void take(const adjoint_detail::TrajectoryBounds& bounds);

  std::shared_ptr<const BodyModel> model_;
  std::shared_ptr<adjoint_detail::Trajectory> trajectory_;
  Tier tier_;
  int slot_ = 0;
  bool flies_ = true, straight_ = true;
  double start_;
  double spin_bound_ = 0, spin_rate_bound_ = 0, variation_ = 0;
  Vec3 acceleration_ = Vec3::Zero();
  State state_;
};

/// Tangent of the flight from arc.start() to t at fixed times: ds(t) from ds(start), dg and the model's derivative.
StateDerivative flightTangent(const Arc& arc, double t, const RotationSensitivity& S, const StateDerivative& dstart,
                              const Vec3& dgravity, const BodyModelDerivative& dmodel);
/// Its adjoint: from the adjoint at t to the adjoint at start; adds to those of gravity and the model.
StateDerivative flightPullback(const Arc& arc, double t, const RotationSensitivity& S, const StateDerivative& end_bar,
                               Vec3& gravity_bar, BodyModelDerivative& model_bar);

}  // namespace carom
