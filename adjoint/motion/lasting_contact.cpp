// SPDX-License-Identifier: MIT
#include "adjoint/motion/lasting_contact.h"

#include <algorithm>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"

namespace carom {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// What a body is in contact with on the arc that begins with an event, which lists it: times and kind are left open.
std::vector<LastingContact> startedBy(const Event& event, int body) {
  std::vector<LastingContact> started;
  for (const Contact& c : event.contacts) {
    if (!c.lasts || (c.a != body && c.b != body)) continue;
    const int with = c.a == body ? c.b : c.a;
    auto known = std::ranges::find(started, with, &LastingContact::with);
    if (known == started.end()) known = started.insert(known, {body, with, ArcKind::rest, {}, 0, 0});
    known->features.push_back(c.features);
  }
  return started;
}

bool goesOn(const LastingContact& before, const LastingContact& after) {
  return before.with == after.with && before.kind == after.kind && before.to == after.from &&
         std::ranges::is_permutation(before.features, after.features);
}

void addOf(const Motion& motion, int body, std::vector<LastingContact>& found) {
  const WorldLine& line = motion.world_lines[index(body)];
  std::vector<LastingContact> own;
  for (std::size_t k = 1; k < line.arcs.size(); ++k) {
    if (line.arcs[k].kind() == ArcKind::flight) continue;
    const Event& event = motion.events[index(line.events[k - 1])];
    const double to = k < line.events.size() ? motion.events[index(line.events[k])].time : motion.end;
    if (!(event.time < to)) continue;
    for (LastingContact& c : startedBy(event, body)) {
      c.kind = line.arcs[k].kind(), c.from = event.time, c.to = to;
      const auto before = std::ranges::find_if(own, [&](const LastingContact& b) { return goesOn(b, c); });
      if (before == own.end())
        own.push_back(std::move(c));
      else
        before->to = to;
    }
  }
  found.insert(found.end(), own.begin(), own.end());
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
  }
  return "";
}

}  // namespace

std::vector<LastingContact> lastingContacts(const Motion& motion) {
  if (!motion.has_events) throw InputError("found a motion whose events were not recorded, expected one with them");
  std::vector<LastingContact> found;
  for (std::size_t b = 0; b < motion.world_lines.size(); ++b) addOf(motion, static_cast<int>(b), found);
  std::ranges::stable_sort(found, {}, &LastingContact::from);
  return found;
}

std::string describeChanges(const Motion& motion, int event) {
  using adjoint_detail::checkedIndex;
  const Event& of = motion.events[checkedIndex("describeChanges", "event", event, motion.events.size())];
  std::string text;
  if (of.time == motion.end && motion.status != MotionStatus::complete) return text;  // what comes next is not known
  for (const Participant& p : of.participants) {
    const std::vector<Arc>& arcs = motion.world_lines[index(p.body)].arcs;
    const std::string verb = verbOf(of.kind, arcs[index(p.arc)].kind(), arcs[index(p.next())].kind());
    if (!verb.empty()) text += (text.empty() ? "" : ", ") + motion.scene->bodies[index(p.body)].name + " " + verb;
  }
  return text;
}

}  // namespace carom
