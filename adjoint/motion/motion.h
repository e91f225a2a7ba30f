// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/motion/contact_source.h"
#include "adjoint/motion/plan.h"

namespace carom {

/// State of a body as people write it, world axes.
struct BodyState {
  Vec3 position = Vec3::Zero();         ///< of the shape's origin, m
  Quat orientation = Quat::Identity();  ///< shape to world
  Vec3 velocity = Vec3::Zero();         ///< of the centre of mass, m/s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s
};

/// Branch of the impact law: without friction, sticking, sliding, or several contacts together.
enum class ImpactMode : std::uint8_t { frictionless, stick, slide, joint };
/// "frictionless", "stick", "slide" or "joint".
const char* nameOf(ImpactMode mode);
/// A contact without friction is one that slides with a coefficient of 0: a motion varies smoothly from the one to the
/// other.
inline ImpactMode branchOf(ImpactMode mode) { return mode == ImpactMode::frictionless ? ImpactMode::slide : mode; }

/// What happens at an event. An impact; one after which contacts last that did not before; a change of how a body in
/// contact goes on, without an impulse; or the start of a motion that begins in contact.
enum class EventKind : std::uint8_t { impact, capture, transition, placed };
/// "impact", "capture", "transition" or "placed".
const char* nameOf(EventKind kind);

/// Why a body in lasting contact goes on otherwise: its slip comes to an end, a contact comes to the border of the feature
/// that it is at, or the force at a corner of a body that slides without turning comes to 0. Of a body on corners, edges
/// and faces that may turn: the force at a contact comes to 0, it begins to slip, or its slip ends.
enum class TransitionCause : std::uint8_t { none, slip_ends, leaves, tips, lifts, slips, sticks };
/// "none", "slip_ends", "leaves", "tips", "lifts", "slips" or "sticks".
const char* nameOf(TransitionCause cause);

/// One contact of an event, between bodies a and b at frozen features.
struct Contact {
  int a = -1;            ///< body
  int b = -1;            ///< body that it meets
  FeaturePair features;  ///< where they meet
  ContactPoint at;  ///< gap, normal (b to a) and point at the impact
  Vec3 impulse_normal =
      Vec3::UnitZ();             ///< the normal that the impulse used: `at.normal`, tilted where the scene says so
  int tilt_a = -1;               ///< entry of Scene::tilts in force for a's impact, -1 if none
  int tilt_b = -1;               ///< the same for b's
  PairCoefficients pair;         ///< coefficients in force
  double approach = 0;          ///< n . u just before, m/s, < 0; about 0 where it is held
  Vec3 impulse = Vec3::Zero();  ///< on a, N s
  bool counted = true;    ///< an impact to people: it does not arrive from less than a millionth of the body's size
  bool held = false;      ///< the bodies have been in contact there for some time
  bool lasts = false;     ///< they stay in contact there from the event on
  bool captured = false;  ///< its elasticity is taken for 0, as its bounce would be lower than Motion::lowest_bounce
  bool kept = false;      ///< n . u = 0 is kept as an equation, as a contact that is held would bounce that low
};

/// How near an event is to a place where derivatives stop (docs/equations.md section 7).
struct Margins {
  double grazing = 1;     ///< |n.u| / |u| before the impact: 0 is grazing
  double stick_slip = 1;  ///< | mu P_n - |P_t| | / ((1 + mu) P_n) of the untruncated impulse; 1 without friction
  /// The smaller of the two.
  double smallest() const { return grazing < stick_slip ? grazing : stick_slip; }
};
/// Below this margin a gradient through the event is reported as unreliable.
inline constexpr double kReliableMargin = 1e-6;

/// A moving body in an event.
struct Participant {
  int body = -1;   ///< index
  int arc = -1;    ///< of its world-line, the one that ends here; the next one starts here
  int impact = 0;  ///< this is the body's n-th impact, 1 = first; 0 where it is none, or too low to be one to people
  State before;    ///< its state just before
};

/// An impact: the contacts of one instant, solved together.
struct Event {
  double time = 0;                             ///< s
  EventKind kind = EventKind::impact;          ///< what happens
  TransitionCause cause = TransitionCause::none;  ///< of a transition
  ImpactMode mode = ImpactMode::frictionless;  ///< branch of the impact law that was taken
  /// Doubles are too short for its impulses: they and all derivatives are worked out with 32 digits.
  bool wide = false;
  int border = -1;  ///< the first contact leaves its feature: which of BodyGeometry::limits it comes to
  std::vector<Contact> contacts;               ///< in increasing order of bodies
  std::vector<Participant> participants;  ///< in increasing order of body
  Margins margins;                        ///< to where derivatives stop
  /// Of a capture of one contact: when endlessly many bounces would have come to an end there, s
  /// (docs/equations.md, 11.12).
  std::optional<double> settles_at;

