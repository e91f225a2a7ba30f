// SPDX-License-Identifier: MIT
#include "formats/mesh/repair/loose_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "adjoint/scene/surface.h"

namespace carom::mesh_repair {

double LooseMesh::diagonal() const {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : triangles)
    for (const int v : triangle) box.extend(at(v));
  return box.isEmpty() ? 0 : box.sizes().norm();
}

std::string countOf(std::size_t n, const char* thing) { return std::to_string(n) + " " + thing + (n == 1 ? "" : "s"); }

void CountedTriangles::tell(Repairs& repairs, const std::string& what) const {
  if (count == 0) return;
  const std::string first = line > 0 ? " (the first at line " + std::to_string(line) + ")" : "";
  repairs.push_back(countOf(count, "triangle") + " " + what + first);
}

std::vector<EdgeUse> edgeUses(const LooseMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(static_cast<std::size_t>(mesh.halfEdges()));
  for (int h = 0; h < mesh.halfEdges(); ++h)
    uses.push_back({std::min(mesh.from(h), mesh.to(h)), std::max(mesh.from(h), mesh.to(h)), h});
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
  });
  return uses;
}

bool isFlat(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kFlattest = 1e-12;  // as of meshSurface
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const double shortest = std::min({(b - a).stableNorm(), (c - b).stableNorm(), (a - c).stableNorm()});
  const double area = std::max({(b - a).cross(c - a).norm(), (c - b).cross(a - b).norm(), (a - c).cross(b - c).norm()});
  return !(area > kFlattest * longest) || !(shortest >= kLeastLength);
}

void keepTriangles(LooseMesh& mesh, const std::vector<char>& kept) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t]) mesh.triangles[count] = mesh.triangles[t], mesh.lines[count] = mesh.lines[t], ++count;
  mesh.triangles.resize(count);
  mesh.lines.resize(count);
}

std::vector<int> piecesOf(const LooseMesh& mesh, int& count) {
  std::vector<int> piece(mesh.triangles.size(), -1);
  count = 0;
  std::vector<int> waiting;
  for (std::size_t first = 0; first < piece.size(); ++first) {
    if (piece[first] >= 0) continue;
    waiting.push_back(static_cast<int>(first));
    piece[first] = count;
    while (!waiting.empty()) {
      const int t = waiting.back();
      waiting.pop_back();
      for (int h = 3 * t; h < 3 * t + 3; ++h) {
        const auto beside = static_cast<std::size_t>(mesh.twin(h) / 3);
        if (mesh.twin(h) < 0 || piece[beside] >= 0) continue;
        piece[beside] = count;
        waiting.push_back(static_cast<int>(beside));
      }
    }
    ++count;
  }
  return piece;
}

}  // namespace carom::mesh_repair
