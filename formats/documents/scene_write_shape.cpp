// SPDX-License-Identifier: MIT
#include <variant>

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

void requireFiles(const Shape& shape, const std::string& where) {
  const std::string place = where + "/" + kindOf(shape).name;
  if (const Mesh* mesh = std::get_if<Mesh>(&shape); mesh != nullptr && mesh->file.empty())
    throw InputError(place,
                     "found a mesh made in memory, expected one with a file (a document names the files of meshes, "
                     "it does not hold meshes)");
  if (const Compound* compound = std::get_if<Compound>(&shape))
    for (std::size_t i = 0; i < compound->parts.size(); ++i)
      requireFiles(compound->parts[i].shape, place + "/" + std::to_string(i));
}

}  // namespace carom::formats_detail
