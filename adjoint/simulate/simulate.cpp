// SPDX-License-Identifier: MIT
#include "adjoint/simulate/simulate.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "adjoint/base/arguments.hpp"
#include "adjoint/simulate/contact_acceleration.hpp"
#include "adjoint/simulate/simulator.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

// Eigen cuts products of large matrices into blocks by the caches that it finds, and so orders their sums. So they are
// these ones from when the program is loaded, before it has threads; what it sets itself later stays.
[[maybe_unused]] const bool matrix_blocks_fixed = [] {
  Eigen::setCpuCacheSizes(32 * 1024, 256 * 1024, 2 * 1024 * 1024);
  return true;
}();

}  // namespace

Motion simulate(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options) {
  checkDuration("simulate", duration);
  if (!options.asked.empty()) checkCount("simulate", "bodies asked for", options.asked.size(), scene.bodies.size());
  validate(scene);
  for (Attempts before;;) {
    Simulator simulator(scene, contacts, duration, options, before);
    Motion motion = simulator.run();
    if (!simulator.reuseInvalidatedBy()) return motion;
    before.met.push_back(*simulator.reuseInvalidatedBy());
    before.steps = motion.steps;
  }
}

Motion Simulator::run() {
  try {
    runToEnd();
  } catch (const WorkEnded& ended) {
    endWork(ended.stopped);
  }
  motion_.steps = work_.steps();
  return std::move(motion_);
}

void Simulator::runToEnd() {
  try {
    if (!follow()) return;
  } catch (const NotComputable& error) {
    finish(MotionStatus::not_computable, now_, error.what());
    return;
  }
  now_ = motion_.duration = std::min(motion_.duration, last_asked_for_);
  finish(MotionStatus::complete, motion_.duration, "complete");
}

// False where the motion has ended before its time.
bool Simulator::follow() {
  if (steps_before_ > 0) work_.step(steps_before_);
  if (!start()) return false;
  for (PredictedEvent next; takeNext(next);) {
    work_.step();
    if (motion_.event_count >= impact_limit_) {
      finish(MotionStatus::impact_limit, next.time,
             "stopped after " + eventsSoFar() + ", the limit");
      return false;
    }
    if (next.isTaken()) {
      takeOver();
      commit();
      continue;
    }
    if (invalidatesReuse(next.a) || invalidatesReuse(next.b)) return false;
    if (next.isTransition() && arcOf(next.a).trajectory().ride()) {
      const RideEnd ride = resolveRide(next.a);
      if (ride == RideEnd::ends) return false;
      if (ride == RideEnd::goes_on) continue;
    } else if (next.isTransition()) {
      resolveTransition(next.a);
    } else {
      if (!isExplained(next)) return false;
      resolve(next);
    }
    if (std::ranges::any_of(draft_.event.participants, [&](const Participant& p) { return invalidatesReuse(p.body); })) return false;
    if (draft_.event.kind != EventKind::transition && !separates()) return false;
    const bool last = accumulates();
    commit();
    if (last) return false;
  }
  return true;
}

// Contacts of one instant are solved together: those predicted for it, all features that touch in it, and those that
// the solved impact itself brings about within it, on contacts that were not separating before; then it is solved
// again.
void Simulator::resolve(const PredictedEvent& first) {
  // the arcs of the two bodies were written long ago: both are fetched at once
  for (int body : {first.a, first.b}) {
    const char* arc = reinterpret_cast<const char*>(&arcOf(body));
    for (std::size_t line = 0; line < sizeof(Arc); line += 64) __builtin_prefetch(arc + line);
  }
  beginDraft(first.time);
  contactsOfInstant(first);
  do {
    solveDraft();
    predictDraft();
  } while (joinInstant());
}

void Simulator::beginDraft(double time) {
  draft_.event = {};
  draft_.event.time = time;
  draft_.woken.clear();
  draft_.touching.clear();
  snapshots_.clear();
}

