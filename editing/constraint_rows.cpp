#include "editing/constraint_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/errors.h"
#include "editing/text.h"

namespace carom {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string allWords() {
  std::vector<std::string> words;
  for (const QuantityKind* kind : quantityKinds()) words.push_back(kind->word);
  return listOf(words);
}

void checkNumbers(const Target& target, const QuantityKind& kind, const std::string& where) {
  if (static_cast<int>(target.value.size()) != kind.numbers) {
    throw InputError(
        where, "found " + std::to_string(target.value.size()) + " numbers, expected " + std::to_string(kind.numbers));
  }
  for (double value : target.value) {
    if (std::isinf(value)) throw InputError(where, "found an infinite number, expected a finite one");
    if (kind.all_or_nothing && std::isnan(value)) {
      throw InputError(where, "found NaN, expected a number: a component of this cannot be left free");
    }
  }
  if (!target.body_point.allFinite()) {
    throw InputError(where, "found a body point that is not finite, expected three numbers");
  }
  if (kind.numbers == 4) {
    double norm2 = 0;
    for (double value : target.value) norm2 += value * value;
    if (!(std::abs(norm2 - 1) <= 1e-3)) {
      throw InputError(where, "found a quaternion of length " + number(std::sqrt(norm2)) + ", expected 1");
    }
  }
}

std::string describeImpact(const When& at, const std::string& noun) {
  std::string text = noun + " " + std::to_string(at.impact);
  if (!at.with.empty()) text += " with '" + at.with + "'";
  return text;
}

}  // namespace

ConstraintSet::ConstraintSet(const Scene& scene, const std::vector<Constraint>& constraints)
    : body_count_(static_cast<int>(scene.bodies.size())), constraints_(constraints), bound_(constraints.size()) {
  for (std::size_t i = 0; i < constraints.size(); ++i) bind(scene, static_cast<int>(i));
}

void ConstraintSet::bind(const Scene& scene, int index) {
  const Constraint& constraint = constraints_[index];
  const std::string where = "/constraints/" + std::to_string(index);
  Bound& bound = bound_[index];
  bound.body = findAt(where + "/body", [&] { return bodyIndex(scene, constraint.body); });
  const When& at = constraint.at;
  if (at.impact < 0 || (at.impact == 0 && !at.with.empty())) {
    throw InputError(where + "/at/impact", "found " + std::to_string(at.impact) + ", expected 1 or more");
  }
  if (at.impact == 0 && !(std::isfinite(at.time) && at.time >= 0)) {
    throw InputError(where + "/at", "found " + number(at.time) + ", expected a time of 0 s or later");
  }
  if (!at.with.empty()) bound.with = findAt(where + "/at/with", [&] { return bodyIndex(scene, at.with); });

  const std::size_t first_row = rows_.size();
  for (std::size_t t = 0; t < constraint.targets.size(); ++t) {
    const Target& target = constraint.targets[t];
    const QuantityKind* kind = findQuantityKind(target.quantity);
    if (!kind) throw InputError(where, "found '" + target.quantity + "', expected one of " + allWords());
    const std::string place = where + "/" + target.quantity;
    checkNumbers(target, *kind, place);
    if (kind->only_at_impacts && at.impact == 0) {
      throw InputError(place, std::string("found ") + kind->word + " held at a time, expected an impact");
    }
    bound.kinds.push_back(kind);
    addRows(scene, index, static_cast<int>(t));
  }
  if (rows_.size() == first_row) throw InputError(where, "found no number to hold, expected at least one");
}

void ConstraintSet::addRows(const Scene& scene, int index, int target_index) {
  const Target& target = constraints_[index].targets[target_index];
  const QuantityKind& kind = *bound_[index].kinds[target_index];
  const Vec3 wanted = kind.target(target);
  const NaturalScales scales = naturalScales(scene, bound_[index].body);
  for (int c = 0; c < kind.rows; ++c) {
    if (std::isnan(wanted[c])) continue;  // left free
    Row row;
    row.constraint = index, row.target = target_index, row.component = c;
    row.name = kind.word;
    if (kind.rows > 1) row.name += std::string(".") + "xyz"[c];
    row.wanted = wanted[c];
    row.scale = kind.scale ? scales.*kind.scale : 1;
    rows_.push_back(std::move(row));
  }
}

ConstraintSet::Reading ConstraintSet::read(const Motion& motion, int index) const {
  const Constraint& constraint = constraints_[index];
  const Bound& bound = bound_[index];
  Reading reading;
  if (constraint.at.impact > 0) {
    const std::optional<int> event = motion.findImpact(bound.body, constraint.at.impact, bound.with);
    if (!event) {
      reading.message = describeImpact(constraint.at, "Impact") + " of '" + constraint.body +
                        "' does not come within " + number(motion.end) + " s.";
      return reading;
    }
    reading.instant = Instant::before(*event);
    reading.time = motion.events[*event].time;
    reading.state = motion.stateBefore(*event, bound.body);
  } else {
    const double t = constraint.at.time;
    if (t > motion.end) {
      reading.message = "The constraint on " + describeConstraint(index) + " lies after the end of the motion at " +
                        number(motion.end) + " s.";
      if (!motion.message.empty() && motion.status != MotionStatus::complete) reading.message += " " + motion.message;
      return reading;
    }
    reading.instant = Instant::at(t);
    reading.time = t;
    reading.state = motion.stateAt(bound.body, t);
  }
  reading.available = true;
  return reading;
}

RowValues ConstraintSet::evaluate(const Motion& motion) const {
  RowValues out;
  out.values = out.residuals = out.scaled = Eigen::VectorXd::Constant(size(), kNaN);
  out.seeds.resize(rows_.size());
  int current = -1;
  Reading reading;
  for (int i = 0; i < size(); ++i) {
    const Row& row = rows_[i];
    if (row.constraint != current) {
      current = row.constraint;
      reading = read(motion, current);
      if (!reading.available) {
        out.available = false;
        if (out.message.empty()) out.message = reading.message;
      }
    }
    if (!reading.available) continue;
    const Target& target = constraints_[current].targets[row.target];
    const QuantityKind& kind = *bound_[current].kinds[row.target];
    out.values[i] = kind.value(reading.state, reading.time, target)[row.component];
    out.residuals[i] = out.values[i] - row.wanted;
    out.scaled[i] = out.residuals[i] / row.scale;
    out.seeds[i] = kind.seed(reading.state, target, row.component);
    out.seeds[i].body = bound_[current].body;
    out.seeds[i].at = reading.instant;
  }
  return out;
}

double ConstraintSet::horizon(double duration) const {
  double last = 0;
  for (const Constraint& constraint : constraints_) {
    if (constraint.at.impact > 0) return duration;
    last = std::max(last, constraint.at.time);
  }
  return last > 0 ? std::min(last, duration) : duration;
}

ConstraintSet::Extent ConstraintSet::extentIn(const Motion& motion) const {
  Extent extent;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const When& at = constraints_[i].at;
    if (at.impact == 0) {
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
  }
  return asks;
}

std::string ConstraintSet::describeConstraint(int index) const {
  const Constraint& constraint = constraints_[index];
  const When& at = constraint.at;
  return "'" + constraint.body + "' at " + (at.impact == 0 ? number(at.time) + " s" : describeImpact(at, "its impact"));
}

std::string ConstraintSet::describeRow(int row) const {
  return rows_[row].name + " of " + describeConstraint(rows_[row].constraint);
}

}  // namespace carom
