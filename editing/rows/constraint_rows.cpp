// SPDX-License-Identifier: MIT
#include "editing/rows/constraint_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/scene/body_model.h"
#include "editing/rows/constraint_checks.h"
#include "editing/rows/relative.h"
#include "editing/text.h"

namespace carom {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Times of a span that are looked at for a start; what is chosen among them is only that.
constexpr int kLooks = 64;

std::string describeImpact(const When& at, const std::string& noun) {
  std::string text = noun + " " + std::to_string(at.impact);
  if (!at.with.empty()) text += " with '" + at.with + "'";
  return text;
}

double limitOf(const std::vector<double>& limits, int component, double none) {
  if (limits.empty()) return none;
  const double limit = limits[static_cast<std::size_t>(component)];
  return std::isnan(limit) ? none : limit;
}

/// Of a ball about the centre of mass that holds the whole body.
double boundingRadiusAboutCenter(const Body& body) {
  return kindOf(body.shape).boundingRadius(body.shape) + centerOfMass(body).norm();
}

}  // namespace

ConstraintSet::ConstraintSet(const Scene& scene, const std::vector<Constraint>& constraints, double duration)
    : body_count_(static_cast<int>(scene.bodies.size())), constraints_(constraints), bound_(constraints.size()) {
  for (std::size_t i = 0; i < constraints.size(); ++i) bind(scene, static_cast<int>(i), duration);
  for (int i = 0; i < size(); ++i) (rows_[i].isRange() ? ranges_ : equations_).push_back(i);
}

void ConstraintSet::bind(const Scene& scene, int index, double duration) {
  const Constraint& constraint = constraints_[index];
  const std::string where = "/constraints/" + std::to_string(index);
  Bound& bound = bound_[index];
  bound.body = findAt(where + "/body", [&] { return bodyIndex(scene, constraint.body); });
  const When& at = constraint.at;
  checkWhen(at, where + "/at");
  if (!at.with.empty()) bound.with = findAt(where + "/at/with", [&] { return bodyIndex(scene, at.with); });
  if (!constraint.relative_to.empty()) {
    bound.relative_to = findAt(where + "/relative_to", [&] { return bodyIndex(scene, constraint.relative_to); });
    if (bound.relative_to == bound.body) {
      throw InputError(where + "/relative_to", "found '" + constraint.body + "' itself, expected another body");
    }
  }
  if (at.span && !constraint.targets.empty()) {
    bound.free_time = static_cast<int>(free_times_.size());
    free_times_.push_back({index, at.span->first, at.span->second, naturalScales(scene, bound.body).time});
  }
  const std::size_t first_row = rows_.size();
  for (std::size_t t = 0; t < constraint.targets.size(); ++t) {
    bound.kinds.push_back(&checkedKind(constraint.targets[t], at, where));
    addTargetRows(scene, index, static_cast<int>(t));
  }
  for (std::size_t r = 0; r < constraint.regions.size(); ++r) {
    const Region& region = constraint.regions[r];
    checkRegion(region, where + (region.side == Region::Side::avoid ? "/avoid" : "/inside"));
    addRegionRows(scene, index, static_cast<int>(r), duration);
  }
  if (rows_.size() == first_row) throw InputError(where, "found no number to hold, expected at least one");
}

void ConstraintSet::addTargetRows(const Scene& scene, int index, int target_index) {
  const Target& target = constraints_[index].targets[target_index];
  const QuantityKind& kind = *bound_[index].kinds[target_index];
  const Vec3 wanted = kind.target(target);
  const NaturalScales scales = naturalScales(scene, bound_[index].body);
  for (int c = 0; c < kind.rows; ++c) {
    Row row;
    row.constraint = index, row.target = target_index, row.component = c;
    row.name = kind.word;
    if (kind.rows > 1) row.name += std::string(".") + "xyz"[c];
    row.wanted = row.lower = row.upper = wanted[c];
    if (std::isnan(wanted[c])) {
      row.lower = limitOf(target.min, c, -kInfinity), row.upper = limitOf(target.max, c, kInfinity);
      if (std::isinf(row.lower) && std::isinf(row.upper)) continue;  // left free
    }
    row.scale = kind.scale ? scales.*kind.scale : 1;
    rows_.push_back(std::move(row));
  }
}

