// SPDX-License-Identifier: MIT
#include "adjoint/simulate/replay.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/impact/impact.hpp"
#include "adjoint/impact/tilt.hpp"
#include "adjoint/simulate/replay_root.hpp"
#include "adjoint/simulate/simulator.hpp"

namespace carom {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Follows the events of a motion, one after another.
class Follower {
 public:
  Follower(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry, double duration);
  Replay run();

 private:
  // What became of an impact.
  enum class Outcome { found, late, failed };

  void start();
  Outcome follow(const Event& was);
  double guess(const Event& was) const;
  void markLate(const Event& was);
  GuardValue guardAt(const Event& was, double time);
  bool meetInOneInstant() const;
  void place(const Event& was, double time);
  void tilt();
  bool parts(const std::vector<State>& after);
  void commit(const Event& was, std::vector<State>& after);
  void orderByTime();
  void extendLast(std::size_t body);
  Outcome fail(const Event& was, const std::string& why);

  Arc& arcOf(int body) { return replay_.motion.world_lines[index(body)].arcs.back(); }
  const Arc& arcOf(int body) const { return replay_.motion.world_lines[index(body)].arcs.back(); }

  const Motion& like_;
  const Scene& scene_;
  Replay replay_;
  std::vector<bool> late_;  // a body each: its next impact comes after the duration
  Event event_;             // being worked out
};

void requireSameParts(const Scene& was, const Scene& scene) {
  const auto same = [](std::size_t found, std::size_t expected, const char* what) {
    if (found != expected)
      throw InputError("found a scene with " + std::to_string(found) + " " + what + ", expected the " +
                       std::to_string(expected) + " of the motion that is followed");
  };
  same(scene.bodies.size(), was.bodies.size(), "bodies");
  same(scene.materials.size(), was.materials.size(), "materials");
  same(scene.tilts.size(), was.tilts.size(), "tilts");
}

/// The tiers of `like`, but for bodies whose moments have gained or lost a symmetry.
Plan planFor(const Motion& like, const Scene& scene, const std::vector<BodyModel>& models) {
  Plan plan = like.plan, everything;
  for (std::size_t b = 0; b < models.size(); ++b) {
    const BodyModel& was = (*like.models)[b];
    if (!models[b].moving) continue;
    const bool same = symmetryAxis(models[b].inertia) == symmetryAxis(was.inertia) &&
                      models[b].center.isZero(0) == was.center.isZero(0);
    if (same) continue;
    if (everything.bodies.empty()) everything = makePlan(scene);
    plan.bodies[b] = everything.bodies[b];
  }
  return plan;
}

Follower::Follower(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry,
                   double duration)
    : like_(like), scene_(scene), late_(scene.bodies.size(), false) {
  Motion& motion = replay_.motion;
  motion.scene = std::make_shared<const Scene>(scene);
  auto models = std::make_shared<std::vector<BodyModel>>();
  models->reserve(scene.bodies.size());
  for (const Body& body : scene.bodies) models->push_back(modelOf(body));
  motion.plan = planFor(like, scene, *models);
  motion.models = std::move(models);
  motion.geometry = std::move(geometry);
  motion.overlaps = like.overlaps;
  motion.duration = duration;
  motion.world_lines.resize(scene.bodies.size());
}

Replay Follower::run() {
  start();
  Motion& motion = replay_.motion;
  motion.end = motion.duration;
  motion.message = "complete";
  Outcome outcome = Outcome::found;
  for (const Event& was : like_.events) {
    try {
      outcome = follow(was);
    } catch (const NotComputable& error) {
      outcome = fail(was, error.what());
    }
    if (outcome == Outcome::late) ++replay_.left_out;
    if (outcome == Outcome::failed) break;
  }
  replay_.complete = outcome != Outcome::failed;
  // what is followed may end early; then its last impact says how much later this one does
  if (replay_.complete && like_.status != MotionStatus::complete && replay_.left_out == 0 && !motion.events.empty()) {
    motion.status = like_.status;
    motion.end = std::min(motion.duration, like_.end + (motion.events.back().time - like_.events.back().time));
    motion.message = like_.message;
  }
  orderByTime();
  motion.impacts = motion.events.size();
  for (std::size_t b = 0; b < motion.world_lines.size(); ++b) extendLast(b);
  return std::move(replay_);
}

void Follower::extendLast(std::size_t body) {
  Motion& motion = replay_.motion;
  Arc& arc = motion.world_lines[body].arcs.back();
  try {
    arc.extendTo(motion.end);
  } catch (const NotComputable& error) {
    motion.end = std::min(motion.end, arc.reach());
    motion.status = MotionStatus::not_computable;
    replay_.complete = false;
    replay_.why_not = motion.message =
        "the flight of '" + scene_.bodies[body].name + "' cannot be computed: " + error.what();
  }
}

void Follower::start() {
  Motion& motion = replay_.motion;
  motion.events.reserve(like_.events.size());
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const BodyModel& model = (*motion.models)[b];
    WorldLine& line = motion.world_lines[b];
    line.arcs.reserve(like_.world_lines[b].arcs.size());
    line.events.reserve(like_.world_lines[b].events.size());
    line.arcs.emplace_back(model, motion.plan.bodies[b].tier, scene_.gravity, 0.0, startState(scene_.bodies[b], model));
  }
}

