// SPDX-License-Identifier: MIT
// Edges of more than two triangles.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/numeric/elementary.hpp"
#include "formats/mesh/repair/loose_mesh.hpp"
#include "formats/mesh/repair/triangulate.hpp"

namespace carom::mesh_repair {
namespace {

constexpr double kSameAngle = 1e-9;  // rad
constexpr double kTurn = 2 * 3.14159265358979323846;

/// A triangle at an edge: its angle about the edge from low to high, and whether it runs along it that way. Then the solid
/// is on the side of smaller angles, else on that of larger ones.
struct Leaf {
  double angle;
  bool forward;
  int half_edge;
};

std::vector<Leaf> leavesAround(const LooseMesh& mesh, const std::vector<EdgeUse>& uses) {
  const Vec3 &low = mesh.at(uses.front().low), &high = mesh.at(uses.front().high);
  const Vec3 along = (high - low).stableNormalized();
  Vec3 x = Vec3::Zero(), y = Vec3::Zero();
  std::vector<Leaf> leaves;
  for (const EdgeUse& use : uses) {
    const Vec3 to = mesh.at(mesh.opposite(use.half_edge)) - low, across = (to - along.dot(to) * along).stableNormalized();
    if (leaves.empty()) x = across, y = along.cross(x);
    double angle = leaves.empty() ? 0 : elementary::atan2(across.dot(y), across.dot(x));
    if (angle < 0) angle += kTurn;
    if (angle > kTurn - kSameAngle) angle = 0;
    leaves.push_back({angle, mesh.from(use.half_edge) == use.low, use.half_edge});
  }
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
  // Of those on each other first the end of one solid, then the beginning of the next.
  for (std::size_t i = 0, end = 0; i < leaves.size(); i = end) {
    while (end < leaves.size() && leaves[end].angle <= leaves[i].angle + kSameAngle) ++end;
    std::stable_sort(leaves.begin() + static_cast<std::ptrdiff_t>(i), leaves.begin() + static_cast<std::ptrdiff_t>(end),
                     [](const Leaf& a, const Leaf& b) { return a.forward > b.forward; });
  }
  return leaves;
}

/// Once round, and once more for solids that lie across the beginning.
void pairLeaves(LooseMesh& mesh, const std::vector<Leaf>& leaves) {
  std::vector<int> begun;
  for (std::size_t i = 0; i < 2 * leaves.size(); ++i) {
    const Leaf& leaf = leaves[i % leaves.size()];
    int& twin = mesh.twins[static_cast<std::size_t>(leaf.half_edge)];
    if (twin >= 0) continue;
    if (!leaf.forward) {
      if (i < leaves.size()) begun.push_back(leaf.half_edge);
    } else if (!begun.empty()) {
      twin = begun.back();
      mesh.twins[static_cast<std::size_t>(begun.back())] = leaf.half_edge;
      begun.pop_back();
    }
  }
}

}  // namespace

void pairEdges(LooseMesh& mesh, Repairs& repairs) {
  mesh.twins.assign(static_cast<std::size_t>(mesh.halfEdges()), -1);
  std::size_t parted = 0, cut = 0;
  Vec3 where_parted = Vec3::Zero(), where_cut = Vec3::Zero();
  forEachEdge(edgeUses(mesh), [&](const std::vector<EdgeUse>& uses) {
    if (uses.size() == 1) return;
    pairLeaves(mesh, leavesAround(mesh, uses));
    const bool all = std::all_of(uses.begin(), uses.end(), [&](const EdgeUse& u) { return mesh.twin(u.half_edge) >= 0; });
    if (uses.size() == 2 && all) return;
    const Vec3 middle = 0.5 * (mesh.at(uses.front().low) + mesh.at(uses.front().high));
    if (all) {
      if (parted++ == 0) where_parted = middle;
    } else if (cut++ == 0) {
      where_cut = middle;
    }
  });
  const auto at = [](const Vec3& p) { return " (the first at " + adjoint_detail::aboutPlace(p) + " m)"; };
  if (parted > 0)
    repairs.push_back(countOf(parted, "edge") + " of more than two triangles parted between the solids that meet there" +
                      at(where_parted));
  if (cut > 0)
    repairs.push_back(countOf(cut, "edge") + " where triangles bound no solid together cut open" + at(where_cut));
}

bool hasCrowdedEdges(const LooseMesh& mesh) {
  bool crowded = false;
  forEachEdge(edgeUses(mesh), [&](const std::vector<EdgeUse>& uses) { crowded = crowded || uses.size() > 2; });
  return crowded;
}

void separateEdges(LooseMesh& mesh) {
  std::vector<int> middle(static_cast<std::size_t>(mesh.halfEdges()), -1);
  forEachEdge(edgeUses(mesh), [&](const std::vector<EdgeUse>& uses) {
    std::vector<int> apart;  // one half-edge of each pair, and those without a twin
    for (const EdgeUse& use : uses) {
      const int twin = mesh.twin(use.half_edge);
      if (twin < 0 || use.half_edge < twin) apart.push_back(use.half_edge);
    }
    // Nowhere near the middle of the edge, where a vertex may be.
    for (std::size_t k = 1; k < apart.size(); ++k) {
      const double share = (static_cast<double>(k) - 0.0625) / static_cast<double>(apart.size());
      const int vertex = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(mesh.at(uses.front().low) + share * (mesh.at(uses.front().high) - mesh.at(uses.front().low)));
      middle[static_cast<std::size_t>(apart[k])] = vertex;
      if (mesh.twin(apart[k]) >= 0) middle[static_cast<std::size_t>(mesh.twin(apart[k]))] = vertex;
    }
  });
  std::vector<char> kept(mesh.triangles.size(), 1);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    std::vector<int> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners.push_back(mesh.triangles[t][k]);
      if (middle[3 * t + k] >= 0) corners.push_back(middle[3 * t + k]);
    }
    if (corners.size() == 3) continue;
    std::vector<Vec3> polygon;
    for (const int v : corners) polygon.push_back(mesh.at(v));
    const auto triangles = triangulate(polygon);
    if (triangles.empty()) continue;
    kept[t] = 0;
    const int line = mesh.lines[t];
    for (const auto& triangle : triangles)
      mesh.add({corners[static_cast<std::size_t>(triangle[0])], corners[static_cast<std::size_t>(triangle[1])],
                corners[static_cast<std::size_t>(triangle[2])]}, line);
  }
  kept.resize(mesh.triangles.size(), 1);
  keepTriangles(mesh, kept);
  mesh.twins.clear();
}

}  // namespace carom::mesh_repair
