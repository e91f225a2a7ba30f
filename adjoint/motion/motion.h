// SPDX-License-Identifier: MIT
#pragma once

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
  Vec3 angular_velocity = Vec3::Zero();
};

enum class ImpactMode { frictionless, stick, slide, joint };
const char* nameOf(ImpactMode mode);

/// One contact of an impact, between bodies a and b at frozen features.
struct Contact {
  int a = -1, b = -1;
  FeaturePair features;
  ContactPoint at;  ///< gap, normal (b to a) and point at the impact
  Vec3 impulse_normal =
      Vec3::UnitZ();             ///< the normal that the impulse used: `at.normal`, tilted where the scene says so
  int tilt_a = -1, tilt_b = -1;  ///< entries of Scene::tilts in force, -1 if none
  PairCoefficients pair;
  double approach = 0;          ///< n . u just before, m/s, < 0
  Vec3 impulse = Vec3::Zero();  ///< on a, N s
};

/// How near an event is to a place where derivatives stop (docs/equations.md section 7).
struct Margins {
  double grazing = 1;     ///< |n.u| / |u| before the impact: 0 is grazing
  double stick_slip = 1;  ///< | mu P_n - |P_t| | / ((1 + mu) P_n) of the untruncated impulse; 1 without friction
  double smallest() const { return grazing < stick_slip ? grazing : stick_slip; }
};
/// Below this margin a gradient through the event is reported as unreliable.
inline constexpr double kReliableMargin = 1e-6;

/// A moving body in an event.
struct Participant {
  int body = -1;
  int arc = -1;    ///< of its world-line, the one that ends here; the next one starts here
  int impact = 0;  ///< this is the body's n-th impact, 1 = first
  State before;
};

/// An impact: the contacts of one instant, solved together.
struct Event {
  double time = 0;
  ImpactMode mode = ImpactMode::frictionless;
  std::vector<Contact> contacts;
  std::vector<Participant> participants;  ///< in increasing order of body
  Margins margins;
  /// Doubles are too short for its impulses: they and all derivatives are worked out with 32 digits.
  bool wide = false;

  const Participant* find(int body) const;
  bool touches(int body, int with) const;  ///< has a contact between the two
};

struct WorldLine {
  std::vector<Arc> arcs;
  std::vector<int> events;  ///< events[k] ends arcs[k] and starts arcs[k + 1]; empty when they were not recorded
};

enum class MotionStatus {
  complete,          ///< known up to the asked duration
  impact_limit,      ///< stopped after the allowed number of impacts
  cascade,           ///< impacts accumulate: infinitely many in finite time, or bodies stay in contact
  unresolved_impact,  ///< an impulse that does not separate the bodies (a tilt beyond the direction of approach), or a
                      ///< contact without a normal
  not_computable,     ///< numbers beyond the range of doubles, or more steps than can be made: see NotComputable
  step_limit,         ///< the allowed number of steps of work was done
  stopped             ///< it was asked to stop
};
const char* nameOf(MotionStatus status);

/// A motion is its own tape: world-lines of arcs, joined by events. Immutable; safe to read from several threads.
struct Motion {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const std::vector<BodyModel>> models;
  std::shared_ptr<const ContactGeometry> geometry;
  Plan plan;
  std::vector<WorldLine> world_lines;  ///< one a body
  std::vector<Event> events;           ///< in increasing order of time; empty when they were not recorded
  std::size_t impacts = 0;             ///< number of events, recorded or not
  std::size_t steps = 0;               ///< of work that it took, see SimulateOptions::step_limit
  bool has_events = true;              ///< false: paths alone, which cannot be differentiated
  std::vector<StartOverlap> overlaps;  ///< pairs that did not collide until they had parted
  double duration = 0;                 ///< asked for
  double end = 0;                      ///< known up to here; = duration when complete
  MotionStatus status = MotionStatus::complete;
  std::string message;  ///< one sentence

  /// State of a body at 0 <= t <= end; at the time of an impact, the state after it. Throws InputError outside.
  BodyState stateAt(const std::string& body, double t) const;
  BodyState stateAt(int body, double t) const;
  /// State just before event `event`; of a body that takes no part in it, at its time. Throws InputError for an event
  /// or a body that is not there, as do all that follow.
  BodyState stateBefore(int event, int body) const;

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
};

BodyState toBodyState(const BodyModel& model, const State& state);

}  // namespace carom
