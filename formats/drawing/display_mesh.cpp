// SPDX-License-Identifier: MIT
#include <algorithm>
#include <variant>

#include "adjoint/base/arguments.hpp"
#include "formats/base/turn_from_z.hpp"
#include "formats/drawing/display.h"
#include "formats/drawing/triangle_mesh.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace formats_detail;

namespace {

// The square of a plane lies about the origin and faces +z until it is turned to where the plane is.
TriangleMesh placedMesh(const Shape& shape, double plane_half_width) {
  const TriangleMesh mesh = meshOf(shape, plane_half_width);
  const Plane* plane = std::get_if<Plane>(&shape);
  if (!plane) return mesh;
  TriangleMesh placed;
  append(placed, mesh, plane->offset * plane->normal, turnFromZ(plane->normal));
  return placed;
}

std::vector<float> floatsOf(const std::vector<Vec3>& vectors) {
  std::vector<float> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors)
    for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(v[i]));
  return numbers;
}

}  // namespace

DisplayMesh displayMesh(const Scene& scene, int body, double plane_half_width) {
  const std::size_t b = checkedIndex("displayMesh", "body", body, scene.bodies.size());
  if (!(checkedNumber("displayMesh", "the half width", plane_half_width) > 0))
    refuseNumber("displayMesh", "the half width", plane_half_width, "a number above 0");
  TriangleMesh mesh = placedMesh(scene.bodies[b].shape, plane_half_width);
  return {floatsOf(mesh.positions), floatsOf(mesh.normals), std::move(mesh.triangles), std::move(mesh.accent)};
}

}  // namespace carom
