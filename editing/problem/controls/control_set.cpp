// SPDX-License-Identifier: MIT
#include "editing/problem/controls/control_set.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "adjoint/numeric/elementary.hpp"
#include "editing/detail/messages.hpp"
#include "editing/problem/controls/control_binding.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

std::string pointerOf(int control) { return "/controls/" + std::to_string(control); }

bool sameOwner(const BoundControl& a, const BoundControl& b) {
  return a.kind == b.kind && a.owner.body == b.owner.body && a.owner.material == b.owner.material &&
         a.owner.tilt == b.owner.tilt;
}

/// The change that leads to `value`.
double changeOf(const Variable& v, double value) {
  if (!v.logarithmic) return (value - v.start) / v.scale;
  if (value <= 0) return -std::numeric_limits<double>::infinity();
  return elementary::log(value / v.start) / v.scale;
}

/// One number a variable.
void checkSize(const char* call, const Eigen::VectorXd& values, int size) {
  checkCount(call, "numbers", static_cast<std::size_t>(values.size()), static_cast<std::size_t>(size));
}

}  // namespace

std::string describe(const Control& control) {
  std::string text = control.vary;
  if (!control.body.empty()) text += " of '" + control.body + "'";
  if (!control.material.empty()) text += " of '" + control.material + "'";
  const ControlKind* kind = findControlKind(control.vary);
  if (kind && kind->owner == OwnerKind::impact) text += " at impact " + std::to_string(control.impact);
  return text;
}

std::string describe(const Control& control, const std::string& component) {
  std::string text = describe(control);
  return component == "value" ? text : text.insert(control.vary.size(), "." + component);
}

ControlSet::ControlSet(const Scene& scene, const std::vector<Control>& controls) : written_(scene) {
  // All controls are bound, and so prepared, before any value is read: one may rewrite what another varies.
  for (std::size_t i = 0; i < controls.size(); ++i) {
    controls_.push_back(bindControl(written_, controls[i], pointerOf(static_cast<int>(i))));
  }
  for (std::size_t i = 0; i < controls.size(); ++i) addVariables(static_cast<int>(i));
  shareOwners();
  start_ = sceneAt(startValues());
}

void ControlSet::addVariables(int index) {
  BoundControl& bound = controls_[index];
  const ControlKind& kind = *bound.kind;
  const std::string where = pointerOf(index);
  const std::vector<std::string> names = kind.components(written_, bound.owner);
  const std::vector<int> varying = varyingSlots(written_, bound, where);
  const int count = static_cast<int>(varying.size());
  const Eigen::VectorXd before = kind.get(written_, bound.owner), scale = kind.scale(written_, bound.owner);

  bound.start = before;
  if (bound.cone > 0 && before.norm() > bound.cone) bound.start *= bound.cone / before.norm();
  for (int k = 0; k < count; ++k) {
    const int slot = varying[k];
    for (const Variable& other : variables_) {
      if (other.slot == slot && sameOwner(controls_[other.control], bound)) {
        throw InputError(where, describe(bound.control, names[slot]) + " varies already in " + pointerOf(other.control) +
                                    ", expected once");
      }
    }
    const Interval bounds = boundsOf(bound, k, count, before[slot], where);
    bound.start[slot] = std::clamp(bound.start[slot], bounds.lower, bounds.upper);
    Variable v;
    v.control = index, v.slot = slot, v.component = names[slot];
    v.before = before[slot], v.start = bound.start[slot];
    v.lower = bounds.lower, v.upper = bounds.upper;
    v.logarithmic = kind.logarithmic;
    v.scale = scale[slot] / bound.control.weight;
    std::string name = describe(bound.control, v.component);
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    if (v.start != v.before) {
      start_moved_ = true;
      notes_.push_back(name + " was " + number(v.before) + ", outside its bounds, and starts at " + number(v.start) +
                       ".");
    }
    if (v.lower == v.upper) {
      notes_.push_back(name + " has no room between its bounds and stays at " + number(v.start) + ".");
    } else {
      variables_.push_back(std::move(v));
    }
  }
}

Eigen::VectorXd ControlSet::startValues() const {
  Eigen::VectorXd values(size());
  for (int i = 0; i < size(); ++i) values[i] = variables_[i].start;
  return values;
}

void ControlSet::shareOwners() {
  for (std::size_t c = 0; c < controls_.size(); ++c) {
    const BoundControl& bound = controls_[c];
    const auto known = std::find_if(owners_.begin(), owners_.end(), [&](const SharedOwner& owner) {
      return sameOwner(controls_[owner.first_control], bound);
    });
    owner_of_.push_back(static_cast<int>(known - owners_.begin()));
    const Eigen::VectorXd written = bound.kind->get(written_, bound.owner);
    if (known == owners_.end()) owners_.push_back({static_cast<int>(c), written, {}});
    Eigen::VectorXd& start = owners_[static_cast<std::size_t>(owner_of_.back())].start;
    for (Eigen::Index slot = 0; slot < written.size(); ++slot)
      if (bound.start[slot] != written[slot]) start[slot] = bound.start[slot];
  }
  for (int i = 0; i < size(); ++i)
    owners_[static_cast<std::size_t>(owner_of_[variables_[i].control])].variables.push_back(i);
}

