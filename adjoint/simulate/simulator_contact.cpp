// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/simulate/path_arc.hpp"
#include "adjoint/simulate/simulator.hpp"

// Persistent contact: onset, path, and end (docs/equations.md section 11).

namespace carom::adjoint_detail {
namespace {

// What a contact has left is looked for where it has gone by this share of the size of positions further: beyond what
// counts as the border itself.
constexpr double kBeyond = 2e-7;
// What comes out of its features by more than this share of that way has left.
constexpr double kLeft = 1e-2;
// What touches: to so many times the lowest bounce.
constexpr double kTouching = 10;
// The sine of the angle to a border by which what leaves it leaves clearly.
constexpr double kAlong = 1e-2;
// No contact approaches with a smaller share of its speed.
constexpr double kSlowest = 1e-10;
// An impulse makes contacts slip no faster than so many times as fast as it stops bodies.
constexpr double kOwnSlip = 4;
// So many changes of contact within this share of an instant never end; and after fewer what is left of slips in a group ends.
constexpr double kSameInstant = 1e-2;
constexpr std::size_t kRattlingChanges = 4;

}  // namespace

const BodyContactState Simulator::kInFlight = {};

const BodyContactState& Simulator::contactStateOf(int body) const {
  const int i = in_draft_[index(body)];
  if (i < 0) return contact_states_[index(body)];
  return draft_.contact_state.empty() ? kInFlight : draft_.contact_state[index(i)];
}

// The first impact of a pair besides the contacts that hold them to each other.
std::optional<PredictedImpact> Simulator::besideConstrained(int a, int b, double from, double until) {
  std::vector<FeaturePair> held;
  std::vector<PersistentFeatures> on_ground;
  const bool ground = isFixed(a) || isFixed(b);
  for (int body : {a, b})
    for (const Contact& c : contactStateOf(body).held) {
      if (c.a == a && c.b == b && std::ranges::find(held, c.features) == held.end()) held.push_back(c.features);  // both of a group have it
      if (ground) on_ground.push_back({c.a, c.b, c.features});
    }
  if (on_ground.size() > held.size())
    return contacts_.firstImpactOnGround(a, b, on_ground, pathOf(a), pathOf(b), from, until);
  if (held.empty()) return contacts_.firstImpact(a, b, pathOf(a), pathOf(b), from, until);
  return contacts_.firstImpactBeside(a, b, held, pathOf(a), pathOf(b), from, until);
}

// The contacts that the participants are held by take part in whatever happens to them.
void Simulator::addConstrained() {
  std::vector<Contact>& contacts = draft_.event.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (int body : {contacts[k].a, contacts[k].b}) {
      if (isSupport(body)) continue;
      for (const Contact& h : contact_states_[index(body)].held) {
        const auto known = std::ranges::find_if(contacts, [&](const Contact& c) { return isSameContact(c, h); });
        if (known != contacts.end()) {
          known->held = true;
          continue;
        }
        Contact c = makeContact(draft_.event.time, h.a, h.b, h.features);
        c.held = true;
        c.counted = false;
        contacts.push_back(c);
      }
    }
  const auto order = [](const Contact& c, const Contact& d) { return std::pair(c.a, c.b) < std::pair(d.a, d.b); };
  if (!std::ranges::is_sorted(contacts, order)) std::ranges::stable_sort(contacts, order);
}

// Whether a contact with a body that moves, which parts without speed, goes on pressing while what stands still holds them.
bool Simulator::presses(const Contact& c) const {
  if (!joinsMoved(c)) return accelerationOf(c) < 0;
  return std::ranges::any_of(draft_.pressing, [&](const Contact& d) { return isSameContact(c, d); });
}

// How every participant goes on.
void Simulator::chooseArcs() {
  Event& event = draft_.event;
  draft_.beyond.clear();
  draft_.arcs.clear();
  draft_.contact_state.clear();
  if (std::ranges::none_of(event.contacts, &Contact::lasts) && std::ranges::none_of(event.participants, &Participant::stays)) {  // far most often
    for (std::size_t i = 0; i < bodies_.size(); ++i) fly(i);
    return;
  }
  draft_.closing.clear();
  const std::vector<State> after = draft_.after;
  goOnInParts();
  std::vector<Contact*> closing = closingContacts();
  if (groups_ && !closing.empty()) {  // once more, these held to each other
    for (Contact* c : closing) c->lasts = true, draft_.closing.push_back(c->a), draft_.closing.push_back(c->b);
    draft_.after = after;
    draft_.arcs.clear();
    draft_.contact_state.clear();
    goOnInParts();
    closing = closingContacts();
  }
  if (!closing.empty()) endBeyond(*closing.front(), groups_ ? "forces press them together, and no modes were found that hold them" : "one of them would move, and bodies that move on each other are switched off");
  for (Contact& c : event.contacts) {
    if (!c.lasts) continue;
    c.lasts = std::ranges::any_of(draft_.contact_state, [&](const BodyContactState& contact_state) {
      return std::ranges::any_of(contact_state.held, [&](const Contact& h) { return isSameContact(c, h); });
    });
    if (c.lasts && !c.held && event.kind == EventKind::impact) event.kind = EventKind::capture;
  }
}

// At rest on each other, as groups, and each of the others by itself.
void Simulator::goOnInParts() {
  draft_.contact_state.resize(bodies_.size());
  chooseComponents();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (draft_.event.participants[i].stays)
      keep(i);
    else if (draft_.resting[i])
      rest(i);
    else if (draft_.grouped[i])
      followGroup(i);
    else
      chooseArc(i);
  }
}

