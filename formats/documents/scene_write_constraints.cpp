// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "adjoint/base/errors.h"
#include "editing/constraint.h"
#include "formats/documents/scene_writer.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

using Layout = JsonWriter::Layout;

void writeSpan(JsonWriter& out, const char* member, const std::pair<double, double>& span) {
  out.members(member, std::array{span.first, span.second});
}

void writeWhen(JsonWriter& out, const When& at) {
  if (at.isTime()) {
    out.members("at", at.time);
    return;
  }
  out.key("at").beginObject();
  if (at.span)
    writeSpan(out, "between", *at.span);
  else if (at.rest)
    out.members("rest", true);
  else
    out.members("impact", at.impact).unlessEmpty("with", at.with);
  out.endObject();
}

/// NaN where there is none.
double limitAt(const std::vector<TargetNumber>& limits, std::size_t i) { return limits.empty() ? any : limits[i]; }

/// A number, a range, or null.
void writeComponent(JsonWriter& out, const Target& target, std::size_t i) {
  const double min = limitAt(target.min, i), max = limitAt(target.max, i);
  if (std::isnan(min) && std::isnan(max)) {
    out.value(double{target.value[i]});
    return;
  }
  out.beginObject();
  if (!std::isnan(min)) out.members("min", min);
  if (!std::isnan(max)) out.members("max", max);
  out.endObject();
}

void writeComponents(JsonWriter& out, const Target& target) {
  out.beginArray(Layout::line);
  for (std::size_t i = 0; i < target.value.size(); ++i) writeComponent(out, target, i);
  out.endArray();
}

bool isOneNumber(const Target& target) {
  const std::array words{"time", "speed", "kinetic_energy", "impulse", "height", "distance", "closest_approach"};
  return std::find(words.begin(), words.end(), target.quantity) != words.end();
}

void writeDistance(JsonWriter& out, const Target& target) {
  const double min = limitAt(target.min, 0), max = limitAt(target.max, 0);
  out.beginObject().members("to", target.to);
  if (!std::isnan(target.value[0])) out.members("value", double{target.value[0]});
  if (!std::isnan(min)) out.members("min", min);
  if (!std::isnan(max)) out.members("max", max);
  if (target.during) writeSpan(out, "during", *target.during);
  out.endObject();
}

void writeTarget(JsonWriter& out, const Target& target) {
  out.key(target.quantity);
  if (!target.to.empty()) return writeDistance(out, target);
  if (isOneNumber(target)) {
    writeComponent(out, target, 0);
  } else if (target.quantity == "point") {
    out.beginObject().members("body_point", target.body_point).key("world");
    writeComponents(out, target);
    out.endObject();
  } else {
    writeComponents(out, target);
  }
}

void writeRegion(JsonWriter& out, const Region& region) {
  std::visit([&](const auto& shape) { beginShape(out, shape); }, region.shape);
  writePlace(out, region.position, region.orientation);
  if (region.during) writeSpan(out, "during", *region.during);
  if (region.keep == Region::Keep::shape) out.members("keep", "shape");
  if (region.margin) out.members("margin", *region.margin);
  out.endObject();
}

void writeRegions(JsonWriter& out, const std::vector<Region>& regions, Region::Side side) {
  std::vector<const Region*> chosen;
  for (const Region& region : regions)
    if (region.side == side) chosen.push_back(&region);
  if (chosen.empty()) return;
  out.key(side == Region::Side::avoid ? "avoid" : "inside");
  if (chosen.size() > 1) out.beginArray();
  for (const Region* region : chosen) writeRegion(out, *region);
  if (chosen.size() > 1) out.endArray();
}

/// The regions of the side that comes first in the constraint come first.
void writeBothSides(JsonWriter& out, const std::vector<Region>& regions) {
  if (regions.empty()) return;
  const bool avoids_first = regions.front().side == Region::Side::avoid;
  writeRegions(out, regions, regions.front().side);
  writeRegions(out, regions, avoids_first ? Region::Side::inside : Region::Side::avoid);
}

void requireTarget(const Target& target, const std::string& where) {
  if (isOneNumber(target) && target.value.size() != 1)
    throw InputError(where, "found " + std::to_string(target.value.size()) + " numbers, expected 1");
  for (const std::vector<TargetNumber>* numbers : {&target.value, &target.min, &target.max}) {
    for (const TargetNumber& value : *numbers)
      if (!value.isFree()) requireFinite(where, value);
    if (!numbers->empty() && numbers->size() != target.value.size())
      throw InputError(where, "found " + std::to_string(numbers->size()) + " limits, expected " +
                                  std::to_string(target.value.size()));
  }
  for (const double value : target.body_point) requireFinite(where + "/body_point", value);
}

