// SPDX-License-Identifier: MIT
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/surface_files.hpp"
#include "formats/drawing/triangle_mesh.hpp"
#include "formats/gltf/physics_nodes.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/parts.hpp"
#include "formats/shapes/rows.hpp"
#include "formats/svg/contours.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

Shape readMesh(const Json& value, const std::string& where, SurfaceFiles& files) {
  Mesh mesh;
  mesh.scale = scaleOf(value);
  mesh.file = value["file"].get<std::string>();
  mesh.surface = files.mesh(mesh.file, where + "/file");
  return mesh;
}

void writeMesh(JsonWriter& out, const Shape& s) {
  out.beginObject().key("file").text(std::get<Mesh>(s).file);
  writeScale(out, std::get<Mesh>(s).scale);
  out.endObject();
}

}  // namespace

FormatKind formatRow(KindOf<Mesh>) {
  return {
      .read = readMesh,
      .write = writeMesh,
      .on_one_line = onOneLine,
      .extent = [](const Shape& s, const ShapePose& at) {
        return surfaceExtent(*std::get<Mesh>(s).surface, std::get<Mesh>(s).scale, at);
      },
      .radius_about = [](const Shape& s, const Vec3& point) {
        return surfaceRadius(*std::get<Mesh>(s).surface, std::get<Mesh>(s).scale, point);
      },
      .contours =
          [](Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
            out.convex = false;
            addSurface(out, *std::get<Mesh>(s).surface, std::get<Mesh>(s).scale, at.x, at.q, viewer);
          },
      .mesh = [](const Shape& s, double) { return surfaceMesh(*std::get<Mesh>(s).surface, std::get<Mesh>(s).scale); },
      .collider = [](const ColliderAdder& out,
                     const Shape& s) { out.setSurface(*std::get<Mesh>(s).surface, std::get<Mesh>(s).scale, false); },
      .from_tapered = notTapered,
  };
}

}  // namespace carom::shapes
