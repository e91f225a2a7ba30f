// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/group/group_modes.hpp"
#include "adjoint/simulate/contact_state.hpp"
#include "adjoint/simulate/event_queue.hpp"
#include "adjoint/simulate/reused_bodies.hpp"
#include "adjoint/simulate/motion_builder.hpp"
#include "adjoint/simulate/pair_scales.hpp"
#include "adjoint/simulate/path_transition.hpp"
#include "adjoint/simulate/simulate.h"
#include "adjoint/simulate/simulation_limits.hpp"
#include "adjoint/simulate/supported_component.hpp"

namespace carom::adjoint_detail {

/// Attempts to take over from SimulateOptions::baseline what was met by something else.
struct Attempts {
  std::vector<int> met;   ///< bodies
  std::size_t steps = 0;  ///< of work
};

/// The place of a body in a list in increasing order; -1: it is not there.
inline int placeIn(const std::vector<int>& bodies, int body) {
  const auto at = std::ranges::lower_bound(bodies, body);
  return at != bodies.end() && *at == body ? static_cast<int>(at - bodies.begin()) : -1;
}

/// Whether two contacts are between the same features of the same bodies.
inline bool isSameContact(const Contact& c, const Contact& d) { return c.a == d.a && c.b == d.b && c.features == d.features; }

/// The event loop behind `simulate`. Every body has one entry in the queue: its first impact, as far as it has been
/// searched for, or the horizon of that search. An impact touches the entries of its own bodies only; an entry whose
/// partner has been struck in the meantime is found out when its time comes, and the search goes on from there.
class Simulator {
 public:
  Simulator(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options,
            const Attempts& before);
  ~Simulator() { contacts_.countIn(nullptr); }
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;
  Motion run();
  /// A body whose path was to be taken over, but that another one came to meet: the motion ends there, and has to be
  /// worked out without what is known of that body.
  std::optional<int> reuseInvalidatedBy() const { return reuse_invalidated_by_; }

 private:
  // The first impact of a pair, found in a search of body `searched`.
  struct PredictedEvent {
    double time = 0;
    int searched = -1, a = -1, b = -1;
    int partner_version = 0;  // of the arc of the other body that it was made for
    FeaturePair features;
    int partner() const { return searched == a ? b : a; }
    bool explained() const { return features.kind >= 0; }
    bool isTaken() const { return a < 0; }                 // the next event of known bodies
    bool isTransition() const { return a >= 0 && b < 0; }  // of the path of body a
    bool operator<(const PredictedEvent& o) const {
      if (time != o.time) return time < o.time;
      return a != o.a ? a < o.a : b < o.b;
    }
  };
  // What is known of a body's future on its present arc.
  struct NextImpact {
    PredictedEvent first;                    // first.a = -1: none up to the horizon
    double horizon = 0;                  // without an impact: searched up to here
    std::vector<PredictedEvent> of_instant;  // further ones within an instant of the first
  };
  static const BodyContactState kInFlight;
  // An event that is worked out but not yet part of the motion. Its storage is used again and again.
  struct Draft {
    Event event;
    std::vector<State> after;       // of the participants
    std::vector<Arc> arcs;          // of the participants, from the event on
    std::vector<PredictedEvent> found;  // of the participants' pairs, on those arcs
    std::vector<NextImpact> next_impacts;  // of the participants
    std::vector<BodyContactState> contact_state;     // of the participants; empty where all of them fly
    std::vector<std::optional<RestingMember>> resting;  // of the participants, if they rest with others
    std::vector<std::optional<GroupMembership>> grouped;  // of the participants, if they move with others
    std::optional<GroupBeyond> group_beyond;              // of a transition
    std::vector<int> unheld;        // supports that the loads after the event move
    std::vector<Contact> pressing;  // between bodies that do not
    std::vector<int> closing;       // whose contacts would close, went each by itself
    std::vector<Contact> touching;  // of what is placed: all contacts, whether they press or not
    std::vector<int> woken;         // bodies that rested on others, or under them, and do not stay
    std::string beyond;             // why the motion ends: persistent contact that is not modelled
    std::optional<std::pair<State, double>> past_end;  // of a transition: the body a little later in the modes that end
  };
  // A body just before the event that is being worked out.
  struct Snapshot {
    int body = -1;
    State state;
    Kinematics k;
  };

