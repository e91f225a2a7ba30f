// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/exact/shape_numbers.h"

namespace carom::exact {

/// Where a shape's origin and axes are.
template <class T>
struct Pose {
  Vec<T> x;
  Mat<T> R = Mat<T>::identity();

  Vec<T> operator*(const Vec<T>& p) const { return x + R * p; }
};

/// One part of a piece's surface, without its ends: a point or a line with a radius about it, a plane, a circle.
enum class FeatureKind { point, line, circle, plane };
struct FeatureId {
  int piece = -1;
  FeatureKind kind = FeatureKind::point;
  int index = -1;
  bool operator==(const FeatureId&) const = default;
};
template <class T>
struct Feature {
  FeatureKind kind;
  Vec<T> at;     ///< the point; a point of the line or plane; the circle's centre
  Vec<T> along;  ///< unit: the line's direction, the plane's outward normal, the circle's axis
  T radius = 0;  ///< about the point or line; of the circle
  T slope = 0;   ///< of the side of a cone, a line from its apex: the sine of half the opening angle
};

/// A convex piece of a shape: the hull of `points` with `radius` about it; a cylinder from points[0] to points[1], or a
/// cone with its apex there; a half space. A mesh is as many pieces as it has triangles.
template <class T>
struct Piece {
  enum class Kind { rounded, cylinder, cone, half_space };
  struct Edge {
    int from, to;
  };
  struct Face {
    std::vector<int> corners;  ///< counter-clockwise; none for a half space and the caps of a cylinder
    Vec<T> normal;             ///< unit, outward
    int at = 0;                ///< a point of it
  };

  Kind kind = Kind::rounded;
  std::vector<Vec<T>> points;
  std::vector<Edge> edges;
  std::vector<Face> faces;
  T radius = 0;
  bool sheet = false;  ///< a triangle: its face can be met from both sides
  const char* point_name = "vertex";
  const char* edge_name = "edge";
  const char* face_name = "face";