void Simulator::fly(std::size_t participant) {
  const int body = bodies_[participant];
  draft_.arcs.push_back(builder_.flight(body, draft_.event.time, draft_.after[participant]));
  requireFlight(body, draft_.arcs.back());
  in_draft_[index(body)] = static_cast<int>(participant);
}

// The motion ends with the event, as a contact lasts in a way that is not known.
void Simulator::endBeyond(const Contact& c, const std::string& why) {
  if (!draft_.beyond.empty()) return;
  const Event& event = draft_.event;
  draft_.beyond = textOf(10, namesOf(c.a, c.b), " stay in contact from t = ", event.settles_at.value_or(event.time),
                         " s on, at (", c.at.point.x(), ", ", c.at.point.y(), ", ", c.at.point.z(), "), after ",
                         impactsWithDraft(), "; ", why, ", so the motion ends there");
}

// The contact that a transition is about, among those that stay closed.
ModeHint Simulator::hintOf(const std::vector<Contact>& closed) const {
  const Event& event = draft_.event;
  ModeHint hint;
  if (event.kind != EventKind::transition) {
    // What is captured from below the lowest bounce leaves no slip but that of its own impulse.
    double fastest = 0;
    for (const Contact& c : event.contacts)
      if (!c.held && !c.kept) fastest = std::max(fastest, std::abs(c.approach));
    if (fastest * fastest < 2 * motion_.lowest_bounce * scene_.gravity.norm()) hint.no_slip = kOwnSlip * fastest;
    return hint;
  }
  hint.cause = event.cause;
  hint.beyond = draft_.past_end;
  // What changes over and over in one instant rattles below the lowest bounce: no slip is left that is not faster.
  const int body = isMoved(event.contacts[0].a) ? event.contacts[0].a : event.contacts[0].b;
  if (arc_[index(body)]->trajectory().group() && changesTooOften(body, kRattlingChanges)) hint.no_slip = kOwnSlip * std::sqrt(2 * motion_.lowest_bounce * scene_.gravity.norm());
  for (std::size_t k = 0; k < closed.size(); ++k) {
    if (!closed[k].held) hint.idle.push_back(k);
    if (closed[k].features == event.contacts[0].features && closed[k].a == event.contacts[0].a &&
        closed[k].b == event.contacts[0].b)
      hint.contact = static_cast<int>(k);
  }
  return hint;
}

bool Simulator::changesTooOften(int body, std::size_t most) const {
  if (draft_.event.kind != EventKind::transition) return false;
  const auto& arcs = motion_.world_lines[index(body)].arcs;
  if (arcs.size() <= most) return false;
  const double instant = scales_.instantOf(motion_, draft_.event);
  return arcs[arcs.size() - most].start() >= draft_.event.time - kSameInstant * instant;
}