// The predictions that share the instant and, directly or through others, a dynamic body.
void Simulator::contactsOfInstant(const PredictedEvent& first) {
  const double limit = first.time + scaleOf(first.a, first.b, first.time).instant();
  same_.clear();
  queue_.visitUntil(limit, [&](int body) {
    const NextImpact& next_impact = next_impacts_[index(body)];
    if (next_impact.first.a < 0) return;
    if (holds(next_impact.first) && next_impact.first.explained()) same_.push_back(next_impact.first);
    for (const PredictedEvent& p : next_impact.of_instant)
      if (p.time <= limit && holds(p) && p.explained()) same_.push_back(p);
  });
  std::sort(same_.begin(), same_.end());
  addTouching(first.time, first.a, first.b, first.features);
  bodies_ = {first.a, first.b};
  const auto shares = [&](const PredictedEvent& p) {
    return std::ranges::any_of(bodies_, [&](int b) { return (b == p.a || b == p.b) && isMoved(b); });
  };
  for (auto next = same_.begin(); (next = std::ranges::find_if(same_, shares)) != same_.end();) {
    if (inDraft(next->a, next->b, next->features) || meetsThere(*next, first.time)) {
      addTouching(first.time, next->a, next->b, next->features);
      for (int b : {next->a, next->b})
        if (std::ranges::find(bodies_, b) == bodies_.end()) bodies_.push_back(b);
    }
    same_.erase(next);
  }
}

bool Simulator::inDraft(int a, int b, const FeaturePair& features) const {
  return std::ranges::any_of(draft_.event.contacts,
                             [&](const Contact& c) { return c.a == a && c.b == b && c.features == features; });
}

// The contact at the given features, and whatever else of the pair touches within the instant and was not separating.
void Simulator::addTouching(double time, int a, int b, const FeaturePair& features) {
  std::vector<Contact>& contacts = draft_.event.contacts;
  if (inDraft(a, b, features)) return;
  contacts.push_back(makeContact(time, a, b, features));
  if (simple_[index(a)] && simple_[index(b)]) return;
  const PairScale scale = scaleOf(a, b, time);
  const double reach = scale.instant() * std::abs(contacts.back().approach);
  for (const FeaturePair& f : contacts_.touching(a, b, arcOf(a), arcOf(b), time, reach)) {
    if (inDraft(a, b, f)) continue;
    const Contact c = makeContact(time, a, b, f);
    if (c.approach <= scale.neither()) contacts.push_back(c);
  }
}

// State of a body at the event, worked out once: its place in snapshots_.
std::size_t Simulator::snapshot(int body, double time) {
  for (std::size_t i = 0; i < snapshots_.size(); ++i)
    if (snapshots_[i].body == body) return i;
  Snapshot& s = snapshots_.emplace_back();
  s.body = body;
  s.state = arcOf(body).stateAt(time);
  s.k = arcOf(body).kinematicsOf(s.state);
  return snapshots_.size() - 1;
}

Contact Simulator::makeContact(double time, int a, int b, const FeaturePair& features) {
  const std::size_t place_a = snapshot(a, time), place_b = snapshot(b, time);
  const Kinematics &ka = snapshots_[place_a].k, &kb = snapshots_[place_b].k;
  Contact c;
  c.a = a;
  c.b = b;
  c.features = features;
  const auto tilt = [&](int body) { return arcOf(body).moving() && !isSupport(body) ? tiltOf(body, impacts_[index(body)] + 1) : -1; };
  builder_.place(c, ka, kb);
  if (rimLiesFlat(motion_, c, {ka.x, ka.R}, {kb.x, kb.R})) builder_.placeMoving(c, ka, kb);
  c.counted = isCounted(c, snapshots_[place_a].state, snapshots_[place_b].state);
  if (c.counted) c.tilt_a = tilt(a), c.tilt_b = tilt(b);
  if (c.tilt_a >= 0 || c.tilt_b >= 0) builder_.place(c, ka, kb);
  if (!(std::isfinite(c.at.gap) && c.at.point.allFinite() && c.at.normal.allFinite()))
    giveUp("contact", a, b, time,
           NotComputable("its features (" + motion_.geometry->describe(a, b, features) +
                         ") define no point or no normal"));
  c.pair = builder_.pairOf(a, b);
  return c;
}

int Simulator::tiltOf(int body, int impact) const {
  const auto at = tilts_.find({body, impact});
  return at == tilts_.end() ? -1 : at->second;
}

// Participants, impulses and the arcs that follow, with all that these move.
void Simulator::solveDraft() {
  do {
    do {
      takePart();
      solveLaw();
    } while (wakesStruck());
    chooseArcs();
  } while (wakesUnheld());
}

