// SPDX-License-Identifier: MIT
#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

Shape readMesh(const Json& value, const std::string& where, SurfaceFiles& files) {
  const auto file = value["file"].get<std::string>();
  return Mesh{files.find(file, where + "/file", false), scaleOf(value), file};
}

void writeMesh(JsonWriter& out, const Shape& s) {
  out.beginObject().members("file", std::get<Mesh>(s).file);
  writeScale(out, std::get<Mesh>(s).scale);
  out.endObject();
}

}  // namespace

FormatKind formatRow(KindOf<Mesh>) { return surfaceRow<Mesh>(readMesh, writeMesh, onOneLine); }

}  // namespace carom::shapes
