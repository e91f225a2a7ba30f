#include <tiny_gltf.h>

#include <cmath>
#include <limits>

#include "formats/detail/gltf_physics.hpp"
#include "formats/detail/json.hpp"
#include "formats/scene_json.h"

namespace carom {
namespace {

using tinygltf::Value;

// tinygltf drops a null from an array; a NaN it writes as null, which is how a document leaves a component free.
Value valueOf(const detail::Json& json) {
  if (json.is_null()) return Value(std::numeric_limits<double>::quiet_NaN());
  if (json.is_boolean()) return Value(json.get<bool>());
  if (json.is_string()) return Value(json.get<std::string>());
  if (json.is_number_integer() && std::abs(json.get<double>()) < 1e9) return Value(json.get<int>());
  if (json.is_number()) return Value(json.get<double>());
  if (json.is_array()) {
    Value::Array items;
    for (const auto& item : json) items.push_back(valueOf(item));
    return Value(items);
  }
  Value::Object members;
  for (const auto& [key, item] : json.items()) members[key] = valueOf(item);
  return Value(members);
}

}  // namespace

Value editOf(const Document& document, const Scene& scene) {
  Document whole = document;
  whole.scene = scene;
  const detail::Json json = detail::parseJson(writeDocument(whole));
  Value::Object out;
  for (const char* member : {"duration", "controls", "constraints"}) {
    const auto found = json.find(member);
    if (found != json.end() && !found->empty()) out[member] = valueOf(*found);  // an empty list would become null
  }
  return Value(out);
}

}  // namespace carom
