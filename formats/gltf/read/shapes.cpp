// SPDX-License-Identifier: MIT
// Shapes of colliders -> our shapes.
#include "formats/gltf/read/shapes.hpp"

#include <cmath>
#include <numbers>

#include "adjoint/base/errors.h"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"
#include "ode_bridge/convex_hull.h"

namespace carom::gltf {

using namespace formats_detail;

namespace {

constexpr double kFloats = 1e-6;  // scales that differ by less differ by the rounding of floats

[[noreturn]] void fail(const PhysicsNode& node, const std::string& found, const std::string& expected) {
  throw errorAt(node, "found " + found + ", expected " + expected);
}

/// A scale as the file has it.
std::string text(const Vec3& v) {
  return "[" + numberText(v.x()) + ", " + numberText(v.z()) + ", " + numberText(v.y()) + "]";
}

bool near(double a, double b) { return std::abs(a - b) <= kFloats * std::max(a, b); }
double mean(double a, double b) { return a == b ? a : (a + b) / 2; }

/// Scale of an implicit shape along its axes; only sizes count, not mirrorings.
Vec3 axisScale(const PhysicsNode& node, const Mat3& stretch) {
  const Vec3 scale = stretch.diagonal().cwiseAbs();
  const Mat3 rest = stretch - Mat3(stretch.diagonal().asDiagonal());
  if (!(rest.cwiseAbs().maxCoeff() <= kFloats * scale.maxCoeff()))
    fail(node, "scales above it that shear its shape", "scales along the axes of the shape");
  if (!(scale.minCoeff() > 0)) fail(node, "a scale of " + text(scale), "one without zeros");
  return scale;
}

double uniformScale(const PhysicsNode& node, const Vec3& scale, const char* shape) {
  if (!near(scale.x(), scale.y()) || !near(scale.y(), scale.z()) || !near(scale.x(), scale.z()))
    fail(node, "a scale of " + text(scale) + " on a " + shape,
         "the same scale in every direction, which keeps it round");
  return scale.x() == scale.y() && scale.y() == scale.z() ? scale.x() : scale.mean();
}

// ---- what narrows, but not to a point: hulls of points on their surfaces ----

constexpr int kMeridians = 48;

void addRing(std::vector<Vec3>& points, double radius, double z) {
  if (radius == 0) {
    points.emplace_back(0, 0, z);
    return;
  }
  for (int i = 0; i < kMeridians; ++i) {
    const double turn = 2 * std::numbers::pi * i / kMeridians;
    points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
  }
}

std::vector<Vec3> tapered(const Tapered& shape) {
  std::vector<Vec3> points;
  constexpr int kParallels = kMeridians / 2;
  const double half = shape.height / 2;
  if (!shape.capsule) {
    addRing(points, shape.bottom, -half);
    addRing(points, shape.top, half);
    return points;
  }
  for (const auto& [radius, z] : {std::pair{shape.bottom, -half}, std::pair{shape.top, half}})
    for (int i = 0; i <= kParallels; ++i) {
      const double polar = std::numbers::pi * i / kParallels;
      const bool pole = i == 0 || i == kParallels;
      addRing(points, pole ? 0 : radius * std::sin(polar), z + radius * std::cos(polar));
    }
  return points;
}

Shape taperedHull(const Tapered& shape, const PhysicsNode& node, ImportReport& report) {
  // Chords of a circle stay within r (1 - cos(pi/n)) of it; a ball is cut by chords both ways.
  const double chord = 1 - std::cos(std::numbers::pi / kMeridians);
  const double within = std::max(shape.bottom, shape.top) * chord * (shape.capsule ? 2 : 1);
  Hull hull;
  hull.surface = convexHull(tapered(shape));
  report.warnings.push_back(node.label() + ": its " + (shape.capsule ? "capsule" : "cylinder") + " with two radii (" +
                            numberText(shape.bottom) + " and " + numberText(shape.top) + ") becomes a convex hull of " +
                            std::to_string(hull.surface->vertices.size()) + " points on it, at most " +
                            numberText(within) + " m inside it");
  return hull;
}

/// Square in the plane z = 0, facing z.
Shape sheetMesh(double size_x, double size_y) {
  const double x = size_x / 2, y = size_y / 2;
  Mesh mesh;
  mesh.surface = meshSurface({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, {{0, 1, 2}, {0, 2, 3}});
  return mesh;
}

/// A cone stands on its wide end.
bool isTurnedOver(const Tapered& shape, const Mat3& stretch) {
  return !shape.capsule && (stretch(2, 2) < 0 ? shape.top : shape.bottom) == 0;
}

struct Maker {
  const PhysicsNode& node;
  const Mat3& stretch;
  ImportReport& report;

  std::optional<Shape> operator()(const Sphere& sphere) const {
    return Sphere{sphere.radius * uniformScale(node, axisScale(node, stretch), "sphere")};
  }
  std::optional<Shape> operator()(const Box& box) const { return Box{box.size.cwiseProduct(axisScale(node, stretch))}; }
  std::optional<Shape> operator()(const Tapered& shape) const {
    const Vec3 scale = axisScale(node, stretch);
    Tapered out = shape;
    if (shape.capsule) {
      const double factor = uniformScale(node, scale, "capsule");
      out.height *= factor, out.bottom *= factor, out.top *= factor;
    } else {
      if (!near(scale.x(), scale.y()))
        fail(node, "a scale of " + text(scale) + " on a cylinder along y", "the same in x and z, which keeps it round");
      const double across = mean(scale.x(), scale.y());
      out.height *= scale.z(), out.bottom *= across, out.top *= across;
    }
    if (isTurnedOver(shape, stretch) != (stretch(2, 2) < 0)) std::swap(out.bottom, out.top);
    for (const shapes::FormatKind& kind : shapes::formatKinds())
      if (auto made = kind.from_tapered(out)) return made;
    return taperedHull(out, node, report);
  }
  std::optional<Shape> operator()(const Sheet& sheet) const {
    const Vec3 scale = axisScale(node, stretch);
    if (sheet.size_x && sheet.size_y) return sheetMesh(*sheet.size_x * scale.x(), *sheet.size_y * scale.y());
    if (sheet.size_x || sheet.size_y) {
      report.warnings.push_back(node.label() +
                                ": its collider is ignored: planes infinite in one direction are not supported");
      return std::nullopt;
    }
    if (sheet.double_sided)
      report.warnings.push_back(
          node.label() + ": its plane is solid on the side away from its normal: an infinite plane has one side");
    return Plane{};
  }
  std::optional<Shape> operator()(const MeshShape&) const { return std::nullopt; }  // see ShapeMaker::make
};

}  // namespace

Quat axesOf(const ColliderShape& shape, const Mat3& stretch) {
  const auto* tapered = std::get_if<Tapered>(&shape);
  const bool turned_over =
      tapered ? isTurnedOver(*tapered, stretch) : std::holds_alternative<Sheet>(shape) && stretch(2, 2) < 0;
  return turned_over ? Quat(0, 1, 0, 0) : Quat::Identity();
}

std::optional<Shape> ShapeMaker::make(const PhysicsNode& node, const Mat3& stretch, bool solid) try {
  const ColliderShape& shape = node.collider->shape;
  if (stretch.isZero(0)) {
    report_.warnings.push_back(node.label() + ": its collider is ignored: a scale of 0 turns it off");
    return std::nullopt;
  }
  const auto* mesh = std::get_if<MeshShape>(&shape);
  if (mesh == nullptr) return std::visit(Maker{node, stretch, report_}, shape);
  if (!(std::abs(stretch.determinant()) > 0)) fail(node, "a scale of 0 along an axis of its mesh", "one without zeros");
  const double scale = stretch(0, 0);
  const bool uniform = scale > 0 && stretch == Mat3(scale * Mat3::Identity());
  const auto surface = surfaceOf(*mesh, uniform ? Mat3(Mat3::Identity()) : stretch, solid);
  if (mesh->convex) return Hull{surface, uniform ? scale : 1, ""};
  return Mesh{surface, uniform ? scale : 1, ""};
} catch (const InputError& error) {
  if (error.where() == errorAt(node, "").where()) throw;
  throw errorAt(node, error.what());
}

}  // namespace carom::gltf