  void runToEnd();
  bool follow();
  bool takeNext(PredictedEvent& next);
  bool holds(const PredictedEvent& p) const { return version_[index(p.partner())] == p.partner_version; }

  // simulator_start.cpp: where it begins
  bool start();
  void startReused();
  bool placeAtStart();
  void beginDraft(double time);
  bool placeBodies(const std::vector<int>& bodies, std::vector<Contact> contacts, std::vector<Contact> touching = {});
  void solvePlaced(const std::vector<int>& bodies);

  // simulate.cpp: the event
  void resolve(const PredictedEvent& first);
  void contactsOfInstant(const PredictedEvent& first);
  void addTouching(double time, int a, int b, const FeaturePair& features);
  Contact makeContact(double time, int a, int b, const FeaturePair& features);
  std::size_t snapshot(int body, double time);
  void solveDraft();
  void takePart();
  bool joinInstant();
  bool inDraft(int a, int b, const FeaturePair& features) const;
  bool meetsThere(const PredictedEvent& p, double time);
  Pose poseAt(int body, double time);  ///< on its path, that of the draft where it is in it
  void commit();
  int tiltOf(int body, int impact) const;

  // simulator_capture.cpp: bounces that are too low
  void setSpeedsOfContact();
  PairScale scaleOf(int a, int b, double time) { return scales_.of(a, b, pathOf(a), pathOf(b), time); }
  void solveLaw();
  State stateAfter(int body) const;
  double accelerationOf(const Contact& contact) const;
  bool leavesFast() const;
  bool captureLow(const std::vector<std::size_t>& loose, std::vector<std::size_t>& kept);
  bool pullsTooMuch(const std::vector<State>& before) const;
  bool isCounted(const Contact& contact, const State& a, const State& b) const;

  // simulator_flat.cpp: rims that lie flat
  void resolveFlat(const BodyContactState& from, int body);
  struct Lowest {
    Contact at;
    double tilts;  // m/s: how fast its rim goes down there against the other side
  };
  std::optional<Lowest> lowestOf(const Contact& of, int body, const State& state, const State& moves) const;
  std::vector<Contact> tiltFrom(std::vector<Contact>& closed, int body, State& after) const;
  std::optional<Lowest> lowestOf(const std::vector<Contact>& marks, int body, const State& state, const State& moves) const;
  std::optional<Lowest> tipsOver(const std::vector<Contact>& marks, int body, const State& flat, const Vec3& alpha, State& tilted) const;
  std::optional<ContactChoice> beginTilt(std::vector<Contact>& closed, int body, State& after, const ContactChoice& flat) const;
  bool settlesFlat();
  bool liesFlat(const PredictedEvent& p, double time);
  void dropFlatRims(std::vector<Contact>& closed) const;
  std::vector<Contact> marksOf(const Contact& of) const;
  bool isRim(const Contact& c) const;
  bool isOnRim(const Contact& c, const Contact& of) const;

  // simulator_component.cpp: bodies that lie on each other
  bool isSupport(int body) const;
  std::vector<int> supportsAround(int body) const;
  std::vector<Contact> heldOf(const std::vector<int>& supports) const;
  ContactPoint contactNow(const Contact& contact) const;
  bool wakesStruck();
  bool wakesUnheld();
  void keep(std::size_t participant);
  SupportedComponent componentOf(const std::vector<int>& bodies, const std::vector<Contact>& closed) const;
  std::vector<Contact> lasting(const std::vector<int>& bodies) const;
  std::vector<Contact> within(const std::vector<int>& part, const std::vector<Contact>& all) const;
  std::vector<int> movedBodies(bool with_supports) const;
  std::vector<std::vector<int>> pressedParts(const std::vector<int>& bodies, const std::vector<Contact>& closed) const;
  bool standsStill(const SupportedComponent& component, bool opposed, double no_slip) const;
  std::optional<RestingComponent> restOf(const std::vector<int>& bodies, const std::vector<Contact>& closed, double no_slip,
                                         bool on_all = false) const;
  void chooseComponents();
  void chooseRest(const std::vector<int>& touching, const std::vector<Contact>& closed);
  void holdAtRest(RestingComponent& rest);
  void rest(std::size_t participant);
  void goOn(std::size_t participant, Arc arc, std::vector<Contact> held);
  std::optional<Ride> rideOf(const SupportedComponent& component, const std::vector<const Contact*>& on) const;
  enum class RideEnd { goes_on, otherwise, ends };
  RideEnd resolveRide(int body);
  void leaveCarrier(const Ride& ride, const std::vector<int>& part, const std::vector<Contact>& held);
  bool goTogether(int a, int b);
  std::optional<FreeAcceleration> componentAcceleration(int body) const;
  std::vector<std::pair<std::vector<int>, std::vector<Contact>>> placedParts(const std::vector<PlacedContact>& placed);

