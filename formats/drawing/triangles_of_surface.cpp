// SPDX-License-Identifier: MIT
#include "formats/drawing/triangle_mesh.hpp"

namespace carom::formats_detail {

namespace {

// Faces that meet at a smaller angle than 25 degrees are shaded as one bent surface.
constexpr double kSmoothCosine = 0.906;

// The faces at each vertex: faces[first[v] .. first[v + 1]).
struct FacesAtVertices {
  std::vector<int> first, faces;

  explicit FacesAtVertices(const Surface& surface) : first(surface.vertices.size() + 1, 0) {
    for (const int v : surface.corners) ++first[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    faces.resize(surface.corners.size());
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
      for (int k = 0; k < surface.faces[f].count; ++k) {
        const int v = surface.corners[static_cast<std::size_t>(surface.faces[f].first + k)];
        faces[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<int>(f);
      }
  }
};

std::vector<Vec3> areaNormals(const Surface& surface) {
  std::vector<Vec3> out;
  for (const Surface::Face& face : surface.faces) {
    const auto corner = [&](int k) -> const Vec3& {
      return surface.vertices[static_cast<std::size_t>(surface.corners[static_cast<std::size_t>(face.first + k)])];
    };
    Vec3 sum = Vec3::Zero();
    for (int k = 1; k + 1 < face.count; ++k) sum += (corner(k) - corner(0)).cross(corner(k + 1) - corner(0));
    out.push_back(sum);
  }
  return out;
}

}  // namespace

void addSurface(TriangleMesh& mesh, const Surface& surface, double scale) {
  const FacesAtVertices at(surface);
  const std::vector<Vec3> areas = areaNormals(surface);
  for (const Surface::Face& face : surface.faces) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < face.count; ++k) {
      const auto v = static_cast<std::size_t>(surface.corners[static_cast<std::size_t>(face.first + k)]);
      Vec3 normal = Vec3::Zero();
      for (int i = at.first[v]; i < at.first[v + 1]; ++i) {
        const auto other = static_cast<std::size_t>(at.faces[static_cast<std::size_t>(i)]);
        if (surface.faces[other].normal.dot(face.normal) > kSmoothCosine) normal += areas[other];
      }
      mesh.positions.push_back(scale * surface.vertices[v]);
      mesh.normals.push_back(normal.normalized());
    }
    for (int k = 1; k + 1 < face.count; ++k)
      for (const int i : {0, k, k + 1}) mesh.triangles.push_back(first + static_cast<std::uint32_t>(i));
  }
}

}  // namespace carom::formats_detail