// The contacts with what is fixed or kinematic that keep a body. `ends`: it presses on one that moves, so that the motion ends here.
std::vector<Contact> Simulator::closedContacts(int body, bool& ends) {
  std::vector<Contact> closed;
  if (!contactsLast() || !isMoved(body)) return closed;
  for (const Contact& c : draft_.event.contacts) {
    if (!c.lasts || (c.a != body && c.b != body)) continue;
    if (isMoved(c.a == body ? c.b : c.a)) {
      if (presses(c)) ends = true, endBeyond(c, groups_ ? "one of them would move by itself" : "one of them would move, and bodies that move on each other are switched off");
      continue;
    }
    closed.push_back(c);
    closed.back().pair = builder_.pairOf(c.a, c.b);
  }
  return closed;
}

void Simulator::chooseArc(std::size_t participant) {
  const Event& event = draft_.event;
  const int body = bodies_[participant];
  bool ends = false;
  std::vector<Contact> closed = closedContacts(body, ends);
  State& after = draft_.after[participant];
  ContactChoice choice;
  const bool driven = std::ranges::any_of(closed, [&](const Contact& c) { return drivesContacts(motion_, c.a == body ? c.b : c.a); });
  const std::vector<Contact> marks = driven ? std::vector<Contact>() : tiltFrom(closed, body, after);
  if (!marks.empty()) {
    choice = tiltingPathOf(motion_, body, after, pointersTo(marks), pointersTo(closed), event.time, hintOf(closed));
  } else if (!closed.empty()) {
    choice = chooseContactPath(motion_, body, after, pointersTo(closed), event.time, hintOf(closed));
    if (!driven && choice.path && choice.path->form == PathForm::held)
      if (std::optional<ContactChoice> tips = beginTilt(closed, body, after, choice)) choice = *std::move(tips);
  }
  if (choice.path && choice.path->form != PathForm::held && std::ranges::any_of(choice.contacts, [](const Contact* c) { return !c->held; })) {
    std::vector<Contact> last;  // what begins to last fixes the pose
    for (const Contact* c : choice.contacts) last.push_back(*c);
    closed = std::move(last);
    closeGaps(motion_, body, after, closed);
    choice = contactPathOf(motion_, body, after, pointersTo(closed), choice.path->form, event.time);
  }
  // where the motion ends here, the velocities are those of the law: an integrated path would stop what is left of slips
  if (ends && choice.path && choice.path->form == PathForm::held) return fly(participant);
  if (choice.path && wouldMoveOnEdges(choice)) return fly(participant);
  if (!choice.path) {
    fly(participant);
    if (!choice.beyond.empty()) endBeyond(*choice.contacts.front(), choice.beyond);
    return;
  }
  if (changesTooOften(body)) {
    fly(participant);
    endBeyond(*choice.contacts.front(), "their contact modes change more than 8 times in one instant");
    return;
  }
  if (choice.path->form == PathForm::held) work_.step(kConstrainedStep);
  BodyContactState& contact_state = draft_.contact_state[participant];
  PathArc made = [&]() -> PathArc {
    try {
      return makePathArc(motion_, choice, event.time);
    } catch (const NotComputable& error) {
      giveUp("contact", event.contacts[0].a, event.contacts[0].b, event.time, error);
    }
  }();
  contact_state.why = made.transition;
  if (contact_state.why.cause != TransitionCause::none)
    contact_state.transition = made.arc.isIntegrated() ? made.arc.knownUntil() : event.time + contact_state.why.elapsed;
  goOn(participant, std::move(made.arc), std::move(made.held));
}

// What touches a body where a contact of it leaves its feature: what it has a little later on the same path.
std::vector<Contact> Simulator::contactsBeyond(const BodyContactState& from, int body, double time) {
  const Kinematics now = arcOf(body).kinematicsAt(time);
  double size = scales_.radius(body), arm = kInfinity, speed = now.v.norm();
  for (const Contact& c : from.held) {
    size = std::max(size, c.at.point.norm());
    arm = std::min(arm, (c.at.point - arcOf(body).startState().x).norm());
    // the place of a contact goes round a rim or along an edge, faster than the body
    const Kinematics other = arcOf(c.a == body ? c.b : c.a).kinematicsAt(time);
    const Kinematics &a = c.a == body ? now : other, &b = c.a == body ? other : now;
    const ContactMotion moves =
        motion_.geometry->motion(c.a, c.b, c.features, {a.x, a.R}, {b.x, b.R}, {a.v, a.w}, {b.v, b.w});
    speed = std::max(speed, moves.point_rate.norm());
    if (isMoved(c.a) && isMoved(c.b)) speed = std::max(speed, other.v.norm());
  }
  const double further = kBeyond * size, later = speed > 0 ? time + further / speed : time;
  const double reach = kTouching * motion_.lowest_bounce + further * further / arm;
  std::vector<Contact> contacts = contactsAt(from, time, later, reach);
  std::erase_if(contacts, [&](const Contact& c) { return hasLeft(c, later, kLeft * further); });
  return contacts;
}

