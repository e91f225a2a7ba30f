// SPDX-License-Identifier: MIT
#include <variant>

#include "adjoint/base/errors.h"
#include "formats/documents/scene_writer.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::detail {
namespace {

using Layout = JsonWriter::Layout;

void writeScale(JsonWriter& out, double scale) {
  if (scale != 1) out.key("scale").number(scale);
}

/// Writes what follows the word of a shape.
struct WriteShape {
  JsonWriter& out;

  void operator()(const Sphere& s) const { out.beginObject().key("radius").number(s.radius).endObject(); }
  void operator()(const Box& s) const { out.beginObject().key("size").vector(s.size).endObject(); }
  void operator()(const Plane& s) const {
    out.beginObject().key("normal").vector(s.normal).key("offset").number(s.offset).endObject();
  }
  void operator()(const Capsule& s) const { round(s.radius, s.height); }
  void operator()(const Cylinder& s) const { round(s.radius, s.height); }
  void operator()(const Hull& s) const {
    out.beginObject();
    if (s.file.empty()) {
      out.key("points").beginArray();
      for (const Vec3& vertex : s.surface->vertices) out.vector(vertex);
      out.endArray();
    } else {
      out.key("file").text(s.file);
    }
    writeScale(out, s.scale);
    out.endObject();
  }
  void operator()(const Mesh& s) const {
    out.beginObject().key("file").text(s.file);
    writeScale(out, s.scale);
    out.endObject();
  }
  void operator()(const Compound& s) const;

  void round(double radius, double height) const {
    out.beginObject().key("radius").number(radius).key("height").number(height).endObject();
  }
};

/// A shape of a few numbers stands on one line.
Layout layoutOf(const Shape& shape) {
  const Hull* hull = std::get_if<Hull>(&shape);
  const bool long_one = std::holds_alternative<Compound>(shape) || (hull != nullptr && hull->file.empty());
  return long_one ? Layout::block : Layout::line;
}

void writeKind(JsonWriter& out, const Shape& shape) {
  out.key(kindOf(shape).name);
  std::visit(WriteShape{out}, shape);
}

void WriteShape::operator()(const Compound& s) const {
  out.beginArray();
  for (const CompoundPart& part : s.parts) {
    out.beginObject(layoutOf(part.shape));
    writeKind(out, part.shape);
    if (!part.position.isZero(0)) out.key("position").vector(part.position);
    if (part.orientation.coeffs() != Quat::Identity().coeffs()) out.key("orientation").quaternion(part.orientation);
    out.endObject();
  }
  out.endArray();
}

}  // namespace

void writeShape(JsonWriter& out, const Shape& shape) {
  out.beginObject(layoutOf(shape));
  writeKind(out, shape);
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

}  // namespace carom::detail
