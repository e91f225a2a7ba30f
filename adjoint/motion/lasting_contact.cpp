// SPDX-License-Identifier: MIT
#include "adjoint/motion/lasting_contact.h"

#include <algorithm>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"

namespace carom {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Whether body a of a contact between moving bodies lies on b, as gravity has it.
bool isOnTop(const Motion& motion, const Contact& c) { return c.at.normal.dot(motion.scene->gravity) <= 0; }

double endOf(const Motion& motion, int body, int arc) {
  const std::vector<int>& events = motion.world_lines[index(body)].events;
  return index(arc) < events.size() ? motion.events[index(events[index(arc)])].time : motion.end;
}

/// What persists from an event on: of two moving bodies, listed with that which lies on the other.
std::vector<LastingContact> startedBy(const Motion& motion, const Event& event) {
  std::vector<LastingContact> started;
  for (const Contact& c : event.contacts) {
    const auto moved = [&](int body) {  // null for a body that impacts do not move
      const Participant* p = event.find(body);
      return p && !(*motion.models)[index(body)].kinematic ? p : nullptr;
    };
    const Participant *a = moved(c.a), *b = moved(c.b);
    if (!c.lasts || (!a && !b)) continue;
    const Participant& own = !b || (a && isOnTop(motion, c)) ? *a : *b;
    const int with = own.body == c.a ? c.b : c.a;
    auto known = std::ranges::find_if(started, [&](const LastingContact& l) { return l.body == own.body && l.with == with; });
    if (known == started.end()) {
      double to = endOf(motion, own.body, own.next());
      if (const Participant* other = own.body == c.a ? b : a) to = std::min(to, endOf(motion, other->body, other->next()));
      known = started.insert(known, {own.body, with, motion.world_lines[index(own.body)].arcs[index(own.next())].kind(), {}, event.time, to});
    }
    known->features.push_back(c.features);
  }
  return started;
}

bool goesOn(const LastingContact& before, const LastingContact& after) {
  return before.body == after.body && before.with == after.with && before.kind == after.kind && before.to == after.from &&
         std::ranges::is_permutation(before.features, after.features);
}

const char* verbOf(EventKind event, ArcKind before, ArcKind after) {
  const bool again = before == after;
  if (again && event != EventKind::transition) return "";
  switch (after) {
    case ArcKind::flight:
      return "leaves";
    case ArcKind::rest:
      return event == EventKind::placed ? "rests" : "comes to rest";
    case ArcKind::slide:
      return again ? "slides on" : "slides";
    case ArcKind::roll:
      return again ? "rolls on" : "rolls";
    case ArcKind::pivot:
      return again ? "pivots on" : "pivots";
    case ArcKind::ride:
      return again ? "rides on" : "rides";
  }
  return "";
}

}  // namespace

std::vector<LastingContact> lastingContacts(const Motion& motion) {
  if (!motion.has_events) throw InputError("found a motion whose events were not recorded, expected one with them");
  std::vector<LastingContact> found;
  std::vector<std::vector<std::size_t>> latest(motion.world_lines.size());  // of each body, those that may go on
  for (const Event& event : motion.events)
    for (LastingContact& c : startedBy(motion, event)) {
      if (c.kind == ArcKind::flight || !(c.from < c.to)) continue;
      std::vector<std::size_t>& own = latest[index(c.body)];
      const auto before = std::ranges::find_if(own, [&](std::size_t i) { return goesOn(found[i], c); });
      if (before != own.end()) {
        found[*before].to = c.to;
        continue;
      }
      own.push_back(found.size());
      found.push_back(std::move(c));
    }
  std::ranges::stable_sort(found, {}, &LastingContact::body);
  std::ranges::stable_sort(found, {}, &LastingContact::from);
  return found;
}

std::string describeChanges(const Motion& motion, int event) {
  using adjoint_detail::checkedIndex;
  const Event& of = motion.events[checkedIndex("describeChanges", "event", event, motion.events.size())];
  std::string text;
  if (of.time == motion.end && motion.status != MotionStatus::complete) return text;  // what comes next is not known
  for (const Participant& p : of.participants) {
    if (p.stays) continue;
    const std::vector<Arc>& arcs = motion.world_lines[index(p.body)].arcs;
    const std::string verb = verbOf(of.kind, arcs[index(p.arc)].kind(), arcs[index(p.next())].kind());
    if (!verb.empty()) text += (text.empty() ? "" : ", ") + motion.scene->bodies[index(p.body)].name + " " + verb;
  }
  return text;
}

}  // namespace carom
