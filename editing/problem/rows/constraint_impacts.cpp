// SPDX-License-Identifier: MIT
// What constraints wait for in a motion, and how far it counts for them.
#include <algorithm>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/constraint_checks.hpp"
#include "editing/problem/rows/constraint_rows.hpp"

namespace carom::editing_detail {

void ConstraintSet::bindImpacts(const Scene& scene, int index, const std::string& where) {
  Constraint& constraint = constraints_[index];
  Bound& bound = bound_[index];
  const bool holds_more = !constraint.targets.empty() || !constraint.regions.empty();
  if (constraint.hits && holds_more)
    throw InputError(where + "/hits", "found other things to hold beside it, expected a constraint of its own");
  if (!constraint.sequence.empty()) {
    if (constraint.hits || holds_more)
      throw InputError(where + "/sequence", "found other things to hold beside it, expected a constraint of its own");
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

bool ConstraintSet::waitsForImpact(int index) const {
  const Bound& bound = bound_[index];
  return bound.hit || bound.sequence || (constraints_[index].at.impact > 0 && bound.at_instant);
}

std::optional<int> ConstraintSet::awaited(const Motion& motion, int index) const {
  const Bound& bound = bound_[index];
  if (bound.sequence) return bound.sequence->find(motion);
  if (bound.hit) return bound.hit->find(motion);
  return motion.findImpact(bound.body, constraints_[index].at.impact, bound.with);
}

LackingImpact ConstraintSet::lacking(const Motion& motion, int index) const {
  const Bound& bound = bound_[index];
  if (bound.sequence) return bound.sequence->lacking(motion);
  if (bound.hit) return bound.hit->lacking(motion);
  const When& at = constraints_[index].at;
  LackingImpact lacking;
  lacking.sentence = describeImpact(at, "Impact") + " of '" + constraints_[index].body + "' does not come within " +
                     number(motion.end) + " s.";
  lacking.to = motion.end;
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
    if (waitsForImpact(static_cast<int>(i))) return true;
  return std::any_of(own_.begin(), own_.end(), own_waits) || (objective_ && objective_->waits());
}

bool ConstraintSet::hasWhatItWaitsFor(const Motion& motion) const {
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const int index = static_cast<int>(i);
    if (!waitsForImpact(index)) continue;
    if (bound_[i].hit ? !bound_[i].hit->isSettled(motion) : !awaited(motion, index)) return false;
  }
  const auto has = [&](const BoundFunction& own) {
    return !own.waits() || motion.findImpact(own.body, own.function.until->impact, own.with);
  };
  return std::all_of(own_.begin(), own_.end(), has) && (!objective_ || has(*objective_));
}

double ConstraintSet::leastDuration() const {
  double last = 0;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const When& at = constraints_[i].at;
    const Bound& bound = bound_[i];
    if (bound.at_instant && at.impact == 0) last = std::max(last, at.span ? at.span->second : at.time);
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
    if (waitsForImpact(static_cast<int>(i))) {
      if (const auto event = awaited(motion, static_cast<int>(i)))
        extent.time = std::max(extent.time, motion.events[*event].time);
      continue;
    }
    if (!bound_[i].at_instant) continue;
    const int free = bound_[i].free_time;
    if (at.span) {
      extent.time = std::max(extent.time, free < times.size() ? times[free] : at.span->second);
    } else {
      extent.time = std::max(extent.time, at.time);
    }
  }
  for (const BoundFunction& own : own_) extent.time = std::max(extent.time, own.extentIn(motion));
  if (objective_) extent.time = std::max(extent.time, objective_->extentIn(motion));
  while (extent.events < motion.events.size() && motion.events[extent.events].time <= extent.time) ++extent.events;
  return extent;
}

}  // namespace carom::editing_detail
