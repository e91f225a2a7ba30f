// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/motion.h"

namespace carom {

namespace adjoint_detail {
class EventLinearization;
class GroupPath;
class SingleImpact;
class SharedLinearization;
class Trajectory;
class TrajectoryLinearization;
struct PathNearMiss;
}

/// Sensitivity of the state of a body at a time on an arc to the start of the arc and the scene.
struct ArcSensitivity : RotationSensitivity {
  /// Of any trajectory but a flight, whose rotation alone has a sensitivity; null for a flight.
  std::shared_ptr<const adjoint_detail::TrajectoryLinearization> trajectory;
  /// Of one that several bodies share; null for any other.
  std::shared_ptr<const adjoint_detail::SharedLinearization> shared;
};

/// When a state is read: at a fixed time, or just before or after an event (then the time varies with the scene
/// parameters). A body that takes no part in the event is read at the time of the event.
struct Instant {
  Seconds time = 0;      ///< s, if there is no event
  int event = -1;        ///< just before this one; -1: at a time
  bool follows = false;  ///< just after the event instead

  /// At a given time, s.
  static Instant at(double time) { return {time, -1}; }
  /// Neither a bool nor a character is a time.
  template <NoTime T>
  static Instant at(T time) = delete;
  /// Just before an event.
  static Instant before(int event) { return {0, event}; }
  /// Just after an event.
  static Instant after(int event) { return {0, event, true}; }
};

/// A linear functional of the state of a body at an instant, in terms of BodyState: weights of position, orientation
/// (world rotation vector), velocity, angular velocity and the time of the event; also of the centre of mass, and of
/// scene parameters on which a reading depends directly, not through the motion.
struct StateSeed {
  int body = -1;  ///< whose state is read
  Instant at;     ///< when
  Vec3 position = Vec3::Zero();          ///< weights of the position
  Vec3 orientation = Vec3::Zero();       ///< weights of the orientation, as a world rotation vector
  Vec3 velocity = Vec3::Zero();          ///< weights of the velocity
  Vec3 angular_velocity = Vec3::Zero();  ///< weights of the angular velocity
  Vec3 center_of_mass = Vec3::Zero();  ///< weights of the position of the centre of mass
  double time = 0;                       ///< weight of the time of the event
  double mass = 0;                       ///< weight of the body's mass
  Mat3 inertia = Mat3::Zero();           ///< weights of its inertia tensor about the centre of mass, axes of the shape
  Eigen::VectorXd size = {};             ///< weights of the dimensions of its shape; empty: none
  Vec3 gravity = Vec3::Zero();           ///< weights of the scene's gravity

  /// All weights times a number.
  StateSeed& operator*=(double factor);
};

/// Reliability of a derivative: the smallest margins of the events that it passes through.
struct Reliability {
  bool reliable = true;        ///< no margin is below kReliableMargin
  int events = 0;              ///< events that the quantity depends on
  double smallest_margin = 1;  ///< see Margins
  std::string message;         ///< the reason if not reliable

  /// Materials with friction 0 with respect to which the derivative is unreliable, and the reason at the first such
  /// event.
  std::vector<int> frictions;
  std::string friction_message; ///< reason; empty if there are none
  /// Bodies with respect to whose initial velocity and spin the derivative is unreliable: they start to slip from
  /// zero slip, so that it is one-sided, along the slope.
  std::vector<int> beginning;
  std::string beginning_message; ///< reason; empty if there are none
  /// Fixed and kinematic bodies with respect to whose surface velocities the derivative is unreliable: others stay in contact
  /// with them, and what such contact has of a surface that begins to move is not followed.
  std::vector<int> surfaces;
  std::string surface_message; ///< reason; empty if there are none
  /// Fixed bodies with respect to whose individual pose or size the derivative is unreliable: contacts are at a seam
  /// between them.
  std::vector<int> seams;
  std::string seam_message; ///< reason; empty if there are none

  /// Records an event that the derivative passes through.
  void pass(const Motion& motion, int event);
  /// `margin`: distance of frictionless contacts from zero slip; `shared`: redundant contacts share their load as
  /// selected by minimal friction.
  void passFriction(const Motion& motion, int event, double margin, bool shared);
  /// Records an arc of a body that the derivative passes through. For constrained motion the margin is the smallest
  /// distance of a contact from lifting, slipping, sticking or leaving its feature without doing so, relative to the
  /// forces, speeds and lengths of the path.
  void passArc(const Motion& motion, int body, int arc);
  /// Requests the derivative with respect to the friction of a material, too.
  void askFriction(int material);
  /// Requests the derivative with respect to the velocity of a body, too.
  void askVelocity(int body);
  /// The same for its spin.
  void askSpin(int body) { askVelocity(body); }
  /// Requests the derivative with respect to the surface velocity or surface angular velocity of a body, too.
  void askSurface(int body);
  /// Requests the derivative with respect to the pose or size of a body, too.
  void askPlace(int body);

 private:
  void passConstrained(const Motion& motion, int body, const Arc& arc, double until);
  void passGroup(const Motion& motion, const adjoint_detail::GroupPath& path, double until);
  void passNearMiss(const Motion& motion, const adjoint_detail::PathNearMiss& miss, int a, int b);
  void passBeginning(const Motion& motion, int body, int arc);
  void passLoose(const Motion& motion, int body, int arc);
  void passStill(const Motion& motion, int body, const Arc& arc);
  void passSeams(const Motion& motion, int event);
};

/// Linearisations of arcs and events of one motion, computed on first use and shared by all rows of a Jacobian. Not
/// thread-safe. Keeps a reference to the motion.
class DerivativeTape {
 public:
  /// The motion must outlive the tape. Throws InputError for one without recorded events. `look` is called before every
  /// linearisation, of which some take milliseconds; what it throws ends the pass, and the tape stays good.
  explicit DerivativeTape(const Motion& motion, std::function<void()> look = {});
  /// Of a temporary motion, which would be gone.
  explicit DerivativeTape(const Motion&&, std::function<void()> look = {}) = delete;
  ~DerivativeTape();

  const Motion& motion() const { return motion_; }  ///< the linearised motion
  /// Sensitivity over arc k of a body, which ends in an event.
  const ArcSensitivity& arc(int body, int k);
  /// Sensitivity up to an event at `time` of the arc on which a participant arrives there; good until the next call.
  const ArcSensitivity& until(const Participant& participant, double time);
  /// Sensitivity from the start of arc k to time t; cached, because the rows of a Jacobian share their times.
  ArcSensitivity arcUntil(int body, int k, double t);
  /// Linearisation of an event.
  const adjoint_detail::EventLinearization& event(int event);
  /// The same for an impact of one contact, in fixed-size matrices, for reverse passes; null for any other event.
  const adjoint_detail::SingleImpact* singleImpact(int event);

 private:
  ArcSensitivity sensitivity(int body, int k, double t);

  const Motion& motion_;
  std::function<void()> look_;  // may be empty
  std::vector<std::vector<std::unique_ptr<ArcSensitivity>>> arcs_;
  std::map<std::tuple<int, int, double>, ArcSensitivity> until_;  // by body, arc and time
  // one for all bodies of a trajectory
  std::map<std::pair<const adjoint_detail::Trajectory*, double>, std::shared_ptr<const adjoint_detail::SharedLinearization>> shared_;
  std::vector<std::unique_ptr<adjoint_detail::EventLinearization>> events_;
  std::vector<std::unique_ptr<adjoint_detail::SingleImpact>> single_impacts_;
  std::vector<int> materials_;  // of the bodies; -1 for none
};

}  // namespace carom
