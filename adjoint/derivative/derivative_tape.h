// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom {

namespace adjoint_detail {
class EventLinearization;
class SingleImpact;
class PathLinearization;
}

/// How the state of a body at the end of a stretch of an arc varies with its start and the scene.
struct ArcSensitivity : RotationSensitivity {
  /// Of a path in lasting contact, which all of it depends on; null for a flight.
  std::shared_ptr<const adjoint_detail::PathLinearization> path;
};

/// When a state is read: at a time, or just before or after an event (then the time itself moves with the causes). A
/// body that takes no part in the event is read at the time of the event.
struct Instant {
  double time = 0;       ///< s, where there is no event
  int event = -1;        ///< just before this one; -1: at a time
  bool follows = false;  ///< just after the event instead

  /// At a given time, s.
  static Instant at(double time) { return {time, -1}; }
  /// Just before an event.
  static Instant before(int event) { return {0, event}; }
  /// Just after an event.
  static Instant after(int event) { return {0, event, true}; }
};

/// One linear functional of the state of a body at an instant, in the terms of BodyState: the weights of position,
/// orientation (world rotation vector), velocity and angular velocity, and of the time of the event; besides, of the
/// centre of mass, and of numbers of the scene that a reading depends on by itself, not through the motion.
struct StateSeed {
  int body = -1;  ///< whose state is read
  Instant at;     ///< when
  Vec3 position = Vec3::Zero();          ///< weights of the position
  Vec3 orientation = Vec3::Zero();       ///< weights of the orientation, as a world rotation vector
  Vec3 velocity = Vec3::Zero();          ///< weights of the velocity
  Vec3 angular_velocity = Vec3::Zero();  ///< weights of the angular velocity
  Vec3 center_of_mass = Vec3::Zero();  ///< weights of the place of the centre of mass
  double time = 0;                       ///< weight of the time of the event
  double mass = 0;                       ///< weight of the body's mass
  Mat3 inertia = Mat3::Zero();           ///< weights of its inertia tensor about the centre of mass, axes of the shape
  Eigen::VectorXd size = {};             ///< weights of the dimensions of its shape; empty: none
  Vec3 gravity = Vec3::Zero();           ///< weights of the scene's gravity

  /// All weights times a number.
  StateSeed& operator*=(double factor);
};

/// How far a derivative can be trusted: the smallest margins of the events that it passed through.
struct Reliability {
  bool reliable = true;        ///< no margin is below kReliableMargin
  int events = 0;              ///< events that the quantity depends on
  double smallest_margin = 1;  ///< see Margins
  std::string message;         ///< a sentence when not reliable

  /// Materials by whose friction, which is 0, the derivative cannot be trusted; and why, by the first such event.
  std::vector<int> frictions;
  std::string friction_message;  ///< why; empty where there are none
  /// Bodies by whose velocity and spin at the start the derivative cannot be trusted: they begin to slip there from no slip
  /// at all, so that it is one-sided, along the slope.
  std::vector<int> beginning;
  std::string beginning_message;  ///< why; empty where there are none
  /// Fixed bodies by whose pose or size alone the derivative cannot be trusted: contacts are at a seam between them.
  std::vector<int> seams;
  std::string seam_message;  ///< why; empty where there are none

  /// Counts an event that the derivative passes through.
  void pass(const Motion& motion, int event);
  /// `margin`: how far the contacts are from not slipping, where they are without friction; `shared`: they share their
  /// load as the least friction chooses.
  void passFriction(const Motion& motion, int event, double margin, bool shared);
  /// Counts an arc of a body that the derivative passes through. Where corners, edges and faces hold the body, the margin is
  /// how near a contact comes to lifting, slipping, sticking or leaving its feature, and does not: as a share of the forces,
  /// speeds and lengths of the path.
  void passArc(const Motion& motion, int body, int arc);
  /// The derivative by the friction of a material is asked for, too.
  void askFriction(int material);
  /// The derivative by the velocity of a body is asked for, too.
  void askVelocity(int body);
  /// The derivative by its spin.
  void askSpin(int body) { askVelocity(body); }
  /// The derivative by the pose or the size of a body is asked for, too.
  void askPlace(int body);

 private:
  void passHeld(const Motion& motion, int body, const Arc& arc, double until);
  void passBeginning(const Motion& motion, int body, int arc);
  void passSeams(const Motion& motion, int event);
};

/// Linearisations of arcs and events of one motion, made on first use and shared by all rows of a Jacobian.
/// Not for use from two threads at once. Keeps a reference to the motion.
class DerivativeTape {
 public:
  /// The motion must outlive the tape. Throws InputError for one without recorded events.
  explicit DerivativeTape(const Motion& motion);
  ~DerivativeTape();

  const Motion& motion() const { return motion_; }  ///< which it is of
  /// Sensitivity over the whole of arc k of a body, which ends in an event.
  const ArcSensitivity& arc(int body, int k);
  /// Sensitivity from the start of arc k to time t; remembered, because the rows of a Jacobian share their times.
  ArcSensitivity arcUntil(int body, int k, double t);
  /// Linearisation of an event.
  const adjoint_detail::EventLinearization& event(int event);
  /// The same of an impact of one contact in fixed sizes, for reverse passes; null for any other event.
  const adjoint_detail::SingleImpact* singleImpact(int event);

 private:
  const Motion& motion_;
  std::vector<std::vector<std::unique_ptr<ArcSensitivity>>> arcs_;
  std::map<std::tuple<int, int, double>, ArcSensitivity> until_;  // by body, arc and time
  std::vector<std::unique_ptr<adjoint_detail::EventLinearization>> events_;
  std::vector<std::unique_ptr<adjoint_detail::SingleImpact>> single_impacts_;
  std::vector<int> materials_;  // of the bodies; -1 for none
};

}  // namespace carom