// What a pair has where a contact of it hardly leaves its feature, as it goes along a border: what it would have if that contact were
// a little outside. Nothing where it leaves clearly: there a little later tells.
std::vector<Contact> Simulator::contactsAside(const Contact& leaving, int limit) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get());
  const double time = draft_.event.time;
  const auto limits = bodies ? bodies->limits(leaving.a, leaving.b, leaving.features, poseAt(leaving.a, time), poseAt(leaving.b, time)) : std::vector<FeatureLimit>();
  if (limit < 0 || limit >= static_cast<int>(limits.size())) return {};
  const FeatureLimit& border = limits[index(limit)];
  const BorderMotion moves = borderMotion(leaving, border);
  if (border.radius > 0 || border.point_weight.isZero(0) || -moves.rate > kAlong * moves.speed) return {};
  const int moved = isMoved(leaving.a) ? leaving.a : leaving.b;
  const Vec3 in = (poseAt(border.body, time).R * border.point_weight).normalized();
  State state = snapshots_[snapshot(moved, time)].state;
  state.x += (border.body == moved ? kBeyond : -kBeyond) * sizeAt(leaving) * in;
  const Arc aside = builder_.flight(moved, time, state);
  const auto arc = [&](int body) -> const Arc& { return body == moved ? aside : arcOf(body); };
  std::vector<Contact> contacts;
  for (const FeaturePair& f : contacts_.touching(leaving.a, leaving.b, arc(leaving.a), arc(leaving.b), time, kTouching * motion_.lowest_bounce))
    contacts.push_back(makeContact(time, leaving.a, leaving.b, f));
  return contacts;
}

// Whether a contact has come out of its features by more than `room`, as a rim that ceases to cross an edge has.
bool Simulator::hasLeft(const Contact& c, double time, double room) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get());
  if (!bodies) return false;
  const Pose A = poseAt(c.a, time), B = poseAt(c.b, time);
  const Vec3 point = motion_.geometry->contact(c.a, c.b, c.features, A, B).point;
  return std::ranges::any_of(bodies->limits(c.a, c.b, c.features, A, B), [&](const FeatureLimit& limit) {
    const Pose& pose = limit.body == c.a ? A : B;
    return limit.radius == 0 && limit.point_weight.dot(pose.R.transpose() * (point - pose.x) - limit.border) < -room;
  });
}

// What of the pairs that are held, and of the faces that go on beside theirs, touches at `when`, to within `reach` or,
// where that is 0, to rounding, as it is at `time`.
std::vector<Contact> Simulator::contactsAt(const BodyContactState& from, double time, double when, double reach) {
  std::vector<Contact> contacts;
  for (const auto& [a, b] : persistentPairs(from))
    for (const FeaturePair& f : contacts_.touching(a, b, arcOf(a), arcOf(b), when, reach)) {
      Contact c = makeContact(time, a, b, f);
      if ((!(reach > 0) || std::abs(c.at.gap) <= reach) && onSameFace(from, c)) contacts.push_back(std::move(c));
    }
  return contacts;
}

// Whether what comes into touch strikes, so that it is an impact: it would bounce higher than the lowest bounce.
bool Simulator::strikes(const Contact& c) { return c.approach < -strikingSpeed(c); }

double Simulator::strikingSpeed(const Contact& c) {
  return std::max(kSlowest * arcOf(isMoved(c.a) ? c.a : c.b).velocityAt(draft_.event.time).norm(),
                  std::sqrt(2 * motion_.lowest_bounce * scene_.gravity.norm()));
}

}  // namespace carom::adjoint_detail
