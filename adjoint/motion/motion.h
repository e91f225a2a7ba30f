// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/contact_source.h"
#include "adjoint/motion/plan.h"

namespace carom {

/// State of a body as in documents, world axes.
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
/// A frictionless contact is one that slides with a coefficient of 0: a motion varies smoothly from one to the other.
inline ImpactMode branchOf(ImpactMode mode) { return mode == ImpactMode::frictionless ? ImpactMode::slide : mode; }

/// Kind of an event: an impact; an impact after which contacts persist (capture); a change of contact mode without an
/// impulse (transition); or the start of a motion that begins in contact (placed).
enum class EventKind : std::uint8_t { impact, capture, transition, placed };
/// "impact", "capture", "transition" or "placed".
const char* nameOf(EventKind kind);

/// One contact of an event, between bodies a and b at given features.
struct Contact {
  int a = -1;            ///< body
  int b = -1;            ///< body that it meets
  FeaturePair features;  ///< where they meet
  ContactPoint at;  ///< gap, normal (b to a) and point at the impact
  Vec3 impulse_normal =
      Vec3::UnitZ();             ///< the normal used by the impulse: `at.normal`, with the tilts of the scene
  int tilt_a = -1;               ///< entry of Scene::tilts in force for a's impact, -1 if none
  int tilt_b = -1;               ///< the same for b's
  PairCoefficients pair;         ///< coefficients in force
  double approach = 0;          ///< n . u just before, m/s, < 0; about 0 if persistent
  /// Part of u beside the motion of the bodies, m/s: the velocity of a's moving surface less that of b's, along the surface.
  Vec3 surface_velocity = Vec3::Zero();
  Vec3 impulse = Vec3::Zero();  ///< on a, N s
  bool counted = true;    ///< reported as an impact: it arrives from at least a millionth of the body's size
  bool held = false;      ///< persistent: the bodies were in contact there before the event
  bool lasts = false;     ///< persistent from the event on
  bool captured = false;  ///< restitution set to 0, because its bounce would be lower than Motion::lowest_bounce
  bool kept = false;      ///< n . u = 0 is kept as an equation, because the persistent contact would bounce that low
};

/// Distance of an event from points where derivatives do not exist (docs/equations.md section 7).
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
  int arc = -1;    ///< index in its world-line of the arc that it arrives on
  int impact = 0;  ///< number of this impact among the body's reported ones, 1 = first; 0 if it is not one
  State before;    ///< its state just before
  /// It stays at rest whatever the event does: other bodies and friction hold it, and its arc goes on.
  bool stays = false;

  /// Index of the arc that it leaves on: the next one, unless it stays.
  int next() const { return stays ? arc : arc + 1; }
};

/// An event: the contacts of one instant, solved simultaneously.
struct Event {
  double time = 0;                             ///< s
  EventKind kind = EventKind::impact;          ///< what happens
  TransitionCause cause = TransitionCause::none;  ///< of a transition
  ImpactMode mode = ImpactMode::frictionless;  ///< branch of the impact law that was taken
  /// Its impulses and all derivatives are computed with 32 digits, because doubles do not suffice.
  bool wide = false;
  int border = -1;  ///< if the first contact leaves its feature: the index in BodyGeometry::limits that it reaches
  std::vector<Contact> contacts;               ///< in increasing order of bodies
  std::vector<Participant> participants;  ///< in increasing order of body
  Margins margins;                        ///< see Margins
  /// Of a capture of one contact: the time at which the infinite cascade of bounces would have ended, s
  /// (docs/equations.md, 11.12).
  std::optional<double> settles_at;

  const Participant* find(int body) const;  ///< null if the body takes no part
  bool touches(int body, int with) const;  ///< has a contact between the two
  bool meets(int body, int with) const;    ///< has a reported impact between the two
  bool counts() const;                     ///< is a reported impact of some body
  bool tooLow() const;                     ///< is an impact that is too low to be reported
};

/// The path of one body: arcs, joined by events.
struct WorldLine {
  std::vector<Arc> arcs;    ///< in increasing order of time
  std::vector<int> events;  ///< events[k] ends arcs[k] and starts arcs[k + 1]; empty when they were not recorded
};