void ConstraintSet::addRegionRows(const Scene& scene, int index, int region_index, double duration) {
  const Region& region = constraints_[index].regions[region_index];
  Bound& bound = bound_[index];
  const Body& body = scene.bodies[bound.body];
  if (body.fixed) {
    throw InputError("/constraints/" + std::to_string(index) + "/body",
                     "found the fixed body '" + body.name + "', expected a moving one to keep to a region");
  }
  BoundRegion of_body{region, 0, duration, 0};
  if (region.during) std::tie(of_body.from, of_body.to) = *region.during;
  of_body.margin = region.margin ? *region.margin : boundingRadiusAboutCenter(body);
  bound.regions.push_back(std::move(of_body));
  for (int c = 0; c < rowsOf(region); ++c) {
    Row row;
    row.constraint = index, row.target = -1, row.region = region_index, row.component = c;
    row.name = rowName(region, c);
    row.wanted = kNaN, row.lower = 0, row.upper = kInfinity;
    row.scale = naturalScales(scene, bound.body).length;
    rows_.push_back(std::move(row));
  }
}

ConstraintSet::Reading ConstraintSet::read(const Motion& motion, int index, double free_time) const {
  const Constraint& constraint = constraints_[index];
  const Bound& bound = bound_[index];
  if (constraint.at.impact > 0) {
    const std::optional<int> event = motion.findImpact(bound.body, constraint.at.impact, bound.with);
    if (event) return readAt(motion, index, Instant::before(*event), motion.events[*event].time);
    Reading reading;
    reading.message = describeImpact(constraint.at, "Impact") + " of '" + constraint.body + "' does not come within " +
                      number(motion.end) + " s.";
    return reading;
  }
  const double t = bound.free_time >= 0 ? free_time : constraint.at.time;
  if (t <= motion.end) return readAt(motion, index, Instant::at(t), t);
  Reading reading;
  reading.message = "The constraint on " + describeConstraint(index) + " lies after the end of the motion at " +
                    number(motion.end) + " s.";
  if (!motion.message.empty() && motion.status != MotionStatus::complete) reading.message += " " + motion.message;
  return reading;
}

ConstraintSet::Reading ConstraintSet::readAt(const Motion& motion, int index, const Instant& instant,
                                             double time) const {
  const Bound& bound = bound_[index];
  const auto stateOf = [&](int body) {
    return instant.event >= 0 ? motion.stateBefore(instant.event, body) : motion.stateAt(body, time);
  };
  Reading reading;
  reading.available = true;
  reading.instant = instant;
  reading.time = time;
  reading.seen = reading.own = stateOf(bound.body);
  if (bound.relative_to >= 0) {
    reading.other = stateOf(bound.relative_to);
    reading.seen = seenFrom(reading.own, reading.other);
  }
  return reading;
}

double ConstraintSet::residual(int row, double value) const {
  const Row& r = rows_[static_cast<std::size_t>(row)];
  if (!r.isRange()) return value - r.wanted;
  return value < r.lower ? value - r.lower : value > r.upper ? value - r.upper : value - value;  // NaN stays NaN
}

void ConstraintSet::readRow(int i, const Reading& reading, RowValues& out) const {
  const Row& row = rows_[i];
  const Bound& bound = bound_[row.constraint];
  const Target& target = constraints_[row.constraint].targets[row.target];
  const QuantityKind& kind = *bound.kinds[row.target];
  out.values[i] = kind.value(reading.seen, reading.time, target)[row.component];
  StateSeed seed = kind.seed(reading.seen, target, row.component);
  seed.body = bound.body;
  seed.at = reading.instant;
  if (bound.relative_to < 0) {
    out.seeds[i] = {std::move(seed)};
    return;
  }
  SeedPair pair = seenFromPullback(reading.own, reading.other, seed);
  pair.of_b.body = bound.relative_to;
  pair.of_b.at = reading.instant;
  out.seeds[i] = {std::move(pair.of_a), std::move(pair.of_b)};
}

