// SPDX-License-Identifier: MIT
#include "formats/json/json_place.hpp"

#include <cmath>

#include "formats/base/unit.hpp"

namespace carom::formats_detail {

void JsonPlace::requireObject() const {
  if (!value.is_object()) fail(pointer, describe(value), "an object");
}

std::optional<JsonPlace> JsonPlace::find(const char* member) const {
  requireObject();
  const auto found = value.find(member);
  if (found == value.end()) return std::nullopt;
  return JsonPlace{*found, pointerTo(pointer, member)};
}

JsonPlace JsonPlace::require(const char* member) const {
  if (const auto found = find(member)) return *found;
  fail(pointer, std::string("no member \"") + member + "\"", "one");
}

std::size_t JsonPlace::size() const {
  if (!value.is_array()) fail(pointer, describe(value), "an array");
  return value.size();
}

JsonPlace JsonPlace::at(std::size_t index) const { return {value[index], pointerTo(pointer, index)}; }

double JsonPlace::number() const {
  if (!value.is_number()) fail(pointer, describe(value), "a number");
  return value.get<double>();
}

bool JsonPlace::boolean() const {
  if (!value.is_boolean()) fail(pointer, describe(value), "true or false");
  return value.get<bool>();
}

const std::string& JsonPlace::text() const {
  if (!value.is_string()) fail(pointer, describe(value), "a text");
  return value.get_ref<const std::string&>();
}

Vec3 JsonPlace::vector() const {
  if (size() != 3) fail(pointer, describe(value), "an array of 3 numbers");
  return {at(0).number(), at(1).number(), at(2).number()};
}

Quat JsonPlace::quaternion() const {
  if (size() != 4) fail(pointer, describe(value), "an array of 4 numbers");
  const Quat q(at(3).number(), at(0).number(), at(1).number(), at(2).number());
  constexpr double kFloats = 1e-3;  // a few digits, as other programs write them
  if (!(std::abs(q.norm() - 1) <= kFloats)) fail(pointer, describe(value), "a unit quaternion [x, y, z, w]");
  return unitQuaternion(q);
}

int JsonPlace::index(std::size_t count, const char* what) const {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
    fail(pointer, describe(value),
         std::string("an index into ") + what + ", of which there are " + std::to_string(count));
  return static_cast<int>(value.get<std::uint64_t>());
}

std::optional<JsonPlace> extensionOf(const JsonPlace& place, const char* name) {
  const auto extensions = place.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::optional<JsonPlace> caromExtrasOf(const JsonPlace& place) {
  const auto extras = place.find("extras");
  if (!extras || !extras->value.is_object()) return std::nullopt;
  auto carom = extras->find("carom");
  if (!carom || !carom->value.is_object()) return std::nullopt;
  return carom;
}

}  // namespace carom::formats_detail