  /// A feature of the piece, as it stands in the axes that its points are given in.
  Feature<T> feature(const FeatureId& id) const {
    switch (id.kind) {
      case FeatureKind::point:
        return {id.kind, points[id.index], {}, kind == Kind::cone ? T(0) : radius};
      case FeatureKind::line: {
        const Vec<T>&from = points[edges[id.index].from], &to = points[edges[id.index].to];
        if (kind == Kind::cone) {
          using std::sqrt;
          const Vec<T> up = to - from;
          return {id.kind, to, unit(up), 0, radius / sqrt(dot(up, up) + radius * radius)};
        }
        return {id.kind, from, unit(to - from), radius};
      }
      case FeatureKind::plane:
        return {id.kind, points[faces[id.index].at], faces[id.index].normal, 0};
      case FeatureKind::circle:
        return {id.kind, points[id.index], unit(points[1] - points[0]), radius};
    }
    throw std::logic_error("no such feature");
  }
  std::string nameOf(const FeatureId& id) const {
    const char* const names[] = {point_name, edge_name, "rim", face_name};
    return std::string(names[static_cast<int>(id.kind)]) + " " + std::to_string(id.index);
  }
};

/// The same feature, placed in the world.
template <class T>
Feature<T> placed(Feature<T> f, const Pose<T>& pose) {
  f.at = pose * f.at;
  f.along = pose.R * f.along;
  return f;
}

namespace detail {

template <class T>
Vec<T> areaOf(const std::vector<Vec<T>>& points, const std::vector<int>& corners) {
  Vec<T> area;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    area = area + cross(points[corners[i]] - points[corners[0]], points[corners[i + 1]] - points[corners[0]]);
  return area;
}

template <class T>
void addFace(Piece<T>& piece, std::vector<int> corners) {
  const Vec<T> normal = unit(areaOf(piece.points, corners));
  const int first = corners[0];
  piece.faces.push_back({std::move(corners), normal, first});
}

/// Every pair of neighbours in some face, once.
template <class T>
void addEdgesOfFaces(Piece<T>& piece) {
  std::map<std::pair<int, int>, bool> seen;
  for (const auto& face : piece.faces) {
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      const int from = face.corners[i], to = face.corners[(i + 1) % face.corners.size()];
      if (!seen.emplace(std::minmax(from, to), true).second) continue;
      piece.edges.push_back({from, to});
    }
  }
}

template <class T>
Piece<T> boxPiece(const std::vector<T>& size) {
  Piece<T> piece;
  for (int i = 0; i < 8; ++i)
    piece.points.push_back(
        {(i & 1 ? 1 : -1) * size[0] / 2, (i & 2 ? 1 : -1) * size[1] / 2, (i & 4 ? 1 : -1) * size[2] / 2});
  for (const std::vector<int>& corners : std::vector<std::vector<int>>{
           {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
    addFace(piece, corners);
  addEdgesOfFaces(piece);
  return piece;
}

/// Points on the axis at both ends; the piece is a capsule, or made into a cylinder.
template <class T>
Piece<T> axisPiece(const T& radius, const T& height) {
  Piece<T> piece;
  piece.points = {{0, 0, -height / 2}, {0, 0, height / 2}};
  piece.edges = {{0, 1}};
  piece.radius = radius;
  piece.point_name = "end", piece.edge_name = "side";
  return piece;
}

template <class T>
std::vector<Piece<T>> surfacePieces(const Surface& surface, const T& scale, bool convex) {
  std::vector<Vec<T>> points;
  for (const Vec3& v : surface.vertices) points.push_back(scale * Vec<T>(v));
  std::vector<Piece<T>> pieces;
  Piece<T> hull;
  hull.points = points;
  for (const Surface::Face& face : surface.faces) {
    const auto first = surface.corners.begin() + face.first;
    const std::vector<int> corners(first, first + face.count);
    if (convex) {
      addFace(hull, corners);
      continue;
    }
    Piece<T> triangle;
    triangle.sheet = true;
    for (int i : corners) triangle.points.push_back(points[i]);
    addFace(triangle, {0, 1, 2});
    addEdgesOfFaces(triangle);
    pieces.push_back(std::move(triangle));
  }
  if (!convex) return pieces;
  addEdgesOfFaces(hull);
  return {hull};
}

}  // namespace detail

/// All pieces of a shape, in its axes.
template <class T>
std::vector<Piece<T>> piecesOf(const ShapeNumbers<T>& n) {
  using Kind = typename ShapeNumbers<T>::Kind;
  Piece<T> piece;
  switch (n.kind) {
    case Kind::sphere:
      piece.points = {{}};
      piece.radius = n.size[0];
      piece.point_name = "sphere";
      return {piece};
    case Kind::box:
      return {detail::boxPiece(n.size)};
    case Kind::plane:
      piece.kind = Piece<T>::Kind::half_space;
      piece.points = {n.plane_offset * n.plane_normal};
      piece.faces = {{{}, n.plane_normal}};
      piece.face_name = "plane";
      return {piece};
    case Kind::capsule:
      return {detail::axisPiece(n.size[0], n.size[1])};
    case Kind::cylinder:
      piece = detail::axisPiece(n.size[0], n.size[1]);
      piece.kind = Piece<T>::Kind::cylinder;
      piece.faces = {{{}, unitVector<T>(2, -1), 0}, {{}, unitVector<T>(2, 1), 1}};
      piece.face_name = "cap";
      return {piece};
    case Kind::cone:
      piece = detail::axisPiece(n.size[0], n.size[1]);
      piece.kind = Piece<T>::Kind::cone;
      piece.faces = {{{}, unitVector<T>(2, -1), 0}};
      piece.point_name = "apex", piece.face_name = "base";
      return {piece};
    case Kind::hull:
    case Kind::mesh:
      return detail::surfacePieces(*n.surface, n.size[0], n.kind == Kind::hull);
    case Kind::compound:
      break;
  }
  std::vector<Piece<T>> all;
  for (const auto& part : n.parts) {
    for (Piece<T>& own : piecesOf(part.shape)) {
      for (Vec<T>& p : own.points) p = part.position + part.R * p;
      for (auto& face : own.faces) face.normal = part.R * face.normal;
      all.push_back(std::move(own));
    }
  }
  return all;
}

}  // namespace carom::exact
