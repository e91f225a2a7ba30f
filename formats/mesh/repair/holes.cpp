// SPDX-License-Identifier: MIT
// Holes, and lids for small ones.
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "adjoint/base/refuse.hpp"
#include "formats/mesh/repair/loose_mesh.hpp"
#include "formats/mesh/repair/triangulate.hpp"

namespace carom::mesh_repair {
namespace {

// What all lids of a piece may have of its area, or of that of the mesh if that is no more than kMost of the piece's; the
// edges of a hole; and what a loose piece may have of the area of the mesh.
constexpr double kOfPiece = 0.05, kOfMesh = 0.02, kMost = 0.25, kLoose = 0.01;
constexpr std::size_t kMostEdges = 300;

struct Hole {
  std::vector<int> half_edges;  ///< once round
  std::vector<std::array<int, 3>> lid;  ///< of the hole's vertices from the last to the first
  double area = 0, width = 0;
  Vec3 middle = Vec3::Zero();
};

double areaOf(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a).norm(); }

/// The next half-edge on the boundary, past the triangles that share its end.
int nextOnBoundary(const LooseMesh& mesh, int h) {
  h = LooseMesh::next(h);
  while (mesh.twin(h) >= 0) h = LooseMesh::next(mesh.twin(h));
  return h;
}

Hole holeAt(const LooseMesh& mesh, int first, std::vector<char>& seen) {
  Hole hole;
  Eigen::AlignedBox3d box;
  for (int h = first; !seen[static_cast<std::size_t>(h)]; h = nextOnBoundary(mesh, h)) {
    seen[static_cast<std::size_t>(h)] = 1;
    hole.half_edges.push_back(h);
    box.extend(mesh.at(mesh.from(h)));
  }
  hole.width = box.sizes().norm(), hole.middle = box.center();
  return hole;
}

/// False where the hole can have no lid of at most this area. No lid is smaller than the hole as it is seen from where it
/// is widest.
bool findLid(const LooseMesh& mesh, Hole& hole, double most) {
  if (hole.half_edges.size() == 2) return true;  // its sides become twins
  if (hole.half_edges.size() > kMostEdges) return false;
  Vec3 seen = Vec3::Zero();
  for (const int h : hole.half_edges)
    seen += 0.5 * (mesh.at(mesh.from(h)) - hole.middle).cross(mesh.at(mesh.to(h)) - hole.middle);
  if (!(seen.norm() <= most)) return false;
  std::vector<Vec3> polygon;
  for (auto h = hole.half_edges.rbegin(); h != hole.half_edges.rend(); ++h) polygon.push_back(mesh.at(mesh.from(*h)));
  hole.lid = triangulate(polygon);
  for (const auto& t : hole.lid)
    hole.area += areaOf(polygon[static_cast<std::size_t>(t[0])], polygon[static_cast<std::size_t>(t[1])],
                        polygon[static_cast<std::size_t>(t[2])]);
  return !hole.lid.empty();
}

void joinTwins(LooseMesh& mesh, int a, int b) {
  mesh.twins[static_cast<std::size_t>(a)] = b;
  mesh.twins[static_cast<std::size_t>(b)] = a;
}

/// Vertex k of the lid is where half-edge n - 1 - k of the hole begins, so that from vertex k to the next the lid runs
/// against half-edge n - 2 - k.
void putLid(LooseMesh& mesh, const Hole& hole) {
  const int n = static_cast<int>(hole.half_edges.size());
  if (n == 2) return joinTwins(mesh, hole.half_edges[0], hole.half_edges[1]);
  const auto ofHole = [&](int i) { return hole.half_edges[static_cast<std::size_t>((i + n) % n)]; };
  std::vector<std::array<int, 3>> inside;  // from, to, half-edge
  const int line = mesh.lines[static_cast<std::size_t>(hole.half_edges[0] / 3)];
  for (const auto& triangle : hole.lid) {
    const int first = mesh.halfEdges();
    LooseMesh::Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.from(ofHole(n - 1 - triangle[k]));
    mesh.add(corners, line);
    mesh.twins.resize(mesh.twins.size() + 3, -1);
    for (int k = 0; k < 3; ++k) {
      const int from = triangle[static_cast<std::size_t>(k)], to = triangle[static_cast<std::size_t>((k + 1) % 3)];
      if (to == (from + 1) % n) {
        joinTwins(mesh, first + k, ofHole(n - 2 - from));
        continue;
      }
      const auto other = std::find_if(inside.begin(), inside.end(), [&](const auto& e) { return e[0] == to && e[1] == from; });
      if (other != inside.end()) joinTwins(mesh, first + k, (*other)[2]);
      else inside.push_back({from, to, first + k});
    }
  }
}

/// The pieces of a mesh with their areas and holes.
struct Pieces {
  std::vector<int> of;  ///< of each triangle
  std::vector<double> area;
  std::vector<std::vector<Hole>> holes;

