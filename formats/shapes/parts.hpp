// SPDX-License-Identifier: MIT
// Private to formats/shapes/*.cpp: what rows are made of.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "formats/documents/scene_reader.hpp"
#include "formats/documents/surface_files.hpp"
#include "formats/drawing/triangle_mesh.hpp"
#include "formats/gltf/physics_nodes.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"
#include "formats/svg/contours.hpp"

namespace carom::shapes {

using namespace formats_detail;

inline Extent extentAround(const Vec3& middle, const Vec3& half) { return Extent(middle - half, middle + half); }
/// A disc with the unit normal a reaches r sqrt(1 - a_i^2) along axis i.
inline Vec3 reachOfDisc(double radius, const Vec3& normal) {
  return radius * (1 - normal.array().square()).max(0).sqrt().matrix();
}

inline double numberOf(const Json& value, const char* member) { return value[member].get<double>(); }

// What is round about z, of a radius and a height.
template <class S>
Shape readRound(const Json& value, const std::string&, SurfaceFiles&) {
  return S{numberOf(value, "radius"), numberOf(value, "height")};
}
template <class S>
void writeRound(JsonWriter& out, const Shape& s) {
  out.beginObject().members("radius", std::get<S>(s).radius, "height", std::get<S>(s).height).endObject();
}

// The member "scale" of hulls and meshes, which is left out where it is 1.
inline double scaleOf(const Json& value) { return value.value("scale", 1.0); }
inline void writeScale(JsonWriter& out, double scale) {
  if (scale != 1) out.members("scale", scale);
}

/// The row of hulls and of meshes: they differ in how they are read and written.
template <class S>
FormatKind surfaceRow(auto read, auto write, auto on_one_line) {
  return {
      .read = read,
      .write = write,
      .on_one_line = on_one_line,
      .surfaces =
          [](Shape& shape, const std::string& where, std::vector<SurfaceUse>& out) {
            S& s = std::get<S>(shape);
            const std::string place = where + "/" + kindOf(shape).name;
            out.push_back({shape, *s.surface, s.scale, s.file, place, std::same_as<S, Hull>});
          },
      .extent =
          [](const Shape& s, const ShapePose& at) {
            Extent extent;
            const double scale = std::get<S>(s).scale;
            for (const Vec3& p : std::get<S>(s).surface->vertices) extent.extend(at.x + at.q * (scale * p));
            return extent;
          },
      .radius_about =
          [](const Shape& s, const Vec3& point) {
            double most = 0;
            const double scale = std::get<S>(s).scale;
            for (const Vec3& p : std::get<S>(s).surface->vertices) most = std::max(most, (scale * p - point).norm());
            return most;
          },
      .contours =
          [](Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
            out.convex = out.convex && std::same_as<S, Hull>;
            addSurface(out, *std::get<S>(s).surface, std::get<S>(s).scale, at.x, at.q, viewer);
          },
      .mesh = [](const Shape& s, double) { return surfaceMesh(*std::get<S>(s).surface, std::get<S>(s).scale); },
      .collider =
          [](const ColliderAdder& out, const Shape& s) {
            out.setSurface(*std::get<S>(s).surface, std::get<S>(s).scale, std::same_as<S, Hull>);
          },
      .from_tapered = notTapered,
  };
}

}  // namespace carom::shapes