Follower::Outcome Follower::follow(const Event& was) {
  const auto isLate = [&](const Participant& p) { return late_[index(p.body)]; };
  if (std::any_of(was.participants.begin(), was.participants.end(), isLate)) {
    markLate(was);
    return Outcome::late;
  }
  event_ = was;
  for (Contact& c : event_.contacts) {
    c.pair = combine(materialOf(scene_, scene_.bodies[index(c.a)]), materialOf(scene_, scene_.bodies[index(c.b)]));
  }
  double from = 0, flight = was.time;
  for (const Participant& p : was.participants) {
    from = std::max(from, arcOf(p.body).start());
    flight = std::min(flight, was.time - like_.world_lines[index(p.body)].arcs[index(p.arc)].start());
  }
  RootSearch search;
  search.from = from;
  search.until = replay_.motion.duration;
  search.guess = guess(was);
  search.stride = std::max(flight, kInstant);
  const GuardRoot root = descendingRoot(search, [&](double t) { return guardAt(was, t); });
  if (root.outcome == GuardRoot::Outcome::late) {
    markLate(was);
    return Outcome::late;
  }
  if (root.outcome != GuardRoot::Outcome::found) return fail(was, root.why());
  place(was, root.time);
  tilt();
  if (!meetInOneInstant()) return fail(was, "its contacts no longer meet in one instant");

  std::vector<State> after;
  solveImpact(event_, *replay_.motion.models, after);
  if (!parts(after)) return fail(was, "its impulse does not part the bodies");
  commit(was, after);
  return Outcome::found;
}

// What strikes a body later goes another way without the impact; a kinematic body goes on.
void Follower::markLate(const Event& was) {
  for (const Participant& p : was.participants)
    if (!(*replay_.motion.models)[index(p.body)].kinematic) late_[index(p.body)] = true;
}

// Where it was, moved as the last impact of its bodies was.
double Follower::guess(const Event& was) const {
  double latest = 0, shift = 0;
  for (const Participant& p : was.participants) {
    const double start = like_.world_lines[index(p.body)].arcs[index(p.arc)].start();
    if (start < latest) continue;
    latest = start;
    shift = arcOf(p.body).start() - start;
  }
  return was.time + shift;
}

// States, contact points and approach of event_ at a time.
void Follower::place(const Event& was, double time) {
  event_.time = time;
  for (Participant& p : event_.participants) {
    Arc& arc = arcOf(p.body);
    arc.extendTo(time);
    p.before = arc.stateAt(time);
  }
  const auto kinematics = [&](int body) {
    const Participant* p = event_.find(body);
    return arcOf(body).kinematicsOf(p ? p->before : arcOf(body).startState());
  };
  for (std::size_t k = 0; k < event_.contacts.size(); ++k) {
    Contact& c = event_.contacts[k];
    const Kinematics a = kinematics(c.a), b = kinematics(c.b);
    c.at = replay_.motion.geometry->contact(c.a, c.b, was.contacts[k].features, {a.x, a.R}, {b.x, b.R});
    c.approach = c.at.normal.dot(a.v + a.w.cross(c.at.point - a.x) - b.v - b.w.cross(c.at.point - b.x));
  }
}

void Follower::tilt() {
  const auto value = [&](int t) { return t < 0 ? Vec2(0, 0) : scene_.tilts[index(t)].value; };
  for (Contact& c : event_.contacts)
    c.impulse_normal =
        c.tilt_a < 0 && c.tilt_b < 0 ? c.at.normal : tiltedNormal(c.at.normal, value(c.tilt_a), value(c.tilt_b));
}

