// SPDX-License-Identifier: MIT
// What constraints wait for in a motion, and how far it counts for them.
#include <algorithm>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/constraint_checks.hpp"
#include "editing/problem/rows/constraint_rows.hpp"
#include "editing/problem/rows/instants.hpp"

namespace carom::editing_detail {
namespace {

/// The slower a body is where its motion ends, the more of its coming to rest is done; never all of it.
double shareOfRest(const Motion& motion, int body) {
  if (motion.world_lines[static_cast<std::size_t>(body)].arcs.empty()) return 0;  // it never began
  const NaturalScales scales = naturalScales(*motion.scene, body);
  const BodyState last = motion.stateAt(body, motion.end);
  return 1 / (2 + last.velocity.norm() / scales.velocity + last.angular_velocity.norm() / scales.angular_velocity);
}

}  // namespace

void ConstraintSet::bindImpacts(const Scene& scene, int index, const std::string& where) {
  Constraint& constraint = constraints_[index];
  Bound& bound = bound_[index];
  const bool holds_more = !constraint.targets.empty() || !constraint.regions.empty();
  if (constraint.hits && holds_more)
    throw InputError(where + "/hits", "found other targets beside it, expected a constraint of its own");
  if (!constraint.sequence.empty()) {
    if (constraint.hits || holds_more)
      throw InputError(where + "/sequence", "found other targets beside it, expected a constraint of its own");
    bound.sequence.emplace(scene, constraint.sequence, where + "/sequence");
    constraint.body = scene.bodies[bound.sequence->body()].name;
  }
  if (!constraint.hits) return;
  bound.hit.emplace(scene, constraint.body, *constraint.hits, where);
  constraint.at = nthImpact(1, constraint.hits->with);
  if (!bound.hit->hasSpan()) return;
  Row row;
  row.constraint = index, row.target_index = -1;
  row.kind = findQuantityKind("time");
  row.name = row.kind->word;
  row.target = std::numeric_limits<double>::quiet_NaN();
  row.lower = bound.hit->from(), row.upper = bound.hit->to();
  row.scale = naturalScales(scene, bodyIndex(scene, constraint.body)).time;
  rows_.push_back(std::move(row));
}

bool ConstraintSet::waitsForEvent(int index) const {
  const Bound& bound = bound_[index];
  const When& at = constraints_[index].at;
  return bound.hit || bound.sequence || ((at.impact > 0 || at.rest) && bound.at_instant);
}

std::optional<Instant> ConstraintSet::awaited(const Motion& motion, int index) const {
  const Bound& bound = bound_[index];
  if (!bound.sequence && !bound.hit) return findInstant(motion, bound.body, constraints_[index].at, bound.with);
  const std::optional<int> event = bound.sequence ? bound.sequence->find(motion) : bound.hit->find(motion);
  return event ? std::optional(Instant::before(*event)) : std::nullopt;
}

std::optional<double> ConstraintSet::timeOfAwaited(const Motion& motion, int index) const {
  const std::optional<Instant> instant = awaited(motion, index);
  return instant ? std::optional(timeOf(motion, *instant)) : std::nullopt;
}

bool ConstraintSet::hasAllAwaited(const Motion& motion) const {
  for (int i = 0; i < static_cast<int>(constraints_.size()); ++i)
    if (waitsForEvent(i) && !awaited(motion, i)) return false;
  return true;
}

LackingImpact ConstraintSet::lacking(const Motion& motion, int index) const {
  const Bound& bound = bound_[index];
  if (bound.sequence) return bound.sequence->lacking(motion);
  if (bound.hit) return bound.hit->lacking(motion);
  const When& at = constraints_[index].at;
  LackingImpact lacking;
  lacking.sentence = describeLack(at, constraints_[index].body) + " within " + number(motion.end) + " s.";
  lacking.to = motion.end;
  if (at.rest) {
    lacking.share = shareOfRest(motion, bound.body);
    if (motion.status != MotionStatus::complete) lacking.sentence += " " + sentence(motion.message);
    return lacking;
  }
  int last = 0;
  while (const std::optional<int> event = motion.findImpact(bound.body, last + 1, bound.with)) {
    lacking.from = motion.events[*event].time;
    ++last;
  }
  lacking.share = static_cast<double>(last) / at.impact;
  if (bound.with >= 0) lacking.pairs = {{bound.body, bound.with}};
  return lacking;
}

bool ConstraintSet::waits() const {
  const auto own_waits = [](const BoundFunction& own) { return own.waits(); };
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (waitsForEvent(static_cast<int>(i))) return true;
  return std::any_of(own_.begin(), own_.end(), own_waits) || (objective_ && objective_->waits());
}

bool ConstraintSet::holdsAtRest() const {
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (constraints_[i].at.rest && bound_[i].at_instant) return true;
  const auto own = [](const BoundFunction& f) { return f.function.until && f.function.until->rest; };
  return std::any_of(own_.begin(), own_.end(), own) || (objective_ && own(*objective_));
}

bool ConstraintSet::hasWhatItWaitsFor(const Motion& motion) const {
  if (holdsAtRest()) return false;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const int index = static_cast<int>(i);
    if (!waitsForEvent(index)) continue;
    if (bound_[i].hit ? !bound_[i].hit->isSettled(motion) : !awaited(motion, index)) return false;
  }
  const auto has = [&](const BoundFunction& own) {
    return !own.waits() || own.awaited(motion).has_value();
  };
  return std::all_of(own_.begin(), own_.end(), has) && (!objective_ || has(*objective_));
}

