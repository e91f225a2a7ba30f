// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "formats/documents/scene_reader.hpp"
#include "formats/json/json.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

void requireWithin(double time, double duration, const std::string& where) {
  if (!(time <= duration))
    fail(where, numberText(time), "a time in [0, " + numberText(duration) + "], the duration of the scene");
}

std::pair<double, double> readSpan(const Json& value, double duration, const std::string& where) {
  const auto from = value[0].get<double>(), to = value[1].get<double>();
  requireWithin(from, duration, where + "/0");
  if (!(to > from)) fail(where + "/1", numberText(to), "a time after " + numberText(from) + ", the start of the span");
  requireWithin(to, duration, where + "/1");
  return {from, to};
}

When readWhen(const Json& value, const Json& body, const Scene& scene, double duration, const std::string& where) {
  if (value.is_number()) {
    requireWithin(value.get<double>(), duration, where);
    return When(value.get<double>());
  }
  if (value.contains("between")) {
    const auto [from, to] = readSpan(value["between"], duration, where + "/between");
    return between(from, to);
  }
  if (value.contains("rest")) return atRest();
  std::string with;
  if (value.contains("with")) {
    readBodyName(value["with"], where + "/with", scene);
    with = value["with"].get<std::string>();
    if (value["with"] == body) fail(where + "/with", quotedText(with), "another body than the constrained one");
  }
  return nthImpact(value["impact"].get<int>(), with);
}

/// Component `i` of a target within a range.
void readRange(const Json& range, std::size_t i, Target& target, const std::string& where) {
  const auto read = [&](const char* member, std::vector<TargetNumber>& limits) {
    const auto limit = range.find(member);
    if (limit == range.end()) return;
    limits.resize(target.value.size(), any);
    limits[i] = limit->get<double>();
  };
  read("min", target.min);
  read("max", target.max);
  if (range.contains("min") && range.contains("max") && !(target.min[i] < target.max[i]))
    fail(where + "/min", numberText(target.min[i]), "a number < max, which is " + numberText(target.max[i]));
}

void readNumbers(const Json& value, Target& target, const std::string& where) {
  target.value.assign(value.size(), any);
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (value[i].is_number()) target.value[i] = value[i].get<double>();
    if (value[i].is_object()) readRange(value[i], i, target, pointerTo(where, i));
  }
  if (std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_null(); }))
    fail(where, "only null", "a number or a range for at least one component");
}

void readTime(const Json& value, const When& at, double duration, Target& target, const std::string& where) {
  if (at.impact == 0 && !at.rest)
    fail(where, "a target \"time\" at a given time", "\"at\": {\"impact\": n} or {\"rest\": true} beside it");
  target.value = {value.is_number() ? TargetNumber(value.get<double>()) : any};
  if (value.is_number()) requireWithin(target.value[0], duration, where);
  if (!value.is_object()) return;
  readRange(value, 0, target, where);
  for (const auto& limit : value.items())
    requireWithin(limit.value().get<double>(), duration, pointerTo(where, limit.key()));
}

/// To another body, which the caller looks up.
void readDistance(const Json& value, Target& target, double duration, const std::string& where) {
  target.to = value["to"].get<std::string>();
  const bool exact = value.contains("value");
  target.value = {exact ? TargetNumber(value["value"].get<double>()) : any};
  if (exact && (value.contains("min") || value.contains("max")))
    fail(where + "/value", "a value beside a range", "one of the two");
  if (!exact && !value.contains("min") && !value.contains("max"))
    fail(where, "an object without a number", "\"value\", \"min\" or \"max\"");
  readRange(value, 0, target, where);
  if (value.contains("during")) target.during = readSpan(value["during"], duration, where + "/during");
}

Target readTarget(const std::string& quantity, const Json& value, const When& at, double duration,
                  const std::string& where) {
  Target target;
  target.quantity = quantity;
  if (quantity == "orientation") {
    const Quat q = readQuaternion(value, where);
    target.value = {q.w(), q.x(), q.y(), q.z()};
  } else if (quantity == "time") {
    readTime(value, at, duration, target, where);
  } else if (quantity == "point") {
    readNumbers(value["world"], target, where + "/world");
    target.body_point = readVector(value["body_point"]);
  } else if (value.is_object() && value.contains("to")) {
    readDistance(value, target, duration, where);
  } else if (value.is_array()) {
    readNumbers(value, target, where);
  } else {
    target.value = {value.is_number() ? TargetNumber(value.get<double>()) : any};
    if (value.is_object()) readRange(value, 0, target, where);
  }
  return target;
}

Region readRegion(const Json& value, Region::Side side, double duration, const std::string& where) {
  Region region;
  region.side = side;
  if (value.contains("sphere")) region.shape = Sphere{value["sphere"]["radius"].get<double>()};
  if (value.contains("box")) region.shape = Box{readVector(value["box"]["size"])};
  if (value.contains("position")) region.position = readVector(value["position"]);
  if (value.contains("orientation")) region.orientation = readQuaternion(value["orientation"], where + "/orientation");
  if (value.contains("during")) region.during = readSpan(value["during"], duration, where + "/during");
  if (value.contains("keep") && value["keep"] == "shape") region.keep = Region::Keep::shape;
  if (value.contains("margin")) region.margin = value["margin"].get<double>();
  return region;
}