  const Participant* find(int body) const;  ///< null where the body takes no part
  bool touches(int body, int with) const;  ///< has a contact between the two
  bool meets(int body, int with) const;    ///< has an impact between the two that counts
  bool counts() const;                     ///< is an impact to people, of some body
  bool tooLow() const;                     ///< is an impact, but none to people: of bounces that arrive from too low
};

/// The path of one body: arcs, joined by events.
struct WorldLine {
  std::vector<Arc> arcs;    ///< in increasing order of time
  std::vector<int> events;  ///< events[k] ends arcs[k] and starts arcs[k + 1]; empty when they were not recorded
};

/// Why a motion ends.
enum class MotionStatus {
  complete,          ///< known up to the asked duration
  impact_limit,      ///< stopped after the allowed number of events
  cascade,           ///< impacts accumulate: infinitely many in finite time
  unresolved_impact,  ///< an impulse that does not separate the bodies (a tilt beyond the direction of approach), or a
                      ///< contact without a normal
  unresolved_contact,  ///< bodies stay in contact in a way of which no path is known: on one that moves, or under forces
                       ///< that no mode of all its contacts allows
  not_computable,     ///< numbers beyond the range of doubles, or more steps than can be made: see NotComputable
  step_limit,         ///< the allowed number of steps of work was done
  stopped             ///< it was asked to stop
};
/// The word of a status in documents: "complete", "impact_limit", ...
const char* nameOf(MotionStatus status);

/// A motion is its own tape: world-lines of arcs, joined by events. Immutable; safe to read from several threads.
struct Motion {
  std::shared_ptr<const Scene> scene;                    ///< what it is the motion of
  std::shared_ptr<const std::vector<BodyModel>> models;  ///< mass properties in force, one a body
  std::shared_ptr<const ContactGeometry> geometry;       ///< gaps of the features that met
  Plan plan;                                             ///< how each body was computed
  std::vector<WorldLine> world_lines;  ///< one a body
  std::vector<Event> events;           ///< in increasing order of time; empty when they were not recorded
  std::size_t impacts = 0;             ///< events that are impacts to people (Event::counts), recorded or not
  std::size_t event_count = 0;         ///< all events, recorded or not
  std::size_t steps = 0;               ///< of work that it took, see SimulateOptions::step_limit
  std::size_t taken_over = 0;          ///< bodies whose paths are those of SimulateOptions::known
  bool has_events = true;              ///< false: paths alone, which cannot be differentiated
  std::vector<StartOverlap> overlaps;  ///< pairs that did not collide until they had parted
  double lowest_bounce = 0;            ///< m, in force, see SimulateOptions; 0: no contact lasts
  double duration = 0;                 ///< asked for
  double end = 0;                      ///< known up to here; = duration when complete
  MotionStatus status = MotionStatus::complete;  ///< why it ends where it does
  std::string message;  ///< one sentence

  /// State of a body at 0 <= t <= end; at the time of an impact, the state after it. Throws InputError outside.
  BodyState stateAt(const std::string& body, double t) const;
  /// The same by the index of the body.
  BodyState stateAt(int body, double t) const;
  /// State just before event `event`; of a body that takes no part in it, at its time. Throws InputError for an event
  /// or a body that is not there, as do all that follow.
  BodyState stateBefore(int event, int body) const;
  /// State just after it.
  BodyState stateAfter(int event, int body) const;

  /// The event that is the n-th impact of a body (1 = first), counting only those with the body `with` unless that is
  /// -1; none where it has fewer.
  std::optional<int> findImpact(int body, int n, int with = -1) const;

  /// Index of the arc that holds time t; the first one before the start, the last one after the end.
  int arcAt(int body, double t) const;

  /// The collision sequence as text: who, with which features, in which mode. Two motions can be compared and
  /// differentiated into one another only where it is equal. Of the first `count` events.
  std::string signature(std::size_t count = static_cast<std::size_t>(-1)) const;
  /// The same for people: one line an event.
  std::string describeEvent(int event) const;
  /// Of the first `count` events, but those that are too low.
  std::vector<std::string> describeEvents(std::size_t count = static_cast<std::size_t>(-1)) const;
};

/// A state of the integrator as people write it.
BodyState toBodyState(const BodyModel& model, const State& state);

}  // namespace carom