double ConstraintSet::leastDuration() const {
  double last = 0;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const When& at = constraints_[i].at;
    const Bound& bound = bound_[i];
    if (bound.at_instant && at.impact == 0 && !at.rest)
      last = std::max<double>(last, at.span ? at.span->second : at.time);
    for (std::size_t t = 0; t < bound.kinds.size(); ++t)
      if (bound.kinds[t]->over_span) last = std::max(last, bound.during[t].second);
    for (const BoundRegion& region : bound.regions) last = std::max(last, region.to);
  }
  for (const BoundFunction& own : own_)
    if (!own.waits()) last = std::max(last, own.end);
  if (objective_ && !objective_->waits()) last = std::max(last, objective_->end);
  return last;
}

double ConstraintSet::horizon(double duration) const {
  const double last = leastDuration();
  return !waits() && last > 0 ? std::min(last, duration) : duration;
}

ConstraintSet::Extent ConstraintSet::extentIn(const Motion& motion, const Eigen::VectorXd& times) const {
  Extent extent;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const When& at = constraints_[i].at;
    for (const BoundRegion& region : bound_[i].regions)
      extent.time = std::max(extent.time, std::min(region.to, motion.end));
    for (std::size_t t = 0; t < bound_[i].kinds.size(); ++t)
      if (bound_[i].kinds[t]->over_span)
        extent.time = std::max(extent.time, std::min(bound_[i].during[t].second, motion.end));
    if (waitsForEvent(static_cast<int>(i))) {
      if (const auto instant = awaited(motion, static_cast<int>(i)))
        extent.time = std::max(extent.time, timeOf(motion, *instant));
      continue;
    }
    if (!bound_[i].at_instant) continue;
    const int free = bound_[i].free_time;
    if (at.span) {
      extent.time = std::max(extent.time, free < times.size() ? times[free] : double(at.span->second));
    } else {
      extent.time = std::max<double>(extent.time, at.time);
    }
  }
  for (const BoundFunction& own : own_) extent.time = std::max(extent.time, own.extentIn(motion));
  if (objective_) extent.time = std::max(extent.time, objective_->extentIn(motion));
  while (extent.events < motion.events.size() && motion.events[extent.events].time <= extent.time) ++extent.events;
  return extent;
}

}  // namespace carom::editing_detail
