// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/simulate/simulator.hpp"

// The outcomes that end a motion before its duration, each a status and a sentence.

namespace carom::adjoint_detail {

std::string Simulator::namesOf(int a, int b) const {
  return "'" + scene_.bodies[index(a)].name + "' and '" + scene_.bodies[index(b)].name + "'";
}

// "3 impacts": the reported ones, the draft among them.
std::string Simulator::impactsWithDraft() const {
  const std::size_t count = motion_.impacts + (draft_.event.counts() ? 1 : 0);
  return std::to_string(count) + (count == 1 ? " impact" : " impacts");
}

// What the limit of events has let through: most often all of them are impacts.
std::string Simulator::eventsSoFar() const {
  if (motion_.impacts == motion_.event_count) return std::to_string(motion_.impacts) + " impacts";
  return std::to_string(motion_.event_count) + " events, " + std::to_string(motion_.impacts) + " of them impacts";
}

// Bodies may come to overlap where no features say how they meet.
bool Simulator::isExplained(const PredictedEvent& next) {
  if (next.explained()) return true;
  finish(MotionStatus::unresolved_impact, next.time,
         textOf(6, namesOf(next.a, next.b), " meet at t = ", next.time,
                " s where no face, edge, rim or vertex of theirs defines a contact normal"));
  return false;
}

// An impulse along a tilted normal may fail to part the bodies: there is no motion after it.
bool Simulator::separates() {
  const Contact* c = builder_.notParted(draft_.event, draft_.after);
  if (!c) return true;
  finish(MotionStatus::unresolved_impact, draft_.event.time,
         textOf(6, "the tilted normal at the impact of ", namesOf(c->a, c->b), " at t = ", draft_.event.time,
                " s does not separate the bodies"));
  return false;
}

// Whether the next bounce of a contact, if it is known, is too low to count. The contact leaves at e times its approach
// or faster; where that leaves it low, what counts is how far its features are apart halfway, which of a parabola is its
// height. A body that turns may lift them without any speed to begin with.
bool Simulator::isLow(const Contact& c, const PredictedEvent*& next) {
  next = nullptr;
  for (const PredictedEvent& p : found_)
    if (p.a == c.a && p.b == c.b && p.explained()) {
      next = &p;
      break;
    }
  if (!next) return false;
  const double start = draft_.event.time, slowest = std::abs(c.pair.elasticity * c.approach);
  if (!(0.25 * slowest * (next->time - start) < scales_.leastHeight())) return false;
  const double halfway = start + 0.5 * (next->time - start);
  const ContactPoint then = motion_.geometry->contact(c.a, c.b, c.features, poseAt(c.a, halfway), poseAt(c.b, halfway));
  return !(then.gap >= scales_.leastHeight());
}

// A body that is in infinitely many of the events that pile up has this many of them in no time: within `stall`, s.
bool Simulator::stalls(int body, double stall) const {
  const auto& arcs = motion_.world_lines[index(body)].arcs;
  if (!(draft_.event.time - arcs.back().start() < stall)) return false;  // far most often; the last arc is at hand
  return arcs.size() > kStallEvents && draft_.event.time - arcs[arcs.size() - kStallEvents].start() < stall;
}

// True when the impacts of a pair or of a body pile up in finite time; sets status and message.
bool Simulator::accumulates() {
  const Event& event = draft_.event;
  if (!draft_.beyond.empty()) {
    finish(MotionStatus::unresolved_contact, event.time, draft_.beyond);
    return true;
  }
  for (const Contact& c : event.contacts) {
    if (contactsLast()) break;
    const std::uint64_t pair = static_cast<std::uint64_t>(c.a) << 32 | static_cast<std::uint32_t>(c.b);
    const PredictedEvent* next;
    if (!isLow(c, next)) {
      if (!low_bounces_.empty()) low_bounces_.erase(pair);
      continue;
    }
    if (!(next->features == c.features) && ++low_bounces_[pair] < kRattles) continue;
    // gaps shrink by e each, so the rest of the cascade takes gap / (1 - e)
    const double gap = next->time - event.time, e = c.pair.elasticity;
    finish(MotionStatus::cascade, event.time,
           textOf(10, namesOf(c.a, c.b), " stay in contact from t = ", event.time + (e < 1 ? gap / (1 - e) : gap),
                  " s on, at (", c.at.point.x(), ", ", c.at.point.y(), ", ", c.at.point.z(), "), after ",
                  impactsWithDraft(), "; with a lowest bounce of 0 no contact persists, so the motion ends there"));
    return true;
  }
  const double stall = kStall * scales_.instantOf(motion_, event);
  for (const Participant& p : event.participants) {
    if (!isMoved(p.body) || !stalls(p.body, stall)) continue;
    finish(MotionStatus::cascade, event.time,
           textOf(6, "impacts accumulate at t = ", event.time, " s, at (", event.contacts[0].at.point.transpose(),
                  "): ", kStallEvents, " of '", scene_.bodies[index(p.body)].name, "' within ", stall,
                  " s; the motion ends there"));
    return true;
  }
  return false;
}

// What a flight comes to must be numbers that can be computed with.
void Simulator::requireFlight(int body, const Arc& arc) const {
  if (!arc.moving()) return;
  const double end = motion_.duration;
  const State& s = arc.startState();
  double furthest = 0;
  for (const Vec3& v : {s.x, s.v, arc.positionAt(end), arc.velocityAt(end)})
    furthest = std::max(furthest, v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  const auto refuseFlight = [&](const std::string& what) {
    throw NotComputable(textOf(6, "the flight of '", scene_.bodies[index(body)].name, "' from t = ", arc.start(),
                               " s on cannot be computed: ", what));
  };
  if (!(furthest <= kFurthest && s.q.coeffs().allFinite()))
    refuseFlight("its position or velocity is beyond the range of doubles");
  if (arc.tier() == Tier::none) return;  // whose orientation is not asked for
  if (!(arc.spinBound() * (end - arc.start()) <= kMostTurn && s.L.allFinite()))
    refuseFlight("it spins so fast that no digit of its orientation is left");
}

void Simulator::giveUp(const char* what, int a, int b, double time, const NotComputable& why) const {
  throw NotComputable(textOf(6, "the ", what, " of ", namesOf(std::min(a, b), std::max(a, b)), " at t = ", time,
                             " s cannot be computed: ", why.what()));
}

// Makes the last arcs available to the end of the motion, which comes sooner where one of them cannot be followed.
void Simulator::extendAll() {
  for (std::size_t b = 0; b < motion_.world_lines.size(); ++b) {
    if (motion_.world_lines[b].arcs.empty()) continue;  // given up before the start
    Arc& arc = motion_.world_lines[b].arcs.back();
    try {
      extend(arc, motion_.end);
    } catch (const NotComputable& error) {
      builder_.endFlight(b, error);
      endWith(arc);
    } catch (const WorkEnded&) {
      if (!work_ended_) throw;
      endWith(arc);
    }
  }
}

void Simulator::extend(Arc& arc, double until) {
  if (!(arc.availableUntil() < until)) return;
  work_.step();
  const std::size_t before = workIn(arc);
  arc.extendTo(until);
  work_.step(workIn(arc) - before);
}

void Simulator::endWith(const Arc& arc) {
  motion_.end = std::min(motion_.end, arc.availableUntil());
  forgetAfter(motion_.end);
}

// The limit of work was reached, or somebody asked to stop: what is known by then is the motion.
void Simulator::endWork(bool stopped) {
  const std::size_t limit = work_.limit();
  work_ended_ = true;
  if (!motion_.geometry) motion_.geometry = contacts_.geometry();  // it never began
  const std::string steps = std::to_string(stopped ? work_.steps() : limit) + " steps";
  work_.allowMore(kStepsToEnd);
  finish(stopped ? MotionStatus::stopped : MotionStatus::step_limit, now_, "");
  if (motion_.status == MotionStatus::not_computable) return;
  motion_.message = textOf(10, "stopped at t = ", motion_.end, " s after ", steps,
                           stopped ? ", as requested" : ", the limit");
}

void Simulator::forgetAfter(double end) {
  for (WorldLine& line : motion_.world_lines)
    while (line.arcs.size() > 1 && line.arcs.back().start() > end) {
      line.arcs.pop_back();
      if (motion_.has_events) line.events.pop_back();
    }
  if (!motion_.has_events) return;
  while (!motion_.events.empty() && motion_.events.back().time > end) motion_.events.pop_back();
  motion_.event_count = motion_.events.size();
  motion_.impacts = static_cast<std::size_t>(std::ranges::count_if(motion_.events, &Event::counts));
}

}  // namespace carom::adjoint_detail
