// SPDX-License-Identifier: MIT
#include "editing/problem/rows/constraint_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/scene/body_model.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/constraint_checks.hpp"

namespace carom::editing_detail {

namespace {

constexpr double kNoTarget = std::numeric_limits<double>::quiet_NaN();

double limitOf(const std::vector<TargetNumber>& limits, int component, double none) {
  if (limits.empty()) return none;
  const double limit = limits[static_cast<std::size_t>(component)];
  return std::isnan(limit) ? none : limit;
}

/// What a target allows of the component of a row; false where that is anything.
bool putWanted(const Target& target, const Vec3& wanted, Row& row) {
  row.target = row.lower = row.upper = wanted[row.component];
  if (!std::isnan(row.target)) return true;
  row.lower = limitOf(target.min, row.component, -kInfinity), row.upper = limitOf(target.max, row.component, kInfinity);
  return std::isfinite(row.lower) || std::isfinite(row.upper);
}

/// Of a ball about the centre of mass that holds the whole body.
double boundingRadiusAboutCenter(const Body& body) {
  return kindOf(body.shape).boundingRadius(body.shape) + centerOfMass(body).norm();
}

}  // namespace

ConstraintSet::ConstraintSet(const Scene& scene, const std::vector<Constraint>& constraints, double duration,
                             const OwnFunctions& own, RowsOf which)
    : body_count_(static_cast<int>(scene.bodies.size())), constraints_(constraints), bound_(constraints.size()) {
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (constraints[i].soft.has_value() == (which == RowsOf::soft))
      bind(scene, static_cast<int>(i), duration);
    else
      constraints_[i] = Constraint{constraints[i].body, When(0.0), {}};
  }
  for (std::size_t i = 0; i < own.rows.size(); ++i) addOwnRow(scene, static_cast<int>(i), own.rows[i], duration);
  if (own.objective) objective_.emplace(scene, *own.objective, duration, "minimise");
  sortRows();
}

void ConstraintSet::sortRows() {
  equations_.clear(), ranges_.clear();
  for (int i = 0; i < size(); ++i) (rows_[i].isRange() ? ranges_ : equations_).push_back(i);
}

void ConstraintSet::bind(const Scene& scene, int index, double duration) {
  const Constraint& constraint = constraints_[index];
  const std::string where = "/constraints/" + std::to_string(index);
  Bound& bound = bound_[index];
  bindImpacts(scene, index, where);
  bound.body = findAt(where + "/body", [&] { return bodyIndex(scene, constraint.body); });
  const When& at = constraint.at;
  checkWhen(at, where + "/at");
  if (at.impact > 0 && scene.bodies[bound.body].fixed)
    throw InputError(where + "/body", "found an impact of the fixed body '" + constraint.body +
                                          "', expected a body that moves: impacts are counted by the bodies that move");
  if (at.rest) checkComesToRest(scene.bodies[bound.body], where + "/body");
  if (!at.with.empty()) bound.with = findAt(where + "/at/with", [&] { return bodyIndex(scene, at.with); });
  if (!constraint.relative_to.empty()) {
    bound.relative_to = findAt(where + "/relative_to", [&] { return bodyIndex(scene, constraint.relative_to); });
    if (bound.relative_to == bound.body) {
      throw InputError(where + "/relative_to", "found '" + constraint.body + "' itself, expected another body");
    }
  }
  const std::size_t first_row = rows_.size();
  for (std::size_t t = 0; t < constraint.targets.size(); ++t) bindTarget(scene, index, static_cast<int>(t), duration);
  if (at.span && bound.at_instant) {
    bound.free_time = static_cast<int>(free_times_.size());
    free_times_.push_back({index, at.span->first, at.span->second, naturalScales(scene, bound.body).time});
  }
  for (std::size_t r = 0; r < constraint.regions.size(); ++r) {
    const Region& region = constraint.regions[r];
    checkRegion(region, where + (region.side == Region::Side::avoid ? "/avoid" : "/inside"));
    addRegionRows(scene, index, static_cast<int>(r), duration);
  }
  if (rows_.size() == first_row && !bound.hit && !bound.sequence)
    throw InputError(where, "found no target, expected at least one");
}

void ConstraintSet::bindTarget(const Scene& scene, int index, int target_index, double duration) {
  const Constraint& constraint = constraints_[index];
  const Target& target = constraint.targets[target_index];
  const std::string where = "/constraints/" + std::to_string(index);
  Bound& bound = bound_[index];
  const QuantityKind& kind = checkedKind(target, constraint.at, where);
  checkBody(kind, scene.bodies[bound.body], constraint, where);
  bound.kinds.push_back(&kind);
  bound.to.push_back(checkedOther(kind, target, scene, constraint.body, where + "/" + target.quantity));
  bound.during.push_back(target.during.value_or(std::pair{0.0, duration}));
  bound.at_instant |= !kind.over_span;
  addTargetRows(scene, index, target_index);
}