std::optional<Clearance> ConstraintSet::clearance(const Motion& motion, int i) const {
  const Row& row = rows_[i];
  const Bound& bound = bound_[row.constraint];
  return leastClearance(motion, bound.body, bound.regions[row.region], row.component);
}

std::vector<StateSeed> ConstraintSet::seedRates(const Motion& motion, const Eigen::VectorXd& times, int i,
                                                std::span<const BodyStateRate> rates) const {
  const Row& row = rows_[i];
  if (row.region >= 0) {
    StateSeed seed;
    seed.center_of_mass = clearance(motion, i)->bend * rates[0].center_of_mass;
    return {seed};
  }
  const Bound& bound = bound_[row.constraint];
  const Target& target = constraints_[row.constraint].targets[row.target];
  const QuantityKind& kind = *bound.kinds[row.target];
  if (bound.relative_to < 0 && !kind.seed_rate) return {StateSeed()};
  const Reading reading = read(motion, row.constraint, bound.free_time >= 0 ? times[bound.free_time] : 0);
  const auto rateOf = [&](const BodyStateRate& of_seen) {
    return kind.seed_rate ? kind.seed_rate(reading.seen, of_seen, target, row.component) : StateSeed();
  };
  if (bound.relative_to < 0) return {rateOf(rates[0])};
  const StateSeed seed = kind.seed(reading.seen, target, row.component);
  const StateSeed dseed = rateOf(seenFromRate(reading.own, reading.other, rates[0], rates[1]));
  SeedPair pair = seenFromPullbackRate(reading.own, reading.other, rates[0], rates[1], seed, dseed);
  return {std::move(pair.of_a), std::move(pair.of_b)};
}

void ConstraintSet::readRegion(const Motion& motion, int i, RowValues& out) const {
  const Row& row = rows_[i];
  const Bound& bound = bound_[row.constraint];
  const BoundRegion& region = bound.regions[row.region];
  if (const std::optional<Clearance> clearance = this->clearance(motion, i)) {
    out.values[i] = clearance->value;
    out.seeds[i] = {clearance->seed};
    return;
  }
  out.available = false;
  if (!out.message.empty()) return;
  out.message = "The motion ends at " + number(motion.end) + " s, before " + number(region.to) + " s, up to which '" +
                constraints_[row.constraint].body + "' keeps to a region. " + motion.message;
}

RowValues ConstraintSet::evaluate(const Motion& motion, const Eigen::VectorXd& times) const {
  RowValues out;
  out.times = times;
  out.values = out.residuals = out.scaled = Eigen::VectorXd::Constant(size(), kNaN);
  out.seeds.resize(rows_.size());
  int current = -1;
  Reading reading;
  for (int i = 0; i < size(); ++i) {
    const Row& row = rows_[i];
    if (row.region >= 0) {
      readRegion(motion, i, out);
    } else {
      if (row.constraint != current) {
        current = row.constraint;
        const int free = bound_[current].free_time;
        reading = read(motion, current, free >= 0 ? times[free] : 0);
        if (!reading.available) {
          out.available = false;
          if (out.message.empty()) out.message = reading.message;
        }
      }
      if (reading.available) readRow(i, reading, out);
    }
    out.residuals[i] = residual(i, out.values[i]);
    out.scaled[i] = out.residuals[i] / row.scale;
  }
  return out;
}

/// Sum of the squares of the residuals of one constraint when it is read at a time.
double ConstraintSet::missAt(const Motion& motion, int index, double time) const {
  const Reading reading = readAt(motion, index, Instant::at(time), time);
  double sum = 0;
  for (int i = 0; i < size(); ++i) {
    const Row& row = rows_[i];
    if (row.constraint != index || row.region >= 0) continue;
    const Target& target = constraints_[index].targets[row.target];
    const double value = bound_[index].kinds[row.target]->value(reading.seen, time, target)[row.component];
    const double scaled = residual(i, value) / row.scale;
    sum += scaled * scaled;
  }
  return sum;
}

