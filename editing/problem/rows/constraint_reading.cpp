// SPDX-License-Identifier: MIT
// What the rows of constraints are in a motion.
#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/derivative/seed.hpp"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/closest_approach.hpp"
#include "editing/problem/rows/constraint_checks.hpp"
#include "editing/problem/rows/constraint_rows.hpp"
#include "editing/problem/rows/instants.hpp"
#include "editing/problem/rows/relative.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

constexpr double kNotRead = std::numeric_limits<double>::quiet_NaN();
/// Times of a span that are looked at for a start; what is chosen among them is only that.
constexpr int kLooks = 64;

}  // namespace

ConstraintSet::Reading ConstraintSet::read(const Motion& motion, int index, double free_time) const {
  const Constraint& constraint = constraints_[index];
  const Bound& bound = bound_[index];
  if (waitsForEvent(index)) {
    const std::optional<Instant> instant = awaited(motion, index);
    return instant ? readAt(motion, index, *instant) : Reading();
  }
  const double t = bound.free_time >= 0 ? free_time : double(constraint.at.time);
  if (t <= motion.end) return readAt(motion, index, Instant::at(t));
  Reading reading;
  reading.message = "The constraint on " + describeConstraint(index) + " lies after the end of the motion at " +
                    number(motion.end) + " s.";
  if (!motion.message.empty() && motion.status != MotionStatus::complete) reading.message += " " + motion.message;
  return reading;
}

ConstraintSet::Reading ConstraintSet::readAt(const Motion& motion, int index, const Instant& instant) const {
  const Bound& bound = bound_[index];
  Reading reading;
  reading.available = true;
  reading.motion = &motion;
  reading.instant = instant;
  reading.time = timeOf(motion, instant);
  reading.seen = reading.own = stateAt(motion, bound.body, instant);
  if (bound.relative_to >= 0) {
    reading.other = stateAt(motion, bound.relative_to, instant);
    reading.seen = seenFrom(reading.own, reading.other);
  }
  return reading;
}

double ConstraintSet::residual(int row, double value) const {
  const Row& r = rows_[static_cast<std::size_t>(row)];
  if (!r.isRange()) return value - r.target;
  return value < r.lower ? value - r.lower : value > r.upper ? value - r.upper : value - value;  // NaN stays NaN
}

const Target& ConstraintSet::targetOf(const Row& row) const {
  static const Target none;  // of the time of a hit
  return row.target_index < 0 ? none : constraints_[row.constraint].targets[row.target_index];
}