void requireRegion(const Region& region, const std::string& where) {
  const auto* sphere = std::get_if<Sphere>(&region.shape);
  const Vec3 size = sphere != nullptr ? Vec3::Constant(sphere->radius) : std::get<Box>(region.shape).size;
  for (const double value : size) requireFinite(where + (sphere != nullptr ? "/sphere" : "/box"), value);
  for (const double value : region.position) requireFinite(where + "/position", value);
  for (const double value : region.orientation.coeffs()) requireFinite(where + "/orientation", value);
  if (region.margin) requireFinite(where + "/margin", *region.margin);
  if (!region.during) return;
  requireFinite(where + "/during/0", region.during->first);
  requireFinite(where + "/during/1", region.during->second);
}

bool hasTwoOfOneKind(const Constraint& constraint) {
  const std::vector<Target>& all = constraint.targets;
  return std::any_of(all.begin(), all.end(), [&](const Target& one) {
    return std::count_if(all.begin(), all.end(), [&](const Target& t) { return t.quantity == one.quantity; }) > 1;
  });
}

}  // namespace

void requireFinite(const std::string& where, double value) {
  if (!std::isfinite(value)) throw InputError(where, "found a number that is not finite, expected a number");
}

void requireWritable(const Constraint& constraint, const std::string& where) {
  if (constraint.hits && constraint.hits->during) {
    requireFinite(where + "/during/0", constraint.hits->during->first);
    requireFinite(where + "/during/1", constraint.hits->during->second);
  }
  requireFinite(where + "/at", constraint.at.time);
  if (constraint.soft) requireFinite(where + "/soft", *constraint.soft);
  if (constraint.at.span) {
    requireFinite(where + "/at/between/0", constraint.at.span->first);
    requireFinite(where + "/at/between/1", constraint.at.span->second);
    if (hasTwoOfOneKind(constraint))
      throw InputError(where,
                       "found two targets of one kind at one time of a span, expected one of each kind: in a "
                       "document they would be two constraints, each with a time of its own");
  }
  for (const Target& target : constraint.targets) requireTarget(target, where + "/" + target.quantity);
  for (const Region& region : constraint.regions)
    requireRegion(region, where + (region.side == Region::Side::avoid ? "/avoid" : "/inside"));
}

namespace {

void writeImpactOf(JsonWriter& out, const char* member, const std::optional<ImpactOf>& impact) {
  if (!impact) return;
  out.key(member).beginObject(Layout::line);
  out.members("body", impact->body, "impact", impact->n).unlessEmpty("with", impact->with);
  out.endObject();
}

void writeHit(JsonWriter& out, const Constraint& constraint) {
  const Hit& hit = *constraint.hits;
  out.beginObject(Layout::line).members("body", constraint.body, "hits", hit.with);
  if (hit.during) writeSpan(out, "during", *hit.during);
  writeImpactOf(out, "after", hit.after);
  writeImpactOf(out, "before", hit.before);
  out.unlessEmpty("notes", constraint.notes);
  out.endObject();
}

void writeSequence(JsonWriter& out, const Constraint& constraint) {
  out.beginObject(Layout::line).key("sequence").beginArray(Layout::line);
  for (const std::string& impact : constraint.sequence) out.value(impact);
  out.endArray().unlessEmpty("notes", constraint.notes);
  out.endObject();
}

}  // namespace

/// Members of an object differ, so that targets of one kind need objects of their own.
void writeConstraint(JsonWriter& out, const Constraint& constraint) {
  if (constraint.hits) return writeHit(out, constraint);
  if (!constraint.sequence.empty()) return writeSequence(out, constraint);
  std::vector<const Target*> left;
  for (const Target& target : constraint.targets) left.push_back(&target);
  bool first = true;
  while (first || !left.empty()) {
    out.beginObject(Layout::line);
    out.members("body", constraint.body);
    const bool at_instant =
        std::any_of(left.begin(), left.end(), [](auto* t) { return t->quantity != "closest_approach"; });
    if (at_instant) writeWhen(out, constraint.at);
    if (!left.empty()) out.unlessEmpty("relative_to", constraint.relative_to);
    std::vector<const Target*> written, next;
    for (const Target* target : left) {
      const bool again =
          std::any_of(written.begin(), written.end(), [&](auto* w) { return w->quantity == target->quantity; });
      if (!again) writeTarget(out, *target);
      (again ? next : written).push_back(target);
    }
    if (first) writeBothSides(out, constraint.regions);
    if (constraint.soft) out.members("soft", *constraint.soft);
    if (first) out.unlessEmpty("notes", constraint.notes);
    out.endObject();
    left = std::move(next);
    first = false;
  }
}

}  // namespace carom::formats_detail