/// Why a motion ends.
enum class MotionStatus {
  complete,          ///< known up to the requested duration
  impact_limit,      ///< stopped after the allowed number of events
  cascade,           ///< impacts accumulate: infinitely many in finite time (Zeno)
  unresolved_impact,  ///< an impulse that does not separate the bodies (a tilt past the direction of approach), or a contact without a normal
  unresolved_contact,  ///< bodies stay in a contact that is not modelled: one would move under another, or no mode of all contacts is consistent
  not_computable,     ///< numerical failure, see NotComputable
  step_limit,         ///< the step limit was reached, see SimulateOptions::step_limit
  stopped             ///< a stop was requested
};
/// The word of a status in documents: "complete", "impact_limit", ...
const char* nameOf(MotionStatus status);

/// A simulated motion: world-lines of arcs, joined by events. The recorded trajectory doubles as the AD tape.
/// Immutable; safe to read from several threads.
struct Motion {
  std::shared_ptr<const Scene> scene;                    ///< the simulated scene
  std::shared_ptr<const std::vector<BodyModel>> models;  ///< mass properties in force, one per body
  std::shared_ptr<const ContactGeometry> geometry;       ///< gap functions of the features that met
  Plan plan;                                             ///< flight models of the bodies
  std::vector<WorldLine> world_lines;  ///< one per body
  std::vector<Event> events;           ///< in increasing order of time; empty when they were not recorded
  std::size_t impacts = 0;             ///< reported impacts (Event::counts), recorded or not
  std::size_t event_count = 0;         ///< all events, recorded or not
  std::size_t steps = 0;               ///< work done, see SimulateOptions::step_limit
  std::size_t taken_over = 0;          ///< bodies whose paths are reused from SimulateOptions::baseline
  bool has_events = true;              ///< false: paths alone, which cannot be differentiated
  std::vector<StartOverlap> overlaps;  ///< pairs that overlap at the start and did not collide until they had separated
  double lowest_bounce = 0;            ///< m, in force, see SimulateOptions; 0: no persistent contact
  double duration = 0;                 ///< s, as requested
  double end = 0;                      ///< s, known up to here; = duration if complete
  MotionStatus status = MotionStatus::complete;  ///< why it ends where it does
  std::string message;  ///< one sentence

  /// The mass properties of a body, kept for as long as they are held.
  std::shared_ptr<const BodyModel> modelOf(int body) const;

  /// State of a body at 0 <= t <= end; at the time of an impact, the state after it. Throws InputError outside.
  BodyState stateAt(const std::string& body, double t) const;
  /// The same by the index of the body.
  BodyState stateAt(int body, double t) const;
  /// Neither a bool nor a character is a time.
  template <class Body, NoTime T>
  BodyState stateAt(const Body& body, T t) const = delete;
  /// State just before event `event`; of a body that takes no part in it, at its time. Throws InputError for an
  /// invalid event or body, as do all that follow.
  BodyState stateBefore(int event, int body) const;
  /// State just after it.
  BodyState stateAfter(int event, int body) const;

  /// The event that is the n-th reported impact of a body (1 = first), counting only those with the body `with`
  /// unless that is -1; none if there are fewer.
  std::optional<int> findImpact(int body, int n, int with = -1) const;

  /// Index of the arc that holds time t; the first one before the start, the last one after the end.
  int arcAt(int body, double t) const;
  /// Neither a bool nor a character is a time.
  template <NoTime T>
  int arcAt(int body, T t) const = delete;

  /// The impact sequence as text: bodies, features and modes of the first `count` events. Derivatives relate only
  /// motions with equal signatures.
  std::string signature(std::size_t count = static_cast<std::size_t>(-1)) const;
  /// One event as readable text.
  std::string describeEvent(int event) const;
  /// The first `count` events as text, without impacts too low to be reported.
  std::vector<std::string> describeEvents(std::size_t count = static_cast<std::size_t>(-1)) const;
};

/// A state of the integrator as in documents.
BodyState toBodyState(const BodyModel& model, const State& state);

}  // namespace carom
