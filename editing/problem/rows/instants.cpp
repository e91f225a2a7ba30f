// SPDX-License-Identifier: MIT
#include "editing/problem/rows/instants.hpp"

#include "adjoint/base/errors.h"

namespace carom::editing_detail {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Where a motion ends before its time, what follows its last events is not known.
bool isKnownAfter(const Motion& motion, int event) {
  return motion.status == MotionStatus::complete || motion.events[index(event)].time < motion.end;
}

}  // namespace

std::optional<Instant> findRest(const Motion& motion, int body) {
  if (!motion.has_events) throw InputError("found a motion whose events were not recorded, expected one with them");
  const WorldLine& line = motion.world_lines[index(body)];
  std::size_t first = line.arcs.size();
  while (first > 0 && line.arcs[first - 1].kind() == ArcKind::rest) --first;
  if (first == line.arcs.size()) return std::nullopt;
  if (first == 0) return Instant::at(0);
  const int event = line.events[first - 1];
  return isKnownAfter(motion, event) ? std::optional(Instant::after(event)) : std::nullopt;
}

std::optional<Instant> findInstant(const Motion& motion, int body, const When& at, int with) {
  if (at.span) return std::nullopt;
  if (at.rest) return findRest(motion, body);
  if (at.impact == 0) return at.time <= motion.end ? std::optional(Instant::at(at.time)) : std::nullopt;
  const std::optional<int> event = motion.findImpact(body, at.impact, with);
  return event ? std::optional(Instant::before(*event)) : std::nullopt;
}

std::optional<Instant> findInstant(const Motion& motion, int body, const When& at) {
  return findInstant(motion, body, at, at.with.empty() ? -1 : bodyIndex(*motion.scene, at.with));
}

double timeOf(const Motion& motion, const Instant& instant) {
  return instant.event >= 0 ? motion.events[index(instant.event)].time : double(instant.time);
}

BodyState stateAt(const Motion& motion, int body, const Instant& instant) {
  if (instant.event < 0) return motion.stateAt(body, instant.time);
  return instant.follows ? motion.stateAfter(instant.event, body) : motion.stateBefore(instant.event, body);
}

}  // namespace carom::editing_detail