  explicit Pieces(const LooseMesh& mesh) {
    int count = 0;
    of = piecesOf(mesh, count);
    area.assign(static_cast<std::size_t>(count), 0);
    holes.resize(area.size());
    for (std::size_t t = 0; t < of.size(); ++t) {
      const LooseMesh::Triangle& corners = mesh.triangles[t];
      area[static_cast<std::size_t>(of[t])] += areaOf(mesh.at(corners[0]), mesh.at(corners[1]), mesh.at(corners[2]));
    }
    std::vector<char> seen(static_cast<std::size_t>(mesh.halfEdges()), 0);
    for (int h = 0; h < static_cast<int>(seen.size()); ++h)
      if (mesh.twin(h) < 0 && !seen[static_cast<std::size_t>(h)])
        holes[static_cast<std::size_t>(of[static_cast<std::size_t>(h / 3)])].push_back(holeAt(mesh, h, seen));
  }
  double whole() const { return std::accumulate(area.begin(), area.end(), 0.0); }
};

/// Whether lids for all holes of a piece are small enough; finds them.
bool findLids(const LooseMesh& mesh, std::vector<Hole>& holes, double of_piece, double of_mesh) {
  double room = std::max(kOfPiece * of_piece, std::min(kMost * of_piece, kOfMesh * of_mesh));
  for (Hole& hole : holes) {
    if (!findLid(mesh, hole, room)) return false;
    room -= hole.area;
  }
  return room >= 0;
}

}  // namespace

void closeHoles(LooseMesh& mesh, Repairs& repairs) {
  Pieces pieces(mesh);
  const double whole = pieces.whole();
  std::size_t closed = 0;
  double lids = 0;
  const Hole* widest = nullptr;
  for (std::size_t p = 0; p < pieces.holes.size(); ++p) {
    if (!findLids(mesh, pieces.holes[p], pieces.area[p], whole)) continue;
    for (const Hole& hole : pieces.holes[p]) {
      putLid(mesh, hole);
      if (!widest || hole.width > widest->width) widest = &hole;
      ++closed, lids += hole.area;
    }
  }
  if (!widest) return;
  repairs.push_back(countOf(closed, "hole") + " closed, " + adjoint_detail::about(lids, 2) + " m^2 in all (" +
                    (closed == 1 ? "" : "the widest ") + adjoint_detail::about(widest->width, 2) + " m across, around " +
                    adjoint_detail::aboutPlace(widest->middle) + " m)");
}

void dropLoose(LooseMesh& mesh, Repairs& repairs) {
  const Pieces pieces(mesh);
  const double whole = pieces.whole();
  double loose = 0;
  for (std::size_t p = 0; p < pieces.holes.size(); ++p)
    if (!pieces.holes[p].empty()) loose += pieces.area[p];
  if (!(loose <= kLoose * whole)) return;
  std::vector<char> kept(mesh.triangles.size(), 1);
  CountedTriangles dropped;
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (!pieces.holes[static_cast<std::size_t>(pieces.of[t])].empty()) {
      dropped.add(mesh.lines[t]);
      kept[t] = 0;
    }
  if (dropped.count == 0) return;
  std::vector<int> place(kept.size());  // whole pieces go, so that no twin of what stays does
  int next = 0;
  for (std::size_t t = 0; t < kept.size(); ++t) place[t] = kept[t] ? next++ : -1;
  std::vector<int> twins;
  for (std::size_t h = 0; h < mesh.twins.size(); ++h)
    if (kept[h / 3]) twins.push_back(3 * place[static_cast<std::size_t>(mesh.twins[h] / 3)] + mesh.twins[h] % 3);
  keepTriangles(mesh, kept);
  mesh.twins = std::move(twins);
  dropped.tell(repairs, "that bound no solid dropped, less than 1 % of the area");
}

}  // namespace carom::mesh_repair
