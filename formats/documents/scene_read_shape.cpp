// SPDX-License-Identifier: MIT
#include <cmath>

#include "adjoint/base/errors.h"
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/surface_files.hpp"
#include "formats/json/json.hpp"
#include "ode_bridge/convex_hull.h"

namespace carom::detail {
namespace {

double scaleOf(const Json& value) {
  const auto scale = value.find("scale");
  return scale == value.end() ? 1 : scale->get<double>();
}

Shape readSphere(const Json& value, const std::string&, SurfaceFiles&) { return Sphere{value["radius"].get<double>()}; }

Shape readBox(const Json& value, const std::string&, SurfaceFiles&) { return Box{readVector(value["size"])}; }

Shape readCapsule(const Json& value, const std::string&, SurfaceFiles&) {
  return Capsule{value["radius"].get<double>(), value["height"].get<double>()};
}

Shape readCylinder(const Json& value, const std::string&, SurfaceFiles&) {
  return Cylinder{value["radius"].get<double>(), value["height"].get<double>()};
}

Shape readPlane(const Json& value, const std::string& where, SurfaceFiles&) {
  Vec3 normal = readVector(value["normal"]);
  const double length = normal.stableNorm();
  if (!(length > 0)) fail(where + "/normal", describe(value["normal"]), "a vector that is not 0");
  if (std::abs(normal.squaredNorm() - 1) > kUnitRounding) normal = (normal / length).normalized();
  const auto offset = value.find("offset");
  return Plane{normal, offset == value.end() ? 0 : offset->get<double>()};
}

std::shared_ptr<const Surface> hullOfPoints(const Json& value, const std::string& where) {
  std::vector<Vec3> points;
  for (const Json& point : value) points.push_back(readVector(point));
  try {
    return convexHull(points);
  } catch (const InputError& error) {
    throw InputError(where, error.what());
  }
}

Shape readHull(const Json& value, const std::string& where, SurfaceFiles& files) {
  const auto points = value.find("points"), file = value.find("file");
  if ((points == value.end()) == (file == value.end()))
    fail(where, points == value.end() ? describe(value) : "both \"points\" and \"file\"",
         "one of \"points\" and \"file\"");
  Hull hull;
  hull.scale = scaleOf(value);
  if (file == value.end()) {
    hull.surface = hullOfPoints(*points, where + "/points");
  } else {
    hull.file = file->get<std::string>();
    hull.surface = files.hull(hull.file, where + "/file");
  }
  return hull;
}

Shape readMesh(const Json& value, const std::string& where, SurfaceFiles& files) {
  Mesh mesh;
  mesh.scale = scaleOf(value);
  mesh.file = value["file"].get<std::string>();
  mesh.surface = files.mesh(mesh.file, where + "/file");
  return mesh;
}

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

struct ShapeReader {
  const char* name;
  Shape (*read)(const Json& value, const std::string& where, SurfaceFiles& files);
};
constexpr ShapeReader kShapes[] = {{"sphere", readSphere},   {"box", readBox},           {"plane", readPlane},
                                   {"capsule", readCapsule}, {"cylinder", readCylinder}, {"hull", readHull},
                                   {"mesh", readMesh},       {"compound", readCompound}};

}  // namespace

Shape readShape(const Json& value, const std::string& where, SurfaceFiles& files) {
  const ShapeReader* kind = nullptr;
  for (const ShapeReader& shape : kShapes) {
    if (!value.contains(shape.name)) continue;
    if (kind != nullptr)
      fail(where, "both \"" + std::string(kind->name) + "\" and \"" + shape.name + "\"", "one shape");
    kind = &shape;
  }
  if (kind == nullptr) fail(where, describe(value), "a shape");
  return kind->read(value[kind->name], pointerTo(where, kind->name), files);
}

}  // namespace carom::detail
