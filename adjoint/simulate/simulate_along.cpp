// SPDX-License-Identifier: MIT
#include "adjoint/simulate/simulate_along.h"

#include <algorithm>
#include <cmath>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/refuse.hpp"
#include "adjoint/impact/impact.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/simulate/followed_path.hpp"
#include "adjoint/simulate/followed_scene.hpp"
#include "adjoint/simulate/group_of.hpp"
#include "adjoint/simulate/guard_root.hpp"
#include "adjoint/simulate/motion_builder.hpp"
#include "adjoint/simulate/simulator.hpp"
#include "adjoint/simulate/supported_component.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Follows the events of a motion, one after another.
class Follower {
 public:
  Follower(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry, double duration)
      : like_(like),
        scene_(scene),
        builder_(scene, duration),
        motion_(builder_.motion),
        scales_(scene, *motion_.models),
        late_(scene.bodies.size(), false) {
    motion_.plan = planFor(like, scene, *motion_.models);
    motion_.geometry = std::move(geometry);
    motion_.overlaps = like.overlaps;
    motion_.lowest_bounce = like.lowest_bounce;
    held_.resize(scene.bodies.size());
  }

  MotionAlong run() {
    motion_.events.reserve(like_.events.size());
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
      motion_.world_lines[b].arcs.reserve(like_.world_lines[b].arcs.size());
      motion_.world_lines[b].events.reserve(like_.world_lines[b].events.size());
    }
    builder_.giveAs(like_);
    builder_.start();
    motion_.end = motion_.duration;
    motion_.message = "complete";
    Outcome outcome = Outcome::found;
    for (const Event& was : like_.events) {
      try {
        outcome = follow(was);
      } catch (const NotComputable& error) {
        outcome = fail(was, error.what());
      }
      if (outcome == Outcome::late) ++along_.left_out;
      if (outcome == Outcome::failed) break;
    }
    along_.complete = outcome != Outcome::failed;
    // what is followed may end early; then its last impact says how much later this one does
    if (along_.complete && like_.status != MotionStatus::complete && along_.left_out == 0 && !motion_.events.empty()) {
      motion_.status = like_.status;
      motion_.end = std::min(motion_.duration, like_.end + (motion_.events.back().time - like_.events.back().time));
      motion_.message = like_.message;
    }
    along_.order_changed = orderByTime(motion_);
    for (std::size_t b = 0; b < motion_.world_lines.size(); ++b) extendLast(b);
    along_.motion = std::move(motion_);
    return std::move(along_);
  }

 private:
  enum class Outcome { found, late, failed };

  void extendLast(std::size_t body) {
    Arc& arc = motion_.world_lines[body].arcs.back();
    try {
      extendGroup(motion_, held_[body], static_cast<int>(body), motion_.end);
      extendAlong(motion_, held_[body], arc, motion_.end);
    } catch (const NotComputable& error) {
      motion_.end = std::min(motion_.end, arc.availableUntil());
      builder_.endFlight(body, error);
      along_.complete = false;
      along_.why_not = motion_.message;
    }
  }

  Outcome follow(const Event& was) {
    const auto isLate = [&](const Participant& p) { return late_[index(p.body)]; };
    if (std::ranges::any_of(was.participants, isLate)) {
      markLate(was);
      return Outcome::late;
    }
    event_ = was;
    weights_ = guardWeights(was);
    for (Contact& c : event_.contacts) {
      c.pair = builder_.pairOf(c.a, c.b);
      if (c.captured || c.kept) c.pair.elasticity = 0;
      if (was.kind == EventKind::placed) c.pair.friction = 0;
    }
    if (was.kind == EventKind::placed) return meet(was, 0);
    if (landsFlat(like_, was)) return fail(was, "a rim became flat there");
    if (was.kind == EventKind::transition) return followTransition(was);
    double from = 0, flight = was.time;
    for (const Participant& p : was.participants) {
      from = std::max(from, arcOf(p.body).start());
      flight = std::min(flight, was.time - like_.world_lines[index(p.body)].arcs[index(p.arc)].start());
    }
    const RootSearch search{
        .from = from, .until = motion_.duration, .guess = guess(was), .stride = std::max(flight, scales_.instantOf(like_, was))};
    const GuardRoot root = descendingRoot(search, [&](double t) { return guardAt(was, t); });
    if (root.outcome == GuardRoot::Outcome::late) {
      markLate(was);
      return Outcome::late;
    }
    if (root.outcome != GuardRoot::Outcome::found) return fail(was, root.why());
    return meet(was, root.time);
  }

  Outcome meet(const Event& was, double time) {
    place(time);
    if (was.kind != EventKind::placed && was.contacts.size() > 1 && !meetInOneInstant(scales_.instantOf(like_, was)))
      return fail(was, "its contacts no longer meet in one instant");
    std::vector<State> after;
    solveImpact(event_, *motion_.models, after);
    if (builder_.notParted(event_, after)) return fail(was, "its impulse does not separate the bodies");
    for (std::size_t k = 0; k < event_.contacts.size(); ++k) {
      Contact& c = event_.contacts[k];
      if (was.contacts[k].lasts && !c.lasts) return fail(was, "its contacts no longer persist");
      c.lasts = was.contacts[k].lasts;
    }
    event_.settles_at = settlesAt(motion_, event_, after);
    commit(was, after);
    return Outcome::found;
  }

  // Of a path in lasting contact: its own end, or when the contact of `was` comes to the same border.
  Outcome followTransition(const Event& was) {
    const int body = was.participants[0].body;
    const Arc& arc = arcOf(body);
    const FollowedPath& held = held_[index(body)];
    if (!arc.inContact()) return fail(was, "the bodies are not in contact");
    std::optional<double> elapsed;
    if (arc.trajectory().group()) {
      extendGroup(motion_, held, body, motion_.duration);
      const std::optional<PathEnding>& end = arcOf(body).trajectory().group()->ending();
      if (end && end->guard.cause == was.cause) elapsed = arcOf(body).knownUntil() - arc.start();
    } else if (arc.isIntegrated()) {
      extendAlong(motion_, held, arcOf(body), motion_.duration);
      const PathTransition end = constrainedTransition(arc, arc.start());
      if (end.cause == was.cause) elapsed = end.elapsed;
    } else if (was.cause == TransitionCause::slip_ends && std::isfinite(arc.closedForm()->slip_end)) {
      elapsed = arc.closedForm()->slip_end;
    } else if (held.transition.cause == was.cause && was.cause == TransitionCause::tips) {
      elapsed = held.transition.elapsed;
    } else if (was.cause == TransitionCause::leaves) {
      elapsed = held.leaves(motion_, arc, was);
    }
    if (!elapsed) return fail(was, was.cause == TransitionCause::leaves ? "the contact stays on its feature"
                                                                        : "the contact mode does not change");
    if (arc.start() + *elapsed > motion_.duration) return markLate(was), Outcome::late;
    place(arc.start() + *elapsed);
    std::vector<State> before;
    for (const Participant& p : event_.participants) before.push_back(p.before);
    commit(was, std::move(before));
    return Outcome::found;
  }

  // What strikes a body later goes another way without the impact; a kinematic body goes on.
  void markLate(const Event& was) {
    for (const Participant& p : was.participants)
      if (!(*motion_.models)[index(p.body)].kinematic) late_[index(p.body)] = true;
  }

  // Where it was, moved as the last impact of its bodies was.
  double guess(const Event& was) const {
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
  void place(double time) {
    event_.time = time;
    for (Participant& p : event_.participants) {
      extendGroup(motion_, held_[index(p.body)], p.body, time);
      Arc& arc = arcOf(p.body);
      extendAlong(motion_, held_[index(p.body)], arc, time);
      p.before = arc.stateAt(time);
    }
    const auto kinematics = [&](int body) {
      const Participant* p = event_.find(body);
      return arcOf(body).kinematicsOf(p ? p->before : arcOf(body).startState());
    };
    for (Contact& c : event_.contacts) builder_.place(c, kinematics(c.a), kinematics(c.b));
  }

  // The mean gap of the contacts, less what it was in `like`: contacts of one instant need not touch to the last bit.
  GuardValue guardAt(const Event& was, double time) {
    place(time);
    GuardValue guard;
    for (std::size_t k = 0; k < event_.contacts.size(); ++k) {
      const Contact& c = event_.contacts[k];
      guard.gap += weights_[k] * (was.contacts.size() > 1 ? c.at.gap - was.contacts[k].at.gap : c.at.gap);
      guard.rate += weights_[k] * c.approach;
      guard.size = std::max(guard.size, c.at.point.cwiseAbs().maxCoeff());
    }
    for (const Participant& p : event_.participants) {
      const Arc& arc = arcOf(p.body);
      guard.size += p.before.x.cwiseAbs().maxCoeff();
      guard.speed += p.before.v.norm() + arc.spinBound() * (event_.contacts[0].at.point - p.before.x).norm();
    }
    return guard;
  }

  bool meetInOneInstant(double instant) const {
    return std::ranges::all_of(event_.contacts, [&](const Contact& c) {
      return std::abs(c.at.gap) <= 2 * instant * std::abs(c.approach) + scales_.leastHeight();
    });
  }

  void commit(const Event& was, std::vector<State> after) {
    if (branchOf(event_.mode) != branchOf(was.mode)) along_.mode_changed = true;
    closeComponent(was, after);
    std::vector<Arc> arcs;
    std::vector<std::optional<Arc>> groups = groupsAlong(like_, was, motion_, after, event_.time);
    for (std::size_t i = 0; i < after.size(); ++i) {
      const Participant& p = was.participants[i];
      if (groups[i]) held_[index(p.body)] = {.ends = endsByItself(like_, p), .group = groupAfter(like_, p)};
      arcs.push_back(groups[i] ? std::move(*groups[i]) : p.stays ? arcOf(p.body) : arcAfter(was, i, after[i]));
    }
    builder_.add(std::move(event_), std::move(arcs));
  }

  bool isMoved(int body) const { return !scene_.bodies[index(body)].immovable(); }
  bool liesOnAnother(const Contact& c) const { return c.lasts && isMoved(c.a) && isMoved(c.b); }

  // The gaps of bodies that come to rest on each other close together; those of groups as their paths begin.
  void closeComponent(const Event& was, std::vector<State>& after) {
    if (std::ranges::none_of(event_.contacts, [&](const Contact& c) { return liesOnAnother(c) && !c.held; })) return;
    std::vector<SupportedComponent::Member> members;
    std::vector<Contact> closed;
    const auto moves = [&](int body) {
      const Participant* p = was.find(body);
      return p && groupAfter(like_, *p);
    };
    std::ranges::copy_if(event_.contacts, std::back_inserter(closed), [&](const Contact& c) { return c.lasts && !moves(c.a) && !moves(c.b); });
    if (closed.empty()) return;
    for (std::size_t i = 0; i < after.size(); ++i)
      if (const Participant& p = event_.participants[i]; !p.stays && isMoved(p.body) && !moves(p.body)) members.push_back({p.body, after[i]});
    closeGaps(motion_, members, closed, event_.time);
    for (const SupportedComponent::Member& m : members) after[static_cast<std::size_t>(event_.find(m.body) - event_.participants.data())] = m.state;
  }

  // A flight, or a path of the form that it was.
  Arc arcAfter(const Event& was, std::size_t participant, const State& after) {
    const Participant& p = was.participants[participant];
    const Arc& like = like_.world_lines[index(p.body)].arcs[index(p.next())];
    FollowedPath& held = held_[index(p.body)];
    if (like.trajectory().constrained()) return constrainedAfter(p, after);
    held = {};
    if (!like.inContact()) return builder_.flight(p.body, event_.time, after);
    State start = after;
    for (const Contact& c : event_.contacts)
      if (c.lasts && (c.a == p.body || c.b == p.body)) {
        held.contacts.push_back(c);
        held.contacts.back().pair = builder_.pairOf(c.a, c.b);
      }
    if (const RidePath* ride = like.trajectory().ride()) return rideArc(motion_, p.body, start, ride->carrier().from(motion_, event_.time), ride->isLoose());
    if (std::ranges::any_of(held.contacts, [&](const Contact& c) { return liesOnAnother(c); }))
      return makePathArc(motion_, restPathOf(motion_, p.body, start, pointersTo(held.contacts), like.closedForm()->loose, event_.time),
                         event_.time).arc;
    if (std::ranges::any_of(held.contacts, [](const Contact& c) { return !c.held; }))
      closeGaps(motion_, p.body, start, held.contacts);
    PathArc made = makePathArc(
        motion_, contactPathOf(motion_, p.body, start, pointersTo(held.contacts), like.closedForm()->form, event_.time), event_.time);
    held.transition = made.transition;
    return std::move(made.arc);
  }

  // A path on which the contacts of the event hold a body, and those that held it before.
  Arc constrainedAfter(const Participant& p, const State& after) {
    const auto now = [&](int body) {
      const Arc& arc = arcOf(body);
      if (body != p.body && (*motion_.models)[index(body)].kinematic) return arc.kinematicsAt(event_.time);
      return arc.kinematicsOf(body == p.body ? after : arc.startState());
    };
    FollowedPath& held = held_[index(p.body)];
    std::vector<Contact> contacts = held.contactsAt(event_, p.body);
    for (Contact& c : contacts) {
      builder_.place(c, now(c.a), now(c.b));
      c.pair = builder_.pairOf(c.a, c.b);
    }
    return held.follow(motion_, like_, p, after, contacts, event_.time);
  }

  Outcome fail(const Event& was, const std::string& why) {
    motion_.end = motion_.duration;
    for (const Participant& p : was.participants) motion_.end = std::min(motion_.end, arcOf(p.body).start());
    const Contact& c = was.contacts[0];
    along_.why_not = motion_.message =
        textOf(6, "the impact of '", scene_.bodies[index(c.a)].name, "' and '", scene_.bodies[index(c.b)].name,
               "' that was at t = ", was.time, " s does not follow: ", why);
    motion_.status = MotionStatus::unresolved_impact;
    return Outcome::failed;
  }

  Arc& arcOf(int body) { return motion_.world_lines[index(body)].arcs.back(); }
  const Arc& arcOf(int body) const { return motion_.world_lines[index(body)].arcs.back(); }

  const Motion& like_;
  const Scene& scene_;
  MotionBuilder builder_;
  Motion& motion_;
  PairScales scales_;
  MotionAlong along_;            // but for its motion
  std::vector<bool> late_;       // a body each: its next impact comes after the duration
  std::vector<FollowedPath> held_;  // a body each
  std::vector<double> weights_;  // of the gaps of the event that is followed
  Event event_;                  // being worked out
};

}  // namespace

MotionAlong simulateAlong(const Motion& like, const Scene& scene, std::shared_ptr<const ContactGeometry> geometry,
                          double duration) {
  if (!like.has_events)
    throw InputError("found a motion whose events were not recorded, expected one with them: they are followed");
  checkDuration("simulateAlong", duration);
  if (!geometry) throw InputError("found no geometry, expected that of the scene");
  requireSameParts(*like.scene, scene);
  validate(scene);
  return Follower(like, scene, std::move(geometry), duration).run();
}

}  // namespace carom