void ConstraintSet::addTargetRows(const Scene& scene, int index, int target_index) {
  const Target& target = constraints_[index].targets[target_index];
  const QuantityKind& kind = *bound_[index].kinds[target_index];
  const Vec3 wanted = kind.target(target);
  const NaturalScales scales = naturalScales(scene, bound_[index].body);
  for (int c = 0; c < kind.rows; ++c) {
    Row row;
    row.constraint = index, row.target_index = target_index, row.component = c, row.kind = &kind;
    row.name = kind.word;
    if (kind.rows > 1) row.name += std::string(".") + "xyz"[c];
    if (kind.to_another) row.name += " to '" + target.to + "'";
    if (!putWanted(target, wanted, row)) continue;  // left free
    row.scale = kind.scale ? scales.*kind.scale : 1;
    if (kind.by_mass) row.scale *= modelOf(scene.bodies[bound_[index].body]).mass;
    rows_.push_back(std::move(row));
  }
}

void ConstraintSet::addOwnRow(const Scene& scene, int index, const OwnFunctions::Row& own, double duration) {
  own_.emplace_back(scene, own.function, duration, "require " + std::to_string(index));
  Target target{"", {own.wanted.value}};
  target.min = {own.wanted.min}, target.max = {own.wanted.max};
  checkWanted(target, own_.back().where);
  Row row;
  row.own = index, row.target_index = -1;
  row.name = own.function.name;
  row.target = row.lower = row.upper = own.wanted.value;
  if (std::isnan(own.wanted.value)) {
    row.lower = limitOf(target.min, 0, -kInfinity), row.upper = limitOf(target.max, 0, kInfinity);
  }
  row.scale = own.function.scale;
  rows_.push_back(std::move(row));
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
  const bool ball = region.keep == Region::Keep::ball;
  of_body.margin = region.margin.value_or(ball ? boundingRadiusAboutCenter(body) : 0);
  bound.regions.push_back(std::move(of_body));
  for (int c = 0; c < rowsOf(region); ++c) {
    Row row;
    row.constraint = index, row.target_index = -1, row.region = region_index, row.component = c;
    row.name = rowName(region, c);
    row.target = kNoTarget, row.lower = 0, row.upper = kInfinity;
    row.scale = naturalScales(scene, bound.body).length;
    rows_.push_back(std::move(row));
  }
}

std::vector<bool> ConstraintSet::asksOrientation() const {
  const bool of_anything = !own_.empty() || objective_;
  std::vector<bool> asks(static_cast<std::size_t>(body_count_), of_anything);
  for (const Bound& bound : bound_) {
    for (const QuantityKind* kind : bound.kinds) {
      if (kind->turns) asks[static_cast<std::size_t>(bound.body)] = true;
    }
    for (const BoundRegion& region : bound.regions)
      if (region.region.keep == Region::Keep::shape) asks[static_cast<std::size_t>(bound.body)] = true;
    for (const int other : bound.to)
      if (other >= 0) asks[static_cast<std::size_t>(other)] = true;
    if (bound.relative_to >= 0) asks[static_cast<std::size_t>(bound.relative_to)] = true;
  }
  return asks;
}

void ConstraintSet::setTarget(int index, int target_index, Target moved) {
  const std::string where = "/constraints/" + std::to_string(index);
  const QuantityKind& kind = checkedKind(moved, constraints_[index].at, where);
  const Vec3 wanted = kind.target(moved);
  const auto is_of_it = [&](const Row& row) { return row.constraint == index && row.target_index == target_index; };
  int held = 0;
  for (Row row; row.component < kind.rows; ++row.component) held += putWanted(moved, wanted, row);
  std::vector<Row> rows = rows_;
  for (Row& row : rows) {
    if (!is_of_it(row)) continue;
    --held;
    if (!putWanted(moved, wanted, row)) held = -kind.rows;
  }
  if (held != 0)
    throw InputError(where + "/" + moved.quantity, "found other components free than before, expected the same ones");
  rows_ = std::move(rows);
  constraints_[index].targets[target_index] = std::move(moved);
  sortRows();
}

std::string ConstraintSet::describeConstraint(int index) const {
  const Constraint& constraint = constraints_[index];
  const When& at = constraint.at;
  if (!constraint.sequence.empty()) return "the required sequence, up to \"" + constraint.sequence.back() + "\"";
  std::string text = "'" + constraint.body + "'";
  if (!constraint.relative_to.empty()) text += " relative to '" + constraint.relative_to + "'";
  if (constraint.hits) return text + " when it hits '" + constraint.hits->with + "'";
  if (constraint.targets.empty()) return text;
  if (at.span) return text + " between " + number(at.span->first) + " s and " + number(at.span->second) + " s";
  if (at.rest) return text + " at rest";
  return text + " at " + (at.impact == 0 ? number(at.time) + " s" : describeImpact(at, "its impact"));
}

std::string unitOf(const Row& row) {
  if (row.region >= 0) return " m";
  return row.kind && *row.kind->unit ? std::string(" ") + row.kind->unit : "";
}

std::string ConstraintSet::describeRow(int row) const {
  const Row& r = rows_[row];
  if (r.own >= 0) return "'" + r.name + "'";
  if (r.kind && r.kind->over_span) {
    const auto [from, to] = bound_[r.constraint].during[r.target_index];
    return r.name + " of '" + constraints_[r.constraint].body + "' from " + number(from) + " s to " + number(to) + " s";
  }
  if (r.region < 0) return r.name + " of " + describeConstraint(r.constraint);
  const BoundRegion& region = bound_[r.constraint].regions[r.region];
  return r.name + " of '" + constraints_[r.constraint].body + "' from " + number(region.from) + " s to " +
         number(region.to) + " s";
}

}  // namespace carom::editing_detail