void Simulator::takePart() {
  Event& event = draft_.event;
  if (any_lasted_) addConstrained();
  dropDoubles();
  const std::size_t n = event.contacts.size();
  work_.step(n + n * n * n / 10);  // what many contacts at once cost
  for (const Participant& p : event.participants) in_draft_[index(p.body)] = -1;
  event.participants.clear();
  bodies_.clear();
  for (const Contact& c : event.contacts)
    for (int body : {c.a, c.b})
      if (arcOf(body).moving()) bodies_.push_back(body);
  std::sort(bodies_.begin(), bodies_.end());
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  event.participants.reserve(bodies_.size());
  for (int body : bodies_) {
    const bool counts = std::ranges::any_of(
        event.contacts, [&](const Contact& c) { return !c.held && c.counted && (c.a == body || c.b == body); });
    const bool stays = isSupport(body);
    event.participants.push_back({body, static_cast<int>(motion_.world_lines[index(body)].arcs.size()) - 1,
                                  counts && !stays ? impacts_[index(body)] + 1 : 0,
                                  snapshots_[snapshot(body, event.time)].state, stays});
  }
}

Pose Simulator::poseAt(int body, double time) {
  const Kinematics k = pathOf(body).kinematicsAt(time);
  return {k.x, k.R};
}

// Whether features meet at `time` where they are predicted to: the lowest point of a rim that lies nearly flat may be
// elsewhere an instant later, and then it is another contact.
bool Simulator::meetsThere(const PredictedEvent& p, double time) {
  const Pose a = poseAt(p.a, p.time), b = poseAt(p.b, p.time);
  const Vec3 there = motion_.geometry->contact(p.a, p.b, p.features, a, b).point;
  const Vec3 here = makeContact(time, p.a, p.b, p.features).at.point;
  double arm = 0;
  for (const auto& [body, x] : {std::pair{p.a, a.x}, std::pair{p.b, b.x}})
    if (arcOf(body).moving()) arm = std::max(arm, (there - x).norm());
  return (here - there).norm() <= kSamePlace * arm;
}

bool Simulator::joinInstant() {
  const Event& event = draft_.event;
  const PredictedEvent* soonest = nullptr;
  for (const PredictedEvent& p : found_)
    if (p.explained() && (!soonest || p < *soonest)) {
      const PairScale scale = scaleOf(p.a, p.b, p.time);
      if (!(p.time <= event.time + scale.instant()) || inDraft(p.a, p.b, p.features)) continue;
      const auto joined = [&](int body) { return in_draft_[index(body)] >= 0 && isMoved(body); };
      if (!joined(p.a) && !joined(p.b)) continue;
      if (liesFlat(p, event.time)) continue;  // its marks are there; where they do not carry it, it meets by itself
      // a contact that was separating before is an impact of its own, after this one
      const Contact meets = makeContact(event.time, p.a, p.b, p.features);
      if (meets.approach > scale.neither()) continue;
      if (std::ranges::any_of(event.contacts, [&](const Contact& c) { return isDouble(c, meets); })) continue;
      if (!meetsThere(p, event.time)) continue;
      soonest = &p;
    }
  if (!soonest) return false;
  addTouching(event.time, soonest->a, soonest->b, soonest->features);
  return true;
}

void Simulator::commit() {
  Event& event = draft_.event;
  for (const Contact& c : event.contacts)
    if (StartOverlap* overlap = overlapOf(c.a, c.b); overlap && !overlap->parted) {
      followOverlap(*overlap, event.time);
      if (!overlap->parted) overlap->parted = event.time;
    }
  searches_ = 0;
  for (const Participant& p : event.participants)
    if (p.impact > 0) ++impacts_[index(p.body)];
  const double time = event.time;
  const bool ask = motion_.has_events && stop_when_ && event.counts();
  builder_.add(std::move(event), std::move(draft_.arcs));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {  // the participants
    const int body = bodies_[i];
    arc_[index(body)] = &motion_.world_lines[index(body)].arcs.back();
    if (isMoved(body)) ++version_[index(body)];
    in_draft_[index(body)] = -1;
    if (any_lasted_) contact_states_[index(body)] = draft_.contact_state.empty() ? kInFlight : std::move(draft_.contact_state[i]);
    enter(body, draft_.next_impacts[i]);
  }
  if (!ask || !stop_when_(motion_)) return;
  last_asked_for_ = std::max(time, least_duration_);
  stop_when_ = nullptr;
}

void Simulator::finish(MotionStatus status, double end, std::string message) {
  motion_.status = status;
  motion_.end = end;
  motion_.message = std::move(message);
  extendAll();
  endOverlaps(motion_.end);
}

}  // namespace carom
