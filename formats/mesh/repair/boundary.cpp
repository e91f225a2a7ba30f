// SPDX-License-Identifier: MIT
// What nearly meets at the boundary of a mesh, and is joined.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "adjoint/base/refuse.hpp"
#include "adjoint/numeric/union_find.hpp"
#include "formats/mesh/repair/loose_mesh.hpp"
#include "formats/mesh/repair/triangulate.hpp"

namespace carom::mesh_repair {
namespace {

constexpr double kNear = 1e-6;  // of the diagonal: the last digit of files with six

std::vector<int> boundaryOf(const LooseMesh& mesh) {
  std::vector<int> half_edges;
  forEachEdge(edgeUses(mesh), [&](const std::vector<EdgeUse>& uses) {
    if (uses.size() == 1) half_edges.push_back(uses.front().half_edge);
  });
  return half_edges;
}

/// Vertices at the ends of half-edges, by x.
class SortedVertices {
 public:
  SortedVertices(const LooseMesh& mesh, const std::vector<int>& half_edges) : mesh_(mesh) {
    for (const int h : half_edges) vertices_.push_back(mesh.from(h)), vertices_.push_back(mesh.to(h));
    std::sort(vertices_.begin(), vertices_.end(), [&](int a, int b) {
      return mesh.at(a).x() != mesh.at(b).x() ? mesh.at(a).x() < mesh.at(b).x() : a < b;
    });
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }
  const std::vector<int>& all() const { return vertices_; }

  template <class Function>
  void forEachBetween(double low, double high, const Function& f) const {
    auto v = std::lower_bound(vertices_.begin(), vertices_.end(), low, [&](int a, double x) { return mesh_.at(a).x() < x; });
    for (; v != vertices_.end() && mesh_.at(*v).x() <= high; ++v) f(*v);
  }

 private:
  const LooseMesh& mesh_;
  std::vector<int> vertices_;
};

struct PlaceOnEdge {
  double share;
  int vertex;
};

std::vector<PlaceOnEdge> verticesOn(const LooseMesh& mesh, int h, const SortedVertices& vertices, double near) {
  const Vec3 &a = mesh.at(mesh.from(h)), &b = mesh.at(mesh.to(h)), along = b - a;
  std::vector<PlaceOnEdge> found;
  vertices.forEachBetween(std::min(a.x(), b.x()) - near, std::max(a.x(), b.x()) + near, [&](int v) {
    const Vec3& p = mesh.at(v);
    const double share = (p - a).dot(along) / along.squaredNorm();
    if (!(share > 0 && share < 1) || v == mesh.opposite(h)) return;
    if ((p - a).norm() > near && (p - b).norm() > near && (p - a - share * along).norm() <= near)
      found.push_back({share, v});
  });
  std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.share < q.share; });
  return found;
}

}  // namespace

void weldBoundary(LooseMesh& mesh, Repairs& repairs) {
  const double near = kNear * mesh.diagonal();
  std::vector<int> edges(static_cast<std::size_t>(mesh.halfEdges()));
  std::iota(edges.begin(), edges.end(), 0);
  const SortedVertices boundary(mesh, boundaryOf(mesh)), all(mesh, edges);
  adjoint_detail::UnionFind welded(mesh.vertices.size());
  const auto find = [&](int v) { return static_cast<int>(welded.find(static_cast<std::size_t>(v))); };
  std::size_t count = 0;
  double furthest = 0;
  for (const int v : boundary.all())
    all.forEachBetween(mesh.at(v).x() - near, mesh.at(v).x() + near, [&](int w) {
      const double apart = (mesh.at(w) - mesh.at(v)).norm();
      const int a = find(v), b = find(w);
      if (a == b || apart > near) return;
      welded.join(static_cast<std::size_t>(std::max(a, b)), static_cast<std::size_t>(std::min(a, b)));
      furthest = std::max(furthest, apart), ++count;
    });
  if (count == 0) return;
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = find(v);
  repairs.push_back((count == 1 ? "1 vertex" : std::to_string(count) + " vertices") + " welded to another at most " +
                    adjoint_detail::about(furthest, 2) + " m away");
}

void splitAtVertices(LooseMesh& mesh, Repairs& repairs) {
  const double near = kNear * mesh.diagonal();
  const std::vector<int> edges = boundaryOf(mesh);
  const SortedVertices boundary(mesh, edges);
  std::vector<std::vector<PlaceOnEdge>> on(static_cast<std::size_t>(mesh.halfEdges()));
  std::vector<char> split(mesh.triangles.size(), 0);
  for (const int h : edges) {
    on[static_cast<std::size_t>(h)] = verticesOn(mesh, h, boundary, near);
    if (!on[static_cast<std::size_t>(h)].empty()) split[static_cast<std::size_t>(h / 3)] = 1;
  }
  std::size_t count = 0;
  const std::size_t before = mesh.triangles.size();
  std::vector<char> kept(before, 1);
  for (std::size_t t = 0; t < before; ++t) {
    if (!split[t]) continue;
    std::vector<int> corners;
    for (int h = static_cast<int>(3 * t); h < static_cast<int>(3 * t) + 3; ++h) {
      corners.push_back(mesh.from(h));
      for (const PlaceOnEdge& place : on[static_cast<std::size_t>(h)]) corners.push_back(place.vertex);
    }
    std::vector<Vec3> polygon;
    for (const int v : corners) polygon.push_back(mesh.at(v));
    const auto triangles = triangulate(polygon);
    if (triangles.empty()) continue;
    kept[t] = 0;
    count += corners.size() - 3;
    const int line = mesh.lines[t];
    for (const auto& triangle : triangles) {
      LooseMesh::Triangle placed;
      for (std::size_t i = 0; i < 3; ++i) placed[i] = corners[static_cast<std::size_t>(triangle[i])];
      mesh.add(placed, line);
    }
  }
  if (count == 0) return;
  kept.resize(mesh.triangles.size(), 1);
  keepTriangles(mesh, kept);
  repairs.push_back(countOf(count, "edge") + " split at a vertex on " + (count == 1 ? "it" : "them"));
}

}  // namespace carom::mesh_repair
