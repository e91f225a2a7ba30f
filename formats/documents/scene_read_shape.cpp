// SPDX-License-Identifier: MIT
#include "formats/documents/scene_reader.hpp"
#include "formats/json/json.hpp"
#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {

Shape readShape(const Json& value, const std::string& where, SurfaceFiles& files) {
  const shapes::FormatKind* kind = nullptr;
  std::string word;
  for (std::size_t i = 0; i < shapes::formatKinds().size(); ++i) {
    const char* name = shapeKinds()[i].name;
    if (!value.contains(name)) continue;
    if (kind != nullptr) fail(where, "both \"" + word + "\" and \"" + name + "\"", "one shape");
    kind = &shapes::formatKinds()[i];
    word = name;
  }
  if (kind == nullptr) fail(where, describe(value), "a shape");
  return kind->read(value[word], pointerTo(where, word), files);
}

}  // namespace carom::formats_detail