// The mean gap of the contacts, less what it was in `like`: contacts of one instant need not touch to the last bit.
GuardValue Follower::guardAt(const Event& was, double time) {
  place(was, time);
  const auto weightOf = [](const Contact& c) { return std::max(0.0, c.impulse_normal.dot(c.impulse)); };
  double total = 0;
  for (const Contact& c : was.contacts) total += weightOf(c);
  GuardValue guard;
  for (std::size_t k = 0; k < event_.contacts.size(); ++k) {
    const Contact& c = event_.contacts[k];
    const double weight =
        total > 0 ? weightOf(was.contacts[k]) / total : 1.0 / static_cast<double>(was.contacts.size());
    guard.gap += weight * (was.contacts.size() > 1 ? c.at.gap - was.contacts[k].at.gap : c.at.gap);
    guard.rate += weight * c.approach;
    guard.size = std::max(guard.size, c.at.point.cwiseAbs().maxCoeff());
  }
  for (const Participant& p : event_.participants) {
    const Arc& arc = arcOf(p.body);
    guard.size += p.before.x.cwiseAbs().maxCoeff();
    guard.speed += p.before.v.norm() + arc.spinBound() * (event_.contacts[0].at.point - p.before.x).norm();
  }
  return guard;
}

bool Follower::meetInOneInstant() const {
  if (event_.contacts.size() == 1) return true;
  return std::all_of(event_.contacts.begin(), event_.contacts.end(), [](const Contact& c) {
    return std::abs(c.at.gap) <= 2 * kInstant * std::abs(c.approach) + kLowestBounce;
  });
}

// Bodies must not go on into one another: an impulse along a tilted normal may fail to part them.
bool Follower::parts(const std::vector<State>& after) {
  for (const Contact& c : event_.contacts) {
    if (c.tilt_a < 0 && c.tilt_b < 0) continue;
    Vec3 u = Vec3::Zero();
    for (std::size_t i = 0; i < after.size(); ++i) {
      const int body = event_.participants[i].body;
      if (body != c.a && body != c.b) continue;
      const Kinematics k = arcOf(body).kinematicsOf(after[i]);
      u += (body == c.a ? 1.0 : -1.0) * (k.v + k.w.cross(c.at.point - k.x));
    }
    if (!(c.at.normal.dot(u) >= 0 && c.impulse.dot(c.impulse_normal) > 0)) return false;
  }
  return true;
}

void Follower::commit(const Event& was, std::vector<State>& after) {
  Motion& motion = replay_.motion;
  if (branchOf(event_.mode) != branchOf(was.mode)) replay_.mode_changed = true;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto b = index(event_.participants[i].body);
    WorldLine& line = motion.world_lines[b];
    line.events.push_back(static_cast<int>(motion.events.size()));
    line.arcs.emplace_back((*motion.models)[b], motion.plan.bodies[b].tier, scene_.gravity, event_.time, after[i]);
  }
  motion.events.push_back(std::move(event_));
}

void Follower::orderByTime() {
  Motion& motion = replay_.motion;
  const auto earlier = [](const Event& a, const Event& b) { return a.time < b.time; };
  if (std::is_sorted(motion.events.begin(), motion.events.end(), earlier)) return;
  replay_.order_changed = true;
  std::vector<int> order(motion.events.size()), place_of(motion.events.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return earlier(motion.events[index(a)], motion.events[index(b)]); });
  std::vector<Event> sorted;
  sorted.reserve(order.size());
  for (int e : order) {
    place_of[index(e)] = static_cast<int>(sorted.size());
    sorted.push_back(std::move(motion.events[index(e)]));
  }
  motion.events = std::move(sorted);
  for (WorldLine& line : motion.world_lines)
    for (int& e : line.events) e = place_of[index(e)];
}

Follower::Outcome Follower::fail(const Event& was, const std::string& why) {
  Motion& motion = replay_.motion;
  motion.end = motion.duration;
  for (const Participant& p : was.participants) motion.end = std::min(motion.end, arcOf(p.body).start());
  std::ostringstream text;
  const Contact& c = was.contacts[0];
  text << "the impact of '" << scene_.bodies[index(c.a)].name << "' and '" << scene_.bodies[index(c.b)].name
       << "' that was at t = " << was.time << " s does not follow: " << why;
  replay_.why_not = motion.message = text.str();
  motion.status = MotionStatus::unresolved_impact;
  return Outcome::failed;
}

}  // namespace

Replay replay(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry,
              double duration) {
  if (!like.has_events)
    throw InputError("found a motion whose events were not recorded, expected one with them: they are followed");
  checkDuration("replay", duration);
  if (!geometry) throw InputError("found no geometry, expected that of the scene");
  requireSameParts(*like.scene, scene);
  validate(scene);
  return Follower(like, scene, std::move(geometry), duration).run();
}

}  // namespace carom