Eigen::VectorXd ControlSet::slots(int control, const Eigen::VectorXd& values) const {
  const SharedOwner& owner = ownerOf(control);
  Eigen::VectorXd merged = owner.start;
  for (const int i : owner.variables) merged[variables_[i].slot] = values[i];
  return merged;
}

Scene ControlSet::sceneAt(const Eigen::VectorXd& values) const {
  checkSize("sceneAt", values, size());
  checkEntries("sceneAt", "a value of", values);
  Scene scene = written_;
  for (std::size_t c = 0; c < controls_.size(); ++c) {
    const BoundControl& bound = controls_[c];
    bound.kind->set(slots(static_cast<int>(c), values), written_, bound.owner, scene);
  }
  return scene;
}

Eigen::VectorXd ControlSet::gather(const SceneGradient& gradient, const Eigen::VectorXd& values) const {
  checkSize("gather", values, size());
  Eigen::VectorXd out(size());
  int last = -1;
  Eigen::VectorXd of_control;
  for (int i = 0; i < size(); ++i) {
    const Variable& v = variables_[i];
    if (v.control != last) {
      const BoundControl& bound = controls_[v.control];
      of_control = bound.kind->gather(gradient, bound.owner, slots(v.control, values));
      last = v.control;
    }
    out[i] = of_control[v.slot];
  }
  return out;
}

Eigen::VectorXd ControlSet::gatherRate(const SceneGradient& gradient, const Eigen::VectorXd& values,
                                       const Eigen::VectorXd& rates) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(size());
  for (int i = 0; i < size(); ++i) {
    const BoundControl& bound = controls_[variables_[i].control];
    if (!bound.kind->gather_rate) continue;
    Eigen::VectorXd of_owner = Eigen::VectorXd::Zero(bound.start.size());
    for (const int j : ownerOf(variables_[i].control).variables) of_owner[variables_[j].slot] = rates[j];
    if (of_owner.isZero(0)) continue;
    out[i] = bound.kind->gather_rate(gradient, bound.owner, slots(variables_[i].control, values),
                                     of_owner)[variables_[i].slot];
  }
  return out;
}

Eigen::VectorXd ControlSet::valueBends(const Eigen::VectorXd& changes) const {
  Eigen::VectorXd bends = valueRates(changes);
  for (int i = 0; i < size(); ++i) bends[i] *= variables_[i].logarithmic ? variables_[i].scale : 0;
  return bends;
}

SceneTangent ControlSet::scatter(const Eigen::VectorXd& rates, const Eigen::VectorXd& values) const {
  checkSize("scatter", rates, size());
  checkSize("scatter", values, size());
  SceneTangent tangent(start_);
  for (std::size_t c = 0; c < controls_.size(); ++c) {
    const BoundControl& bound = controls_[c];
    Eigen::VectorXd of_control = Eigen::VectorXd::Zero(bound.start.size());
    for (const int i : ownerOf(static_cast<int>(c)).variables)
      if (variables_[i].control == static_cast<int>(c)) of_control[variables_[i].slot] = rates[i];
    if (of_control.isZero(0)) continue;
    bound.kind->scatter(of_control, bound.owner, slots(static_cast<int>(c), values), tangent);
  }
  return tangent;
}

Eigen::VectorXd ControlSet::valuesOf(const Eigen::VectorXd& changes) const {
  checkSize("valuesOf", changes, size());
  Eigen::VectorXd values(size());
  for (int i = 0; i < size(); ++i) {
    const Variable& v = variables_[i];
    const double change = changes[i] * v.scale;
    // The clamp takes away what rounding adds to a bound.
    values[i] = std::clamp(v.logarithmic ? v.start * elementary::exp(change) : v.start + change, v.lower, v.upper);
  }
  return values;
}

Eigen::VectorXd ControlSet::changesOf(const Eigen::VectorXd& values) const {
  checkSize("changesOf", values, size());
  Eigen::VectorXd changes(size());
  for (int i = 0; i < size(); ++i) changes[i] = changeOf(variables_[i], values[i]);
  return changes;
}

Eigen::VectorXd ControlSet::valueRates(const Eigen::VectorXd& changes) const {
  checkSize("valueRates", changes, size());
  Eigen::VectorXd rates(size());
  for (int i = 0; i < size(); ++i) {
    const Variable& v = variables_[i];
    rates[i] = v.logarithmic ? v.scale * v.start * elementary::exp(changes[i] * v.scale) : v.scale;
  }
  return rates;
}

Eigen::VectorXd ControlSet::lowerChanges() const {
  Eigen::VectorXd lower(size());
  for (int i = 0; i < size(); ++i) lower[i] = changeOf(variables_[i], variables_[i].lower);
  return lower;
}

Eigen::VectorXd ControlSet::upperChanges() const {
  Eigen::VectorXd upper(size());
  for (int i = 0; i < size(); ++i) upper[i] = changeOf(variables_[i], variables_[i].upper);
  return upper;
}

std::string ControlSet::describeVariable(int variable) const {
  const Variable& v = variables_[checkedIndex("describeVariable", "variable", variable, variables_.size())];
  return describe(controls_[v.control].control, v.component);
}

}  // namespace carom::editing_detail