void readRegions(const Json& value, Region::Side side, double duration, const std::string& where,
                 std::vector<Region>& regions) {
  if (value.is_object()) regions.push_back(readRegion(value, side, duration, where));
  if (!value.is_array()) return;
  for (std::size_t i = 0; i < value.size(); ++i)
    regions.push_back(readRegion(value[i], side, duration, pointerTo(where, i)));
}

std::string readRelativeTo(const Json& value, const Json& body, const Scene& scene, const std::string& where) {
  readBodyName(value, where, scene);
  if (value == body) fail(where, describe(value), "another body than the constrained one");
  return value.get<std::string>();
}

/// Regions have times and places of their own: beside them alone, these members would mean nothing.
void requireTargets(const Constraint& constraint, const Json& value, const std::string& where) {
  if (!constraint.targets.empty()) return;
  if (constraint.regions.empty())
    fail(where, "a constraint without a target",
         "one of position, orientation, velocity, angular_velocity, time, point, speed, kinetic_energy, impulse, contact, "
         "height, distance, closest_approach, avoid, inside");
  const std::string target = "a target beside it, such as position: a region ";
  if (value.contains("at")) fail(where + "/at", describe(value["at"]), target + "has its time in \"during\"");
  if (value.contains("relative_to"))
    fail(where + "/relative_to", describe(value["relative_to"]), target + "stands still in the world");
}

ImpactOf readImpactOf(const Json& value, const Scene& scene, const std::string& where) {
  ImpactOf impact;
  readBodyName(value["body"], where + "/body", scene);
  impact.body = value["body"].get<std::string>();
  if (value.contains("impact")) impact.n = value["impact"].get<int>();
  if (!value.contains("with")) return impact;
  readBodyName(value["with"], where + "/with", scene);
  impact.with = value["with"].get<std::string>();
  return impact;
}

Hit readHit(const Json& value, const Scene& scene, double duration, const std::string& where) {
  Hit hit;
  readBodyName(value["hits"], where + "/hits", scene);
  hit.with = value["hits"].get<std::string>();
  if (value["hits"] == value["body"]) fail(where + "/hits", quotedText(hit.with), "another body than the one that hits");
  if (value.contains("during")) hit.during = readSpan(value["during"], duration, where + "/during");
  if (value.contains("after")) hit.after = readImpactOf(value["after"], scene, where + "/after");
  if (value.contains("before")) hit.before = readImpactOf(value["before"], scene, where + "/before");
  return hit;
}

/// What a hit or a sequence has beside it is refused: both are constraints of their own.
void requireAlone(const Json& value, const std::vector<std::string>& words, const std::string& where) {
  for (const auto& member : value.items())
    if (std::find(words.begin(), words.end(), member.key()) == words.end())
      fail(pointerTo(where, member.key()), describe(member.value()), "a constraint of its own for it");
}

Constraint readSequence(const Json& value, const std::string& where) {
  requireAlone(value, {"sequence", "notes"}, where);
  Constraint constraint{"", When(0.0), {}};
  for (const Json& impact : value["sequence"]) constraint.sequence.push_back(impact.get<std::string>());
  constraint.notes = textOr(value, "notes");
  return constraint;
}

Constraint readConstraint(const Json& value, const Scene& scene, double duration, const std::string& where) {
  if (value.contains("sequence")) return readSequence(value, where);
  if (!value.contains("body")) fail(where, "a constraint without \"body\"", "the name of a moving body");
  const int body = readBodyName(value["body"], where + "/body", scene);
  const auto& name = scene.bodies[static_cast<std::size_t>(body)].name;
  if (scene.bodies[static_cast<std::size_t>(body)].fixed)
    fail(where + "/body", "the fixed body " + quotedText(name), "a moving body");
  Constraint constraint{name, When(0.0), {}};
  if (value.contains("hits")) {
    requireAlone(value, {"body", "hits", "during", "after", "before", "notes"}, where);
    constraint.hits = readHit(value, scene, duration, where);
    constraint.notes = textOr(value, "notes");
    return constraint;
  }
  if (value.contains("at")) constraint.at = readWhen(value["at"], value["body"], scene, duration, where + "/at");
  for (const auto& member : value.items()) {
    const std::string& word = member.key();
    const std::string place = pointerTo(where, word);
    if (word == "body" || word == "at" || word == "notes" || word == "soft") continue;
    if (word == "relative_to") {
      constraint.relative_to = readRelativeTo(member.value(), value["body"], scene, place);
    } else if (word == "avoid" || word == "inside") {
      const auto side = word == "avoid" ? Region::Side::avoid : Region::Side::inside;
      readRegions(member.value(), side, duration, place, constraint.regions);
    } else {
      constraint.targets.push_back(readTarget(word, member.value(), constraint.at, duration, place));
      if (const std::string& to = constraint.targets.back().to; !to.empty()) {
        readBodyName(member.value()["to"], place + "/to", scene);
        if (to == name) fail(place + "/to", quotedText(to), "another body than the constrained one");
      }
    }
  }
  requireTargets(constraint, value, where);
  if (value.contains("soft")) constraint.soft = value["soft"].get<double>();
  constraint.notes = textOr(value, "notes");
  return constraint;
}

}  // namespace

std::vector<Constraint> readConstraints(const Json& document, const Scene& scene, double duration) {
  std::vector<Constraint> constraints;
  const auto list = document.find("constraints");
  for (std::size_t i = 0; list != document.end() && i < list->size(); ++i)
    constraints.push_back(readConstraint((*list)[i], scene, duration, pointerTo("/constraints", i)));
  return constraints;
}

}  // namespace carom::formats_detail