void ConstraintSet::readRow(int i, const Reading& reading, RowValues& out) const {
  const Row& row = rows_[i];
  const Bound& bound = bound_[row.constraint];
  const Target& target = targetOf(row);
  const QuantityKind& kind = *row.kind;
  if (kind.read) return putReading(i, readMotionQuantity(reading, i), out);
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

RowReading ConstraintSet::readMotionQuantity(const Reading& reading, int i) const {
  const Row& row = rows_[i];
  const Bound& bound = bound_[row.constraint];
  QuantityPlace place{*reading.motion, bound.body, bound.relative_to, reading.instant, reading.time, row.scale};
  if (row.target_index >= 0) place.to = bound.to[row.target_index];
  place.component = row.component, place.with = bound.with;
  return row.kind->read(place);
}

RowReading ConstraintSet::readOverSpan(const Motion& motion, int i) const {
  const Row& row = rows_[i];
  const Bound& bound = bound_[row.constraint];
  const auto [from, until] = bound.during[row.target_index];
  return row.kind->read({motion, bound.body, -1, {}, from, row.scale, bound.to[row.target_index], from, until});
}

Eigen::VectorXd ConstraintSet::timeRate(DerivativeTape& tape, int i, std::span<const ReadingDirection> controls) const {
  const Row& row = rows_[i];
  if (row.region >= 0 && regionOf(i).region.keep == Region::Keep::shape) {
    const auto of_shape = clearanceOfShape(tape.motion(), i);
    return of_shape->time_rate ? of_shape->time_rate(tape, controls) : Eigen::VectorXd();
  }
  if (row.region >= 0) return clearanceTimeRate(*clearance(tape.motion(), i), tape, controls);
  if (!row.overSpan()) return {};
  const Bound& bound = bound_[row.constraint];
  const auto [from, until] = bound.during[row.target_index];
  return closestApproach(tape.motion(), bound.body, bound.to[row.target_index], from, until)->timeRate(tape, controls);
}

void ConstraintSet::readObjective(const Motion& motion, RowValues& out) const {
  out.objective = objective_->read(motion);
  std::string why = out.objective->missing;
  if (why.empty() && out.objective->seeds.empty()) why = sentence(out.objective->doubt);
  if (why.empty()) return;
  out.available = false;
  if (out.message.empty()) out.message = why;
  out.objective.reset();
}

// Where a number that is not what it shall be has no derivative, nothing leads on from there.
void ConstraintSet::putReading(int i, RowReading reading, RowValues& out) const {
  if (!reading.missing.empty()) {
    out.available = false;
    if (out.message.empty()) out.message = reading.missing;
    return;
  }
  out.values[i] = reading.value;
  const bool undefined = reading.seeds.empty();
  if (undefined && !(residual(i, reading.value) == 0)) {
    out.available = false;
    if (out.message.empty()) out.message = sentence(reading.doubt);
  }
  if (undefined) {  // what is within its range needs none
    StateSeed& none = reading.seeds.emplace_back();
    none.body = rows_[i].own < 0 ? bound_[rows_[i].constraint].body : 0;
    none.at = Instant::at(0);
  }
  out.seeds[i] = std::move(reading.seeds);
  out.notes[i] = {std::move(reading.doubt), reading.second_order, std::move(reading.seed_rates)};
}

const BoundRegion& ConstraintSet::regionOf(int i) const {
  return bound_[rows_[i].constraint].regions[rows_[i].region];
}

std::optional<Clearance> ConstraintSet::clearance(const Motion& motion, int i) const {
  const Row& row = rows_[i];
  return leastClearance(motion, bound_[row.constraint].body, regionOf(i), row.component);
}

std::optional<ShapeClearance> ConstraintSet::clearanceOfShape(const Motion& motion, int i) const {
  const Row& row = rows_[i];
  return shapeClearance(motion, bound_[row.constraint].body, regionOf(i), row.component);
}

std::optional<double> ConstraintSet::timeOfClearance(const Motion& motion, int i) const {
  if (regionOf(i).region.keep == Region::Keep::shape) {
    const auto of_shape = clearanceOfShape(motion, i);
    return of_shape ? std::optional(of_shape->time) : std::nullopt;
  }
  const auto of_ball = clearance(motion, i);
  return of_ball ? std::optional(of_ball->time) : std::nullopt;
}

std::vector<StateSeed> ConstraintSet::seedRates(const Motion& motion, const Eigen::VectorXd& times, int i,
                                                std::span<const BodyStateRate> rates) const {
  const Row& row = rows_[i];
  if (row.region >= 0) {
    StateSeed seed;
    seed.center_of_mass = clearance(motion, i)->bend * rates[0].center_of_mass;
    return {seed};
  }
  if (!row.kind || row.kind->read) return std::vector<StateSeed>(rates.size());  // theirs are noted, or constant
  const Bound& bound = bound_[row.constraint];
  const Target& target = targetOf(row);
  const QuantityKind& kind = *row.kind;
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
  const BoundRegion& region = regionOf(i);
  if (region.region.keep == Region::Keep::shape) {
    if (auto of_shape = clearanceOfShape(motion, i)) return putReading(i, std::move(of_shape->reading), out);
  } else if (const std::optional<Clearance> clearance = this->clearance(motion, i)) {
    out.values[i] = clearance->value;
    out.seeds[i] = {clearance->seed};
    return;
  }
  out.available = false;
  if (!out.message.empty()) return;
  out.message = "The motion ends at " + number(motion.end) + " s, before " + number(region.to) + " s, up to which '" +
                constraints_[row.constraint].body + "' keeps to a region. " + motion.message;
}

RowValues ConstraintSet::unread() const {
  RowValues out;
  out.values = out.residuals = out.scaled = Eigen::VectorXd::Constant(size(), kNotRead);
  out.seeds.resize(rows_.size());
  out.notes.resize(rows_.size());
  return out;
}

RowValues ConstraintSet::evaluate(const Motion& motion, const Eigen::VectorXd& times) const {
  RowValues out = evaluateWith(motion, [&](int constraint) {
    const int free = bound_[static_cast<std::size_t>(constraint)].free_time;
    return read(motion, constraint, free >= 0 ? times[free] : 0);
  });
  out.times = times;
  return out;
}

RowValues ConstraintSet::evaluate(const Motion& motion, std::span<const Instant> instants) const {
  RowValues out = evaluateWith(motion, [&](int constraint) {
    const int free = bound_[static_cast<std::size_t>(constraint)].free_time;
    const Instant at = free >= 0 ? instants[static_cast<std::size_t>(free)] : Instant();
    return at.event >= 0 ? readAt(motion, constraint, at) : read(motion, constraint, at.time);
  });
  out.times.resize(static_cast<Eigen::Index>(instants.size()));
  for (std::size_t k = 0; k < instants.size(); ++k) out.times[static_cast<Eigen::Index>(k)] = timeOf(motion, instants[k]);
  return out;
}

RowValues ConstraintSet::evaluateWith(const Motion& motion, const std::function<Reading(int)>& read_constraint) const {
  RowValues out = unread();
  for (std::size_t k = 0; k < constraints_.size(); ++k) {
    const int index = static_cast<int>(k);
    if (!waitsForEvent(index) || awaited(motion, index)) continue;
    out.available = false;
    out.lacking.push_back(lacking(motion, index));
    out.lacking.back().constraint = index;
    if (out.message.empty()) out.message = out.lacking.back().sentence;
  }
  int current = -1;
  Reading reading;
  for (int i = 0; i < size(); ++i) {
    const Row& row = rows_[i];
    if (row.own >= 0) {
      putReading(i, own_[static_cast<std::size_t>(row.own)].read(motion), out);
    } else if (row.region >= 0) {
      readRegion(motion, i, out);
    } else if (row.overSpan()) {
      putReading(i, readOverSpan(motion, i), out);
    } else {
      if (row.constraint != current) {
        current = row.constraint;
        reading = read_constraint(current);
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
  if (objective_) readObjective(motion, out);
  return out;
}

/// Sum of the squares of the residuals of one constraint when it is read at a time.
double ConstraintSet::missAt(const Motion& motion, int index, double time) const {
  const Reading reading = readAt(motion, index, Instant::at(time));
  double sum = 0;
  for (int i = 0; i < size(); ++i) {
    const Row& row = rows_[i];
    if (row.constraint != index || row.overSpan()) continue;
    const Target& target = targetOf(row);
    const double value = row.kind->read ? readMotionQuantity(reading, i).value
                                        : row.kind->value(reading.seen, time, target)[row.component];
    const double scaled = residual(i, value) / row.scale;
    sum += scaled * scaled;
  }
  return sum;
}

ValueInTime ConstraintSet::missInTime(const Motion& motion, int index, double time) const {
  const Reading reading = readAt(motion, index, Instant::at(time));
  RowValues rows = unread();
  ValueInTime miss{time, 0, 0};
  for (int i = 0; i < size(); ++i) {
    const Row& row = rows_[i];
    if (row.constraint != index || row.overSpan()) continue;
    readRow(i, reading, rows);
    const double scaled = residual(i, rows.values[i]) / row.scale;
    miss.value += 0.5 * scaled * scaled;
    for (const StateSeed& seed : rows.seeds[i]) miss.rate += scaled / row.scale * timeDerivative(motion, seed);
  }
  return miss;
}

std::vector<int> ConstraintSet::bodiesRead(int index) const {
  const Bound& bound = bound_[index];
  std::vector<int> bodies{bound.body};
  if (bound.relative_to >= 0) bodies.push_back(bound.relative_to);
  for (const int other : bound.to)
    if (other >= 0) bodies.push_back(other);
  return bodies;
}

std::vector<ConstrainedTime> ConstraintSet::constrainedTimes(const Motion& motion, const Eigen::VectorXd& times) const {
  std::vector<ConstrainedTime> found;
  for (std::size_t k = 0; k < constraints_.size(); ++k) {
    const int index = static_cast<int>(k), free = bound_[k].free_time;
    if (free >= 0) {
      const FreeTime& span = free_times_[static_cast<std::size_t>(free)];
      found.push_back({index, span.from, span.to, times[free]});
    } else if (constraints_[k].at.rest && bound_[k].at_instant) {
      if (const auto rest = awaited(motion, index)) found.push_back({index, 0, motion.end, timeOf(motion, *rest)});
    }
  }
  return found;
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

}  // namespace carom::editing_detail
