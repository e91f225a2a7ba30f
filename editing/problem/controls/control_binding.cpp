// SPDX-License-Identifier: MIT
#include "editing/problem/controls/control_binding.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"

namespace carom::editing_detail {
namespace {

/// Lower bound of strictly positive numbers that are weighed linearly, relative to their start.
constexpr double kSmallestFraction = 1e-6;
/// Least weight, and the inverse of the largest: changes in the solver's measure, and their squares, stay numbers.
constexpr double kLeastWeight = 1e-12;

std::string controlWords() {
  std::vector<std::string> words;
  for (const ControlKind* kind : controlKinds()) words.push_back(kind->word);
  return listOf(words);
}

int tiltOf(Scene& scene, const std::string& body, int impact) {
  for (std::size_t i = 0; i < scene.tilts.size(); ++i) {
    if (scene.tilts[i].body == body && scene.tilts[i].impact == impact) return static_cast<int>(i);
  }
  scene.tilts.push_back({body, impact, Vec2::Zero()});
  return static_cast<int>(scene.tilts.size()) - 1;
}

ControlOwner findOwner(Scene& scene, const Control& control, const ControlKind& kind, const std::string& where) {
  ControlOwner owner;
  const bool of_body = kind.owner != OwnerKind::material && kind.owner != OwnerKind::scene;
  const bool of_material = kind.owner == OwnerKind::material;
  if (!of_body && !control.body.empty()) {
    throw InputError(where + "/body", "found '" + control.body + "', but " + kind.word + " does not belong to a body");
  }
  if (!of_material && !control.material.empty()) {
    throw InputError(where + "/material",
                     "found '" + control.material + "', but " + kind.word + " does not belong to a material");
  }
  if (of_body) owner.body = findAt(where + "/body", [&] { return bodyIndex(scene, control.body); });
  if (of_material) owner.material = findAt(where + "/material", [&] { return materialIndex(scene, control.material); });

  const bool must_be_free = kind.owner == OwnerKind::free_body;
  const bool must_move = kind.owner == OwnerKind::moving_body || kind.owner == OwnerKind::impact || must_be_free;
  if (must_move && scene.bodies[owner.body].fixed) {
    throw InputError(where + "/body", std::string(kind.word) + " cannot vary: body '" + control.body +
                                          "' is fixed, expected a moving body");
  }
  if (must_be_free && scene.bodies[owner.body].kinematic) {
    throw InputError(where + "/body", std::string(kind.word) + " cannot vary: body '" + control.body +
                                          "' is kinematic, expected a dynamic body");
  }
  if (kind.owner == OwnerKind::immovable_body && !scene.bodies[owner.body].immovable()) {
    throw InputError(where + "/body", std::string(kind.word) + " cannot vary: impacts move body '" + control.body +
                                          "', expected a fixed or kinematic body");
  }
  if (kind.owner == OwnerKind::impact) {
    if (control.impact < 1) {
      throw InputError(where + "/impact", "found " + std::to_string(control.impact) + ", expected 1 or more");
    }
    owner.tilt = tiltOf(scene, control.body, control.impact);
  }
  return owner;
}

/// The cone of a tilt: the person's `max`, the length of both when there are two, or the default.
double coneOf(const Control& control, const std::string& where) {
  if (control.max.empty()) return kDefaultTiltCone;
  double square = 0;
  for (double max : control.max) square += max * max;
  const double cone = std::sqrt(square);
  if (!(cone > 0) || !std::isfinite(cone)) {
    throw InputError(where + "/max", "found " + number(cone) + ", expected a tilt greater than 0");
  }
  return cone;
}

double boundAt(const std::vector<double>& bounds, int k, int count, double none, const std::string& where) {
  if (bounds.empty()) return none;
  if (bounds.size() != 1 && static_cast<int>(bounds.size()) != count) {
    throw InputError(where, "found " + std::to_string(bounds.size()) + " numbers, expected 1 or " +
                                std::to_string(count) + ", one for each component that varies");
  }
  const double bound = bounds.size() == 1 ? bounds[0] : bounds[static_cast<std::size_t>(k)];
  if (std::isnan(bound)) throw InputError(where, "found NaN, expected a number");
  return bound;
}

}  // namespace

BoundControl bindControl(Scene& scene, const Control& control, const std::string& where) {
  BoundControl bound;
  bound.control = control;
  bound.kind = findControlKind(control.vary);
  if (!bound.kind) {
    throw InputError(where + "/vary", "found '" + control.vary + "', expected one of " + controlWords());
  }
  if (!(control.weight >= kLeastWeight && control.weight <= 1 / kLeastWeight)) {
    throw InputError(where + "/weight", "found " + number(control.weight) + ", expected a number from " +
                                            number(kLeastWeight) + " to " + number(1 / kLeastWeight));
  }
  bound.owner = findOwner(scene, control, *bound.kind, where);
  if (bound.kind->owner == OwnerKind::impact) bound.cone = coneOf(control, where);
  if (bound.kind->prepare) bound.kind->prepare(scene, bound.owner);
  return bound;
}

std::vector<int> varyingSlots(const Scene& scene, const BoundControl& bound, const std::string& where) {
  const std::vector<std::string> names = bound.kind->components(scene, bound.owner);
  if (names.empty()) {
    throw InputError(where, describe(bound.control) + " has no parameter that can vary");
  }
  std::set<int> slots;
  for (const std::string& wanted : bound.control.components) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) {
      throw InputError(where + "/components", "found '" + wanted + "', expected " + listOf(names));
    }
    slots.insert(static_cast<int>(found - names.begin()));
  }
  if (bound.control.components.empty()) {
    for (std::size_t i = 0; i < names.size(); ++i) slots.insert(static_cast<int>(i));
  }
  return {slots.begin(), slots.end()};
}

Interval boundsOf(const BoundControl& bound, int k, int count, double start, const std::string& where) {
  const ControlKind& kind = *bound.kind;
  const bool has_cone = kind.owner == OwnerKind::impact && bound.control.max.size() <= 1;
  const double lower = boundAt(bound.control.min, k, count, kind.lower, where + "/min");
  const double upper = has_cone ? kind.upper : boundAt(bound.control.max, k, count, kind.upper, where + "/max");
  if (lower > upper) {
    throw InputError(where, "found min " + number(lower) + " above max " + number(upper) + ", expected min <= max");
  }
  const double positive = kind.logarithmic ? 0 : kSmallestFraction * start;
  Interval bounds{std::max(lower, kind.strictly_positive ? positive : kind.lower), std::min(upper, kind.upper)};
  const bool empty = bounds.lower > bounds.upper || (kind.strictly_positive && bounds.upper <= 0);
  if (empty) {
    throw InputError(where, "found min " + number(lower) + ", max " + number(upper) + ", which leaves no " + kind.word +
                                " that is physically possible (" + number(kind.lower) + " to " + number(kind.upper) +
                                ")");
  }
  return bounds;
}

}  // namespace carom::editing_detail
