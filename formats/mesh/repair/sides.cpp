// SPDX-License-Identifier: MIT
// Which side of its triangles a mesh has outside.
#include <Eigen/Geometry>
#include <algorithm>

#include "formats/mesh/repair/loose_mesh.hpp"

namespace carom::mesh_repair {
namespace {

/// Turns triangles over. Where there are twins, all of a piece must be turned.
void turnTriangles(LooseMesh& mesh, const std::vector<char>& turned) {
  const auto turnedTwin = [&](int h) {
    return h < 0 || !turned[static_cast<std::size_t>(h / 3)] ? h : h - h % 3 + 2 - h % 3;
  };
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (!turned[t]) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    if (!mesh.twins.empty()) std::swap(mesh.twins[3 * t], mesh.twins[3 * t + 2]);
  }
  for (int& twin : mesh.twins) twin = turnedTwin(twin);
}

/// For each half-edge the one on the other side of an edge of two triangles; -1 elsewhere.
std::vector<int> acrossEdgesOfTwo(const LooseMesh& mesh) {
  std::vector<int> across(static_cast<std::size_t>(mesh.halfEdges()), -1);
  forEachEdge(edgeUses(mesh), [&](const std::vector<EdgeUse>& uses) {
    if (uses.size() != 2) return;
    across[static_cast<std::size_t>(uses[0].half_edge)] = uses[1].half_edge;
    across[static_cast<std::size_t>(uses[1].half_edge)] = uses[0].half_edge;
  });
  return across;
}

/// The triangles joined to one by edges of two, each with 1 if it looks the other way; the fewer of them are to be turned.
void markTurned(const LooseMesh& mesh, const std::vector<int>& across, std::size_t first, std::vector<signed char>& side) {
  std::vector<std::size_t> piece{first};
  side[first] = 0;
  std::size_t others = 0;
  for (std::size_t i = 0; i < piece.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const int h = static_cast<int>(3 * piece[i] + k), twin = across[static_cast<std::size_t>(h)];
      if (twin < 0 || side[static_cast<std::size_t>(twin / 3)] >= 0) continue;
      const auto t = static_cast<std::size_t>(twin / 3);
      const bool alike = mesh.from(h) != mesh.from(twin);  // opposite ways along the edge
      side[t] = static_cast<signed char>(alike ? side[piece[i]] : 1 - side[piece[i]]);
      others += static_cast<std::size_t>(side[t]);
      piece.push_back(t);
    }
  if (2 * others <= piece.size()) return;
  for (const std::size_t t : piece) side[t] = static_cast<signed char>(1 - side[t]);
}

struct ClosedPiece {
  bool closed = true;
  double volume = 0;
  Eigen::AlignedBox3d box;
};

std::vector<ClosedPiece> measured(const LooseMesh& mesh, const std::vector<int>& piece, int count) {
  std::vector<ClosedPiece> pieces(static_cast<std::size_t>(count));
  std::vector<int> origin(pieces.size(), -1);  // a corner of the piece, so that what is far away loses no digits
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const auto p = static_cast<std::size_t>(piece[t]);
    const LooseMesh::Triangle& corners = mesh.triangles[t];
    if (origin[p] < 0) origin[p] = corners[0];
    const Vec3& o = mesh.at(origin[p]);
    const Vec3 a = mesh.at(corners[0]) - o, b = mesh.at(corners[1]) - o, c = mesh.at(corners[2]) - o;
    pieces[p].volume += a.dot(b.cross(c)) / 6;
    for (const int v : corners) pieces[p].box.extend(mesh.at(v));
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.twins[3 * t + k] < 0) pieces[p].closed = false;
  }
  return pieces;
}

}  // namespace

void turnAlike(LooseMesh& mesh, Repairs& repairs) {
  const std::vector<int> across = acrossEdgesOfTwo(mesh);
  std::vector<signed char> side(mesh.triangles.size(), -1);
  for (std::size_t t = 0; t < side.size(); ++t)
    if (side[t] < 0) markTurned(mesh, across, t, side);
  std::vector<char> turned(side.size(), 0);
  CountedTriangles wrong;
  for (std::size_t t = 0; t < side.size(); ++t)
    if (side[t] == 1) {
      wrong.add(mesh.lines[t]);
      turned[t] = 1;
    }
  if (wrong.count == 0) return;
  turnTriangles(mesh, turned);
  wrong.tell(repairs, std::string("turned over to look the way of those beside ") + (wrong.count == 1 ? "it" : "them"));
}

void turnOutward(LooseMesh& mesh, Repairs& repairs) {
  int count = 0;
  const std::vector<int> piece = piecesOf(mesh, count);
  const std::vector<ClosedPiece> pieces = measured(mesh, piece, count);
  double whole = 0;
  for (const ClosedPiece& p : pieces)
    if (p.closed) whole += p.volume;
  const double sign = whole < 0 ? -1 : 1;  // a mesh inside out as a whole keeps its hollows
  std::vector<char> wrong(pieces.size(), 0);
  std::size_t many = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const ClosedPiece& p = pieces[i];
    const double volume = sign * p.volume;
    const bool hollow = volume < 0 && std::any_of(pieces.begin(), pieces.end(), [&](const ClosedPiece& around) {
                          return around.closed && sign * around.volume > -volume && around.box.contains(p.box);
                        });
    wrong[i] = p.closed && (sign < 0) != (volume < 0 && !hollow);
    many += static_cast<std::size_t>(wrong[i]);
  }
  if (many == 0) return;
  std::vector<char> turned(piece.size(), 0);
  for (std::size_t t = 0; t < piece.size(); ++t) turned[t] = wrong[static_cast<std::size_t>(piece[t])];
  turnTriangles(mesh, turned);
  repairs.push_back(many == 1 && count == 1 ? "the mesh turned inside out" : countOf(many, "closed piece") + " turned inside out");
}

}  // namespace carom::mesh_repair
