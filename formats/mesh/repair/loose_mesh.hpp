// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/mesh/triangle_soup.h"

/// Private to formats/mesh/: the steps of repairMesh, each a function of a mesh that says what it changed.
namespace carom::mesh_repair {

/// A mesh while it is repaired. Half-edge 3 t + i runs along triangle t from corner i to the next one.
struct LooseMesh {
  using Triangle = std::array<int, 3>;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<int> lines;  ///< in the file, one per triangle; 0: none
  std::vector<int> twins;  ///< half-edge along the same edge on its other side, one per half-edge; -1: a boundary

  int halfEdges() const { return static_cast<int>(3 * triangles.size()); }
  int from(int half_edge) const { return triangles[static_cast<std::size_t>(half_edge / 3)][static_cast<std::size_t>(half_edge % 3)]; }
  int to(int half_edge) const { return from(next(half_edge)); }
  int opposite(int half_edge) const { return from(next(next(half_edge))); }
  static int next(int half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
  const Vec3& at(int vertex) const { return vertices[static_cast<std::size_t>(vertex)]; }
  int twin(int half_edge) const { return twins[static_cast<std::size_t>(half_edge)]; }
  void add(const Triangle& corners, int line) { triangles.push_back(corners), lines.push_back(line); }
  /// Of the box about all vertices, m.
  double diagonal() const;
};

/// What was done, a phrase each: "2 triangles without area dropped (the first at line 12)".
using Repairs = std::vector<std::string>;

/// "1 triangle", "2 triangles".
std::string countOf(std::size_t n, const char* thing);

/// Triangles to which the same was done.
struct CountedTriangles {
  std::size_t count = 0;
  int line = 0;  ///< of the first; 0: none is known

  void add(int at) {
    if (count++ == 0) line = at;
  }
  /// "2 triangles dropped (the first at line 12)"; nothing if there are none.
  void tell(Repairs& repairs, const std::string& what) const;
};

/// Half-edges that run along the same edge either way stand together, in their order.
struct EdgeUse {
  int low, high, half_edge;
  bool sameEdge(const EdgeUse& o) const { return low == o.low && high == o.high; }
};
std::vector<EdgeUse> edgeUses(const LooseMesh& mesh);
/// Calls f(uses of one edge), for each edge.
template <class Function>
void forEachEdge(const std::vector<EdgeUse>& uses, const Function& f) {
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    while (end < uses.size() && uses[end].sameEdge(uses[i])) ++end;
    f(std::vector<EdgeUse>(uses.begin() + static_cast<std::ptrdiff_t>(i), uses.begin() + static_cast<std::ptrdiff_t>(end)));
  }
}

/// Whether a triangle has no area, to the measure of meshSurface.
bool isFlat(const Vec3& a, const Vec3& b, const Vec3& c);
/// Triangles whose entry is not 0 stay.
void keepTriangles(LooseMesh& mesh, const std::vector<char>& kept);

/// For each triangle the number of its piece: triangles joined by twins.
std::vector<int> piecesOf(const LooseMesh& mesh, int& count);

/// Vertices at one place become one (not told: a file may give every triangle its own); then triangles with two corners
/// at one place, with corners on one line, and all but one of those with the same corners are dropped.
void dropUseless(LooseMesh& mesh, Repairs& repairs);
/// Of two triangles with the same corners that look opposite ways: both go where solids meet in them, one stays of a
/// sheet drawn from both sides.
void dropCovered(LooseMesh& mesh, Repairs& repairs);
/// A vertex on the boundary that is no further from another than a millionth of the mesh's diagonal becomes that.
void weldBoundary(LooseMesh& mesh, Repairs& repairs);
/// A vertex of the boundary on a boundary edge, to that distance, becomes a corner of the triangle there.
void splitAtVertices(LooseMesh& mesh, Repairs& repairs);
/// Triangles joined by an edge of two are turned to one side.
void turnAlike(LooseMesh& mesh, Repairs& repairs);
/// Fills in `twins`: of an edge of more than two triangles those are twins that have the solid between them.
void pairEdges(LooseMesh& mesh, Repairs& repairs);
/// The holes of a piece get lids if these have together at most 5 % of its area, or 2 % of that of the mesh.
void closeHoles(LooseMesh& mesh, Repairs& repairs);
/// Pieces that are open go if they have together at most 1 % of the area.
void dropLoose(LooseMesh& mesh, Repairs& repairs);
/// Closed pieces that are inside out are turned, but for hollows of others.
void turnOutward(LooseMesh& mesh, Repairs& repairs);
/// Pairs of twins that share both ends with others, and boundary edges that do, get a vertex of their own in the middle.
void separateEdges(LooseMesh& mesh);
/// Whether edges of more than two triangles are left: those within triangles that lay on each other when they were split.
bool hasCrowdedEdges(const LooseMesh& mesh);

}  // namespace carom::mesh_repair
