// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "adjoint/base/refuse.hpp"
#include "adjoint/numeric/two_part.hpp"
#include "adjoint/scene/polygons.hpp"
#include "adjoint/scene/surface.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using Triangle = std::array<int, 3>;

constexpr double kFlattest = 1e-12;  // least (twice the area) / (longest side)^2: below, the normal has few digits left
constexpr double kThinnest = 1e-12;  // least volume / (area x extent) of a closed mesh: below, its sign is rounding

std::string nameOf(const char* item, std::size_t i) { return std::string(item) + " " + std::to_string(i); }

void checkNumbers(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  if (vertices.empty() || triangles.empty())
    refuse("", "found a mesh of ", vertices.size(), " vertices and ", triangles.size(),
           " triangles, expected a triangle or more");
  if (triangles.size() > std::size_t{100'000'000})
    refuse("", "found a mesh of ", triangles.size(), " triangles, expected at most 100000000");
  checkCoordinates(vertices, "vertex");
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int v : triangles[t])
      if (v < 0 || static_cast<std::size_t>(v) >= vertices.size())
        refuse(nameOf("triangle", t), "found vertex ", v, ", expected 0 to ", vertices.size() - 1);
}

void checkTriangle(std::size_t t, const std::vector<Vec3>& vertices, const std::vector<int>& triangle) {
  const auto at = [&](int k) -> const Vec3& {
    return vertices[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)])];
  };
  double longest = 0;  // squared
  for (int k = 0; k < 3; ++k) {
    const Vec3 side = at((k + 1) % 3) - at(k);
    if (side == Vec3::Zero())
      refuse(nameOf("triangle", t), "found two corners at the same place, expected three places");
    if (const double length = side.stableNorm(); !(length >= kLeastLength))
      refuse(nameOf("triangle", t), "found a side of ", about(length), " m, expected at least ", about(kLeastLength),
             " m");
    longest = std::max(longest, side.squaredNorm());
  }
  double area = 0;  // twice; the largest of the three ways to compute it errs on the side of the triangle
  for (int k = 0; k < 3; ++k) area = std::max(area, (at((k + 1) % 3) - at(k)).cross(at((k + 2) % 3) - at(k)).norm());
  if (!(area > kFlattest * longest))
    refuse(nameOf("triangle", t), "found corners on one line (area ", about(area / 2), " m^2 at a longest side of ",
           about(std::sqrt(longest)), " m), expected a triangle with an area");
}

// Vertices are named by the numbers they were written with.
void checkEdges(const Polygons& triangles) {
  const std::vector<HalfEdge> sides = halfEdges(triangles);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const HalfEdge &a = sides[i - 1], &b = sides[i];
    if (!a.beside(b)) continue;
    const std::string edge = "edge from vertex " + std::to_string(a.low) + " to " + std::to_string(a.high);
    if (i + 1 < sides.size() && sides[i + 1].beside(a))
      refuse(edge, "found it in triangles ", a.face, ", ", b.face, " and ", sides[i + 1].face,
             ", expected at most two");
    if (a.forward == b.forward)
      refuse(edge, "found triangles ", a.face, " and ", b.face,
             " both running along it in one direction, expected opposite ones (corners counter-clockwise seen from "
             "outside)");
  }
}

// Faces joined by edges.
struct Piece {
  std::size_t first_triangle = 0;
  double volume = 0, area = 0;
  Eigen::AlignedBox3d box;
};

// For each face the least one that it is joined to.
std::vector<int> leastJoined(const Surface& s) {
  std::vector<int> least(s.faces.size());
  std::iota(least.begin(), least.end(), 0);
  const auto find = [&](int f) {
    while (least[static_cast<std::size_t>(f)] != f) {
      int& up = least[static_cast<std::size_t>(f)];
      f = up = least[static_cast<std::size_t>(up)];
    }
    return f;
  };
  for (const Surface::Edge& e : s.edges) {
    if (e.right < 0) continue;
    const int a = find(e.left), b = find(e.right);
    least[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  for (std::size_t f = 0; f < least.size(); ++f) least[f] = find(static_cast<int>(f));
  return least;
}

std::vector<Piece> piecesOf(const Surface& s) {
  const std::vector<int> least = leastJoined(s);
  std::vector<Piece> pieces;
  std::vector<std::size_t> number(s.faces.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    const auto corner = [&](std::size_t face, int k) -> const Vec3& { return s.corner(s.faces[face], k); };
    const auto root = static_cast<std::size_t>(least[f]);
    const Vec3& origin = corner(root, 0);
    if (root == f) number[f] = pieces.size(), pieces.push_back({f, 0, 0, {}});
    Piece& piece = pieces[number[root]];
    piece.volume += tripleProduct(origin, corner(f, 0), corner(f, 1), corner(f, 2)) / 6;
    piece.area += crossProduct(corner(f, 0), corner(f, 1), corner(f, 2)).norm() / 2;
    for (int k = 0; k < 3; ++k) piece.box.extend(corner(f, k));
  }
  return pieces;
}

// A piece may be inside out where it bounds a hollow of another.
void checkVolume(const Surface& s) {
  const std::vector<Piece> pieces = piecesOf(s);
  for (const Piece& piece : pieces) {
    const std::string where =
        pieces.size() > 1 ? nameOf("triangle", piece.first_triangle) + " and those joined to it" : "";
    const double least = kThinnest * piece.area * piece.box.sizes().norm();
    if (std::abs(piece.volume) <= least)
      refuse(where, "found a closed mesh without volume (", about(piece.volume), " m^3), expected one > 0");
    const auto around = [&](const Piece& p) { return p.volume > -piece.volume && p.box.contains(piece.box); };
    if (piece.volume < 0 && std::none_of(pieces.begin(), pieces.end(), around))
      refuse(where, "found a closed mesh inside out (volume ", about(piece.volume),
             " m^3), expected corners counter-clockwise seen from outside");
  }
  const Mat3 covariance = s.unit_inertia.trace() / 2 * Mat3::Identity() - s.unit_inertia;
  const Vec3 spread = Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(s.volume > 0) || !(spread[0] > -kThinnest * spread[2]))  // of a thin plate the least is rounding
    refuse("", "found a closed mesh that overlaps itself so that no body has its mass properties, expected a solid");
}

}  // namespace

std::shared_ptr<const Surface> meshSurface(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  checkNumbers(vertices, triangles);
  const std::vector<int> first = firstOfEqual(vertices);
  Polygons joined;
  joined.reserve(triangles.size());
  for (const Triangle& corners : triangles) {
    std::vector<int>& triangle = joined.emplace_back();
    for (int v : corners) triangle.push_back(first[static_cast<std::size_t>(v)]);
    checkTriangle(joined.size() - 1, vertices, triangle);
  }
  checkEdges(joined);
  std::vector<Vec3> kept = keepUsed(joined, vertices);
  auto surface = std::make_shared<Surface>(assembleSurface(std::move(kept), joined));
  if (surface->closed) checkVolume(*surface);
  return surface;
}

}  // namespace carom
