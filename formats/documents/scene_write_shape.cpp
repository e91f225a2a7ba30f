// SPDX-License-Identifier: MIT
#include "adjoint/base/errors.h"
#include "formats/documents/scene_writer.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {

// A shape of a few numbers stands on one line.
void beginShape(JsonWriter& out, const Shape& shape) {
  const shapes::FormatKind& format = shapes::formatOf(shape);
  out.beginObject(format.on_one_line(shape) ? JsonWriter::Layout::line : JsonWriter::Layout::block);
  out.key(kindOf(shape).name);
  format.write(out, shape);
}

void writeShape(JsonWriter& out, const Shape& shape) {
  beginShape(out, shape);
  out.endObject();
}

void writePlace(JsonWriter& out, const Vec3& position, const Quat& orientation) {
  if (!position.isZero(0)) out.members("position", position);
  if (orientation.coeffs() != Quat::Identity().coeffs()) out.members("orientation", orientation);
}

void requireFiles(Shape shape, const std::string& where) {
  for (const shapes::SurfaceUse& use : shapes::surfacesOf(shape))
    if (!use.convex && use.file.empty())
      throw InputError(where + use.place,
                       "found a mesh made in memory, expected one with a file (a document names the files of meshes, "
                       "it does not hold meshes)");
}

}  // namespace carom::formats_detail
