// SPDX-License-Identifier: MIT
#include "editing/problem/rows/constraint_checks.hpp"

#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"

namespace carom::editing_detail {
namespace {

std::string quantityWords() {
  std::vector<std::string> words;
  for (const QuantityKind* kind : quantityKinds()) words.push_back(kind->word);
  return listOf(words);
}

/// A NaN that somebody computed, not a number that is left free.
bool isNotANumber(const TargetNumber& number) { return !number.isFree() && std::isnan(number); }

void checkLimits(const Target& target, const QuantityKind& kind, const std::string& where) {
  for (const std::vector<TargetNumber>* limits : {&target.min, &target.max}) {
    if (limits->empty()) continue;
    const char* word = limits == &target.min ? "/min" : "/max";
    if (kind.numbers == 4) throw InputError(where + word, "found a range of an orientation, expected a quaternion");
    if (limits->size() != target.value.size()) {
      throw InputError(where + word, "found " + std::to_string(limits->size()) + " numbers, expected " +
                                         std::to_string(target.value.size()));
    }
    for (std::size_t i = 0; i < limits->size(); ++i) {
      if (std::isinf((*limits)[i])) throw InputError(where + word, "found an infinite number, expected a finite one");
      if (isNotANumber((*limits)[i])) throw InputError(where + word, "found NaN, expected a number, or `any` for no limit");
      if (!std::isnan((*limits)[i]) && !std::isnan(target.value[i])) {
        throw InputError(where + word, "found a limit of a component that has a target, expected one of the two");
      }
    }
  }
  if (target.min.empty() || target.max.empty()) return;
  for (std::size_t i = 0; i < target.min.size(); ++i) {
    if (target.min[i] >= target.max[i]) {
      throw InputError(where + "/min", "found " + number(target.min[i]) + ", expected less than the max, which is " +
                                           number(target.max[i]));
    }
  }
}

bool hasLimit(const Target& target, std::size_t component) {
  return (!target.min.empty() && !std::isnan(target.min[component])) ||
         (!target.max.empty() && !std::isnan(target.max[component]));
}

void checkPositive(const Target& target, const QuantityKind& kind, const std::string& where) {
  const auto check = [&](const std::vector<TargetNumber>& numbers, const std::string& place) {
    if (numbers.empty() || std::isnan(numbers[0]) || numbers[0] > 0) return;
    throw InputError(place, "found " + number(numbers[0]) + ", expected more than 0 " + kind.unit +
                                (findQuantityKind("speed") == &kind ? "; what is at rest has a velocity of [0, 0, 0]" : ""));
  };
  check(target.value, where);
  check(target.max, where + "/max");
}

void checkNumbers(const Target& target, const QuantityKind& kind, const std::string& where) {
  if (static_cast<int>(target.value.size()) != kind.numbers) {
    throw InputError(
        where, "found " + std::to_string(target.value.size()) + " numbers, expected " + std::to_string(kind.numbers));
  }
  checkLimits(target, kind, where);
  for (std::size_t i = 0; i < target.value.size(); ++i) {
    const double value = target.value[i];
    if (std::isinf(value)) throw InputError(where, "found an infinite number, expected a finite one");
    if (isNotANumber(target.value[i]))
      throw InputError(where, "found NaN, expected a number, or `any` for a component that is free");
    if (kind.all_or_nothing && std::isnan(value) && !hasLimit(target, i)) {
      throw InputError(where, "found a free component, expected a number: a component of this cannot be left free");
    }
  }
  if (kind.positive) checkPositive(target, kind, where);
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

}  // namespace

const QuantityKind& checkedKind(const Target& target, const When& at, const std::string& where) {
  const QuantityKind* kind = findQuantityKind(target.quantity);
  if (!kind) throw InputError(where, "found '" + target.quantity + "', expected one of " + quantityWords());
  const std::string place = where + "/" + target.quantity;
  checkNumbers(target, *kind, place);
  const std::string found = std::string("found ") + kind->word + " held at ";
  if (at.rest && !kind->of_rest)
    throw InputError(place, found + "rest, expected " + (kind->only_at_events ? "an impact" : "a time or an impact") +
                                ": a body at rest has none");
  if (kind->only_at_events && at.impact == 0 && !at.rest)
    throw InputError(place, found + "a time, expected an impact" + (kind->of_rest ? " or rest" : ""));
  return *kind;
}

void checkWanted(const Target& target, const std::string& where) {
  static const QuantityKind kOneNumber{.word = "", .rows = 1, .numbers = 1, .all_or_nothing = true, .target = nullptr};
  checkNumbers(target, kOneNumber, where);
}

void checkBody(const QuantityKind& kind, const Body& body, const Constraint& constraint, const std::string& where) {
  if (kind.by_mass && body.immovable())
    throw InputError(where + "/body", std::string("found the ") + (body.fixed ? "fixed" : "kinematic") + " body '" +
                                          body.name + "', expected a dynamic one: others have no " + kind.word);
  if (kind.of_shape && kindOf(body.shape).endless)
    throw InputError(where + "/body", "found the unbounded body '" + body.name + "', expected one with a lowest point");
  if (body.fixed && constraint.relative_to.empty() && !kind.to_another)
    throw InputError(where + "/body", "found the fixed body '" + body.name +
                                          "', expected one that moves: nothing changes the " + kind.word + " of others");
  if (!kind.from_another && !constraint.relative_to.empty())
    throw InputError(where + "/relative_to", "found '" + constraint.relative_to + "' beside " + kind.word +
                                                 ", expected none: this quantity is always that of the body itself, in the world");
}

int checkedOther(const QuantityKind& kind, const Target& target, const Scene& scene, const std::string& body,
                 const std::string& where) {
  if (!kind.to_another && !target.to.empty())
    throw InputError(where + "/to", "found '" + target.to + "' beside " + kind.word + ", expected none");
  if (!kind.over_span && target.during)
    throw InputError(where + "/during", std::string("found a span beside ") + kind.word + ", expected none");
  if (target.during) checkSpan(*target.during, where + "/during");
  if (!kind.to_another) return -1;
  const int other = findAt(where + "/to", [&] { return bodyIndex(scene, target.to); });
  if (target.to == body) throw InputError(where + "/to", "found '" + body + "' itself, expected another body");
  return other;
}

void checkSpan(const std::pair<double, double>& span, const std::string& where) {
  const auto [from, to] = span;
  if (!(std::isfinite(from) && from >= 0)) {
    throw InputError(where + "/0", "found " + number(from) + ", expected a time of 0 s or later");
  }
  if (!(std::isfinite(to) && to > from)) {
    throw InputError(where + "/1", "found " + number(to) + ", expected a time after " + number(from) + " s");
  }
}

void checkComesToRest(const Body& body, const std::string& where) {
  if (!body.immovable()) return;
  throw InputError(where, std::string("found the ") + (body.fixed ? "fixed" : "kinematic") + " body '" + body.name +
                              "' constrained at rest, expected a dynamic one: others never come to rest");
}

void checkWhen(const When& at, const std::string& where) {
  if (at.rest && (at.impact != 0 || !at.with.empty() || at.span || at.time != 0))
    throw InputError(where, std::string("found rest and ") +
                                (at.span ? "a span of time" : at.time != 0 ? "a time" : "an impact") +
                                ", expected one of the two");
  if (at.impact < 0 || (at.impact == 0 && !at.with.empty())) {
    throw InputError(where + "/impact", "found " + std::to_string(at.impact) + ", expected 1 or more");
  }
  if (at.span) {
    if (at.impact > 0) throw InputError(where, "found an impact and a span of time, expected one of the two");
    checkSpan(*at.span, where + "/between");
  } else if (at.impact == 0 && !(std::isfinite(at.time) && at.time >= 0)) {
    throw InputError(where, "found " + number(at.time) + ", expected a time of 0 s or later");
  }
}

void checkRegion(const Region& region, const std::string& where) {
  if (const auto* sphere = std::get_if<Sphere>(&region.shape)) {
    if (!(sphere->radius > 0 && std::isfinite(sphere->radius))) {
      throw InputError(where + "/sphere/radius", "found " + number(sphere->radius) + ", expected more than 0 m");
    }
  } else {
    for (double size : std::get<Box>(region.shape).size) {
      if (!(size > 0 && std::isfinite(size))) {
        throw InputError(where + "/box/size", "found " + number(size) + ", expected more than 0 m");
      }
    }
  }
  if (!region.position.allFinite()) {
    throw InputError(where + "/position", "found a number that is not finite, expected three numbers");
  }
  if (!(std::abs(region.orientation.norm() - 1) <= 1e-3)) {
    throw InputError(where + "/orientation",
                     "found a quaternion of length " + number(region.orientation.norm()) + ", expected 1");
  }
  if (region.during) checkSpan(*region.during, where + "/during");
  if (region.margin && !(std::isfinite(*region.margin) && *region.margin >= 0)) {
    throw InputError(where + "/margin", "found " + number(*region.margin) + ", expected 0 m or more");
  }
}

std::string describeImpact(const When& at, const std::string& noun) {
  std::string text = noun + " " + std::to_string(at.impact);
  if (!at.with.empty()) text += " with '" + at.with + "'";
  return text;
}

std::string describeLack(const When& at, const std::string& body) {
  if (at.rest) return "'" + body + "' does not come to rest";
  return describeImpact(at, "Impact") + " of '" + body + "' does not come";
}

}  // namespace carom::editing_detail