Eigen::VectorXd ConstraintSet::nearestTimes(const Motion& motion) const {
  Eigen::VectorXd times(static_cast<Eigen::Index>(free_times_.size()));
  for (std::size_t f = 0; f < free_times_.size(); ++f) {
    const FreeTime& free = free_times_[f];
    const double last = std::min(free.to, motion.end);
    double best = free.from, least = kInfinity;
    for (int k = 0; k <= kLooks && last >= free.from; ++k) {
      const double t = free.from + (last - free.from) * k / kLooks;
      const double miss = missAt(motion, free.constraint, t);
      if (miss < least) least = miss, best = t;
    }
    times[static_cast<Eigen::Index>(f)] = best;
  }
  return times;
}

double ConstraintSet::horizon(double duration) const {
  double last = 0;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const When& at = constraints_[i].at;
    if (!constraints_[i].targets.empty()) {
      if (at.impact > 0) return duration;
      last = std::max(last, at.span ? at.span->second : at.time);
    }
    for (const BoundRegion& region : bound_[i].regions) last = std::max(last, region.to);
  }
  return last > 0 ? std::min(last, duration) : duration;
}

ConstraintSet::Extent ConstraintSet::extentIn(const Motion& motion, const Eigen::VectorXd& times) const {
  Extent extent;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const When& at = constraints_[i].at;
    for (const BoundRegion& region : bound_[i].regions)
      extent.time = std::max(extent.time, std::min(region.to, motion.end));
    if (constraints_[i].targets.empty()) continue;
    const int free = bound_[i].free_time;
    if (at.span) {
      extent.time = std::max(extent.time, free < times.size() ? times[free] : at.span->second);
    } else if (at.impact == 0) {
      extent.time = std::max(extent.time, at.time);
    } else if (const auto event = motion.findImpact(bound_[i].body, at.impact, bound_[i].with)) {
      extent.time = std::max(extent.time, motion.events[*event].time);
    }
  }
  while (extent.events < motion.events.size() && motion.events[extent.events].time <= extent.time) ++extent.events;
  return extent;
}

std::vector<bool> ConstraintSet::asksOrientation() const {
  std::vector<bool> asks(static_cast<std::size_t>(body_count_), false);
  for (const Bound& bound : bound_) {
    for (const QuantityKind* kind : bound.kinds) {
      if (kind->turns) asks[static_cast<std::size_t>(bound.body)] = true;
    }
    if (bound.relative_to >= 0) asks[static_cast<std::size_t>(bound.relative_to)] = true;
  }
  return asks;
}

void ConstraintSet::setTarget(int index, int target_index, const std::vector<double>& value) {
  Target& target = constraints_[index].targets[target_index];
  Target moved = target;
  moved.value = value;
  const QuantityKind& kind = checkedKind(moved, constraints_[index].at, "/constraints/" + std::to_string(index));
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (std::isnan(value[k]) == std::isnan(target.value[k])) continue;
    throw InputError("/constraints/" + std::to_string(index) + "/" + target.quantity,
                     "found other components free than before, expected the same ones");
  }
  target = std::move(moved);
  const Vec3 wanted = kind.target(target);
  for (Row& row : rows_) {
    if (row.constraint != index || row.target != target_index || row.isRange()) continue;
    row.wanted = row.lower = row.upper = wanted[row.component];
  }
}

std::string ConstraintSet::describeConstraint(int index) const {
  const Constraint& constraint = constraints_[index];
  const When& at = constraint.at;
  std::string text = "'" + constraint.body + "'";
  if (!constraint.relative_to.empty()) text += " seen from '" + constraint.relative_to + "'";
  if (constraint.targets.empty()) return text;
  if (at.span) return text + " between " + number(at.span->first) + " s and " + number(at.span->second) + " s";
  return text + " at " + (at.impact == 0 ? number(at.time) + " s" : describeImpact(at, "its impact"));
}

std::string ConstraintSet::describeRow(int row) const {
  const Row& r = rows_[row];
  if (r.region < 0) return r.name + " of " + describeConstraint(r.constraint);
  const BoundRegion& region = bound_[r.constraint].regions[r.region];
  return r.name + " of '" + constraints_[r.constraint].body + "' from " + number(region.from) + " s to " +
         number(region.to) + " s";
}

}  // namespace carom