  // simulator_group.cpp: bodies that move on each other
  std::vector<State> statesAfter(const std::vector<int>& bodies) const;
  void joinGroups(const std::vector<int>& touching, const std::vector<Contact>& closed);
  void beginGroup(const std::vector<int>& members, const std::vector<Contact>& closed, const GroupModes& modes);
  void followGroup(std::size_t participant);
  void refreshGroup(int body);
  void resolveGroupTransition(int body);

  // simulator_transition.cpp: paths in contact that come to their end
  void resolveTransition(int body);
  void resolveLanding(const std::vector<Contact>& on);
  Contact& addHeld(const auto& h, bool lasts);
  void addBeside(const BodyContactState& from, bool of_group = false);
  void goOnOtherwise(const std::vector<int>& bodies);

  // simulator_contact.cpp: persistent contact
  bool contactsLast() const { return motion_.lowest_bounce > 0; }
  std::vector<Contact> contactsBeyond(const BodyContactState& from, int body, double time);
  std::vector<Contact> contactsAside(const Contact& leaving, int limit);
  bool hasLeft(const Contact& c, double time, double room);
  std::vector<Contact> contactsAt(const BodyContactState& from, double time, double when, double reach);
  std::vector<Contact> closedContacts(int body, bool& ends);
  bool strikes(const Contact& contact);
  double strikingSpeed(const Contact& contact);
  std::vector<std::pair<int, int>> persistentPairs(const BodyContactState& from);

  // simulator_ground.cpp: what stands still is one ground
  bool onSameFace(const BodyContactState& from, const Contact& contact) const;
  void addCarriers();
  void dropDoubles(std::size_t first = 0, bool keep_earlier = false);
  bool isDouble(const Contact& c, const Contact& d) const;
  BorderMotion borderMotion(const Contact& contact, const FeatureLimit& limit);
  bool isLeaving(const Contact& contact, bool of_moving = false);
  double sizeAt(const Contact& contact) const;
  void addConstrained();
  void chooseArcs();
  void goOnInParts();
  void fly(std::size_t participant);
  void chooseArc(std::size_t participant);
  ModeHint hintOf(const std::vector<Contact>& closed) const;
  bool changesTooOften(int body, std::size_t most = 8) const;
  bool presses(const Contact& contact) const;
  void endBeyond(const Contact& contact, const std::string& why);
  const BodyContactState& contactStateOf(int body) const;
  std::optional<PredictedImpact> besideConstrained(int a, int b, double from, double until);

  // simulator_pressing.cpp: what ends a motion though no contact is new
  std::vector<Contact*> closingContacts();
  bool wouldMoveOnEdges(ContactChoice& choice);
  bool lieAlongEdges(const std::vector<const Contact*>& contacts, const std::vector<Contact>& others);

  // simulator_search.cpp: predictions
  void predictDraft();
  void predictBody(int body, double from);
  void search(int body, double from, NextImpact& next_impact);
  std::optional<PredictedImpact> firstImpact(int a, int b, double from, double until);
  void enter(int body, NextImpact& next_impact);
  void setPath(int body, const Arc& arc, double from);
  void followConstrained(int body, double from);
  Arc& pathOf(int body) {
    const int i = in_draft_[index(body)];
    return i < 0 ? arcOf(body) : draft_.arcs[index(i)];
  }

