// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <memory>

#include "adjoint/flight/arc.h"

namespace carom {
struct Event;
struct Motion;
}

namespace carom::adjoint_detail {

struct ContactPath;
class ConstrainedPath;
class GroupPath;
class RidePath;
struct PathGuard;
struct PathStart;
class SharedLinearization;
class TrajectoryLinearization;

/// Bounds over a stretch of a trajectory.
struct TrajectoryBounds {
  Vec3 acceleration = Vec3::Zero();  ///< m/s^2, of the centre of mass at the start of the stretch
  double variation = 0;              ///< how far it may differ from that, m/s^2
  bool straight = true;              ///< it is constant
  double spin = 0, spin_rate = 0;    ///< |w| rad/s, |w'| rad/s^2
};

/// What ends a trajectory by itself.
struct TrajectoryEnd {
  double time = std::numeric_limits<double>::infinity();  ///< s; infinite: nothing that is known so far
  TransitionCause cause = TransitionCause::none;
  int contact = -1;  ///< of its contacts, that which slips, sticks, lifts or leaves
  int limit = -1;    ///< of BodyGeometry::limits, that the contact reaches
};

/// How a body moves on an arc: in flight, at rest, sliding, rolling, constrained by contacts, or as somebody else gives
/// it. Arcs share it: what one of them extends is known to all. Where several bodies move together, each arc has a slot of
/// one trajectory (Arc::slot). Flights and closed forms depend on the start of the arc alone, which is why every function
/// gets the arc. Times are those of the motion, s.
class Trajectory {
 public:
  virtual ~Trajectory() = default;

  virtual ArcKind kind() const = 0;
  /// The same of one of several bodies.
  virtual ArcKind kindOf(const Arc&) const { return kind(); }
  virtual State stateAt(const Arc& arc, double t) const = 0;
  virtual Vec3 positionAt(const Arc& arc, double t) const = 0;
  virtual Vec3 velocityAt(const Arc& arc, double t) const = 0;
  /// d(state)/dt of what passes through `state` at t; where two pieces meet at t, of that before.
  virtual StateDerivative rateAt(const Arc& arc, double t, const State& state) const = 0;
  /// Over all that is known.
  virtual TrajectoryBounds bounds(const Arc& arc) const = 0;

  /// Makes [start, t] available, or one step more than is known. Throws NotComputable where it cannot go on.
  virtual void extendTo(const Arc&, double) {}
  /// The functions above can be called up to here.
  virtual double availableUntil(const Arc&) const { return std::numeric_limits<double>::infinity(); }
  /// Of what is integrated: it is known up to here, or ends here. Later times are not on it.
  virtual double knownUntil() const { return std::numeric_limits<double>::infinity(); }
  /// Whether it is integrated as far as it is read, so that bounds hold up to knownUntil() alone.
  virtual bool isIntegrated() const { return false; }
  /// Pieces computed so far: the work of extendTo.
  virtual std::size_t series() const { return 0; }
  /// Why it goes on otherwise, once that is known.
  virtual TrajectoryEnd end() const { return {}; }
  /// Whether the body keeps to it whatever strikes it.
  virtual bool isGiven() const { return false; }
  /// One that is extended apart from this; null where nothing is extended.
  virtual std::shared_ptr<Trajectory> fork() const { return nullptr; }

  /// From the start of arc k of a body to time t, linearised; null: a flight, whose rotation alone has a sensitivity
  /// (Arc::rotationSensitivity). Keeps a reference to the motion.
  virtual std::shared_ptr<const TrajectoryLinearization> linearise(const Motion& motion, int body, int k, double t) const = 0;
  /// The same of all bodies that share it; null: it has one, or is none of a group.
  virtual std::shared_ptr<const SharedLinearization> lineariseShared(const Motion&, double t) const {
    (void)t;
    return nullptr;
  }
  /// Of a flight, see Arc::rotationSensitivity.
  virtual RotationSensitivity rotationSensitivity(const Arc&, double, Tier, bool) const { return {}; }
  /// The row of the guard by which it ends at an event; null where it is that of the contacts (EventGuard).
  virtual std::shared_ptr<const PathGuard> guardOfEnd(const Motion&, const Event&) const { return nullptr; }
  /// What it does to the state with which participant i of an event starts on it; null where it takes that as it is.
  virtual std::shared_ptr<const PathStart> mapOfStart(const Motion&, int participant) const {
    (void)participant;
    return nullptr;
  }

  /// Its numbers where it has a closed form in contact with one face, which second derivatives and regions read.
  virtual const ContactPath* closedForm() const { return nullptr; }
  /// Its contacts and their modes where they constrain it, which a replay keeps to.
  virtual const ConstrainedPath* constrained() const { return nullptr; }
  /// What carries it where it rests on that with others.
  virtual const RidePath* ride() const { return nullptr; }
  /// Where it is one of several bodies that move on each other.
  virtual const GroupPath* group() const { return nullptr; }
  /// Of rest: contacts do not hold the body against every motion.
  virtual bool isLoose() const { return false; }
};

/// Free flight with the rotation of a tier, from a state on (flights.cpp). But for triaxial bodies, whose series it keeps, it
/// is one object for all arcs: what they are is in the arc.
std::shared_ptr<Trajectory> flightOf(const BodyModel& model, Tier tier, const State& start);

}  // namespace carom::adjoint_detail
