// SPDX-License-Identifier: MIT
#include "formats/documents/scene_writer.hpp"
#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

const std::vector<CompoundPart>& partsOf(const Shape& s) { return std::get<Compound>(s).parts; }

Shape readCompound(const Json& value, const std::string& where, SurfaceFiles& files) {
  Compound compound;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string place = pointerTo(where, i);
    CompoundPart part{readShape(value[i], place, files)};
    if (value[i].contains("position")) part.position = readVector(value[i]["position"]);
    if (value[i].contains("orientation"))
      part.orientation = readQuaternion(value[i]["orientation"], place + "/orientation");
    compound.parts.push_back(std::move(part));
  }
  return compound;
}

void writeCompound(JsonWriter& out, const Shape& s) {
  out.beginArray();
  for (const CompoundPart& part : partsOf(s)) {
    beginShape(out, part.shape);
    writePlace(out, part.position, part.orientation);
    out.endObject();
  }
  out.endArray();
}

void compoundSurfaces(Shape& s, const std::string& where, std::vector<SurfaceUse>& out) {
  std::size_t i = 0;
  for (CompoundPart& part : std::get<Compound>(s).parts)
    formatOf(part.shape).surfaces(part.shape, where + "/compound/" + std::to_string(i++), out);
}

Extent compoundExtent(const Shape& s, const ShapePose& at) {
  Extent extent;
  for (const CompoundPart& part : partsOf(s))
    extent.extend(shapeExtent(part.shape, at.x + at.q * part.position, at.q * part.orientation));
  return extent;
}

double compoundRadius(const Shape& s, const Vec3& point) {
  double most = 0;
  for (const CompoundPart& part : partsOf(s))
    most = std::max(most, radiusAbout(part.shape, part.orientation.conjugate() * (point - part.position)));
  return most;
}

void compoundContours(Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
  out.convex = false;
  for (const CompoundPart& part : partsOf(s))
    addContours(out, part.shape, at.x + at.q * part.position, at.q * part.orientation, viewer);
}

TriangleMesh compoundMesh(const Shape& s, double plane_half_width) {
  TriangleMesh whole;
  for (const CompoundPart& part : partsOf(s))
    append(whole, meshOf(part.shape, plane_half_width), part.position, part.orientation);
  return whole;
}

void compoundCollider(const ColliderAdder& out, const Shape& s) {
  for (std::size_t i = 0; i < partsOf(s).size(); ++i) {
    const CompoundPart& part = partsOf(s)[i];
    gltf::PhysicsNode& child = out.addChild("part " + std::to_string(i));
    child.translation = part.position;
    child.rotation = part.orientation;
    const std::string below = child.name;
    ColliderAdder{child, below, out.material, out.meshes}.add(part.shape);
  }
}

}  // namespace

FormatKind formatRow(KindOf<Compound>) {
  return {
      .read = readCompound,
      .write = writeCompound,
      .on_one_line = [](const Shape&) { return false; },
      .surfaces = compoundSurfaces,
      .extent = compoundExtent,
      .radius_about = compoundRadius,
      .contours = compoundContours,
      .mesh = compoundMesh,
      .collider = compoundCollider,
      .from_tapered = notTapered,
  };
}

}  // namespace carom::shapes