  // simulator_reuse.cpp: paths that are taken over
  Arc takenArcOf(int body);
  void takeOver();
  bool invalidatesReuse(int body);

  // simulator_overlaps.cpp: pairs that overlap from the start
  void startOverlaps();
  StartOverlap* overlapOf(int a, int b);
  void followOverlap(StartOverlap& overlap, double until);
  std::optional<double> partingOf(StartOverlap& overlap, double from, double until);
  void endOverlaps(double end);

  // simulator_endings.cpp: outcomes that end a motion early
  std::string namesOf(int a, int b) const;  // "'a' and 'b'"
  std::string impactsWithDraft() const;
  std::string eventsSoFar() const;
  bool isExplained(const PredictedEvent& next);
  bool separates();
  bool accumulates();
  bool isLow(const Contact& c, const PredictedEvent*& next);
  bool stalls(int body, double stall) const;
  void requireFlight(int body, const Arc& arc) const;
  [[noreturn]] void giveUp(const char* what, int a, int b, double time, const NotComputable& why) const;
  void endWork(bool stopped);
  void extendAll();
  void extend(Arc& arc, double until);
  void endWith(const Arc& arc);
  void forgetAfter(double end);
  void finish(MotionStatus status, double end, std::string message);

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  // Of a body that takes part in the draft.
  std::size_t participantIn(int body) const { return static_cast<std::size_t>(std::ranges::find(bodies_, body) - bodies_.begin()); }
  Arc& arcOf(int body) { return *arc_[index(body)]; }
  /// Steps of work that went into what is known of an arc.
  static std::size_t workIn(const Arc& arc) {
    if (const GroupPath* group = arc.trajectory().group()) return arc.series() * group->workOfStep();
    return arc.series() * (arc.isIntegrated() ? kConstrainedStep : 1);
  }
  // Whether impacts move a body. They neither join through one that they do not move nor change its path.
  bool isFixed(int body) const { return arc_[index(body)]->stays(); }
  bool joinsMoved(const Contact& c) const { return isMoved(c.a) && isMoved(c.b); }
  bool isMoved(int body) const {
    const BodyModel& model = (*motion_.models)[index(body)];
    return model.moving && !model.kinematic;
  }

  const Scene& scene_;
  ContactSource& contacts_;
  std::size_t impact_limit_, steps_before_;
  std::function<bool(const Motion&)> stop_when_;  // empty once it has said yes
  double least_duration_, last_asked_for_ = EventQueue::kNever;  // nothing after it is asked for
  bool groups_, refuse_overlaps_;
  std::map<const Trajectory*, std::shared_ptr<Trajectory>> taken_groups_;  // of what was taken over
  WorkCount work_;
  bool work_ended_ = false, any_lasted_ = false;  // a body has been in lasting contact
  double now_ = 0;     // everything before it is known
  long searches_ = 0;  // since the last impact
  MotionBuilder builder_;
  Motion& motion_;
  PairScales scales_;
  // a body each
  std::vector<Arc*> arc_;  // the last one of its world-line
  std::vector<int> version_, impacts_, in_draft_;
  std::vector<char> simple_;  // a ball or a plane: two of these touch in one place
  std::vector<NextImpact> next_impacts_;
  std::vector<BodyContactState> contact_states_;
  double lowest_speed_ = 0, counted_speed_ = 0;  // see setSpeedsOfContact
  EventQueue queue_;
  ReusedBodies reused_;
  std::optional<int> reuse_invalidated_by_;

  std::vector<double> overlaps_until_;  // of motion_.overlaps: known to overlap up to here
  std::map<std::pair<int, int>, int> tilts_;            // by body and impact
  std::unordered_map<std::uint64_t, int> low_bounces_;  // in a row, of a pair
  Draft draft_;
  std::vector<Snapshot> snapshots_;
  std::vector<PredictedEvent> same_, found_;
  std::vector<int> bodies_, neighbours_;
};

}  // namespace carom::adjoint_detail
