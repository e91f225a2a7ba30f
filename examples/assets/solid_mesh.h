// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

namespace assets {

using Point = std::array<double, 3>;
using Triangle = std::array<int, 3>;

/// A closed surface of triangles, counter-clockwise seen from outside. Metres, z up.
struct SolidMesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;

  int add(const Point& point);
  void addTriangle(int a, int b, int c) { triangles.push_back({a, b, c}); }
  void addQuad(int a, int b, int c, int d);
};

/// A circle about z, or a point of it where the radius is 0.
struct Circle {
  double radius, z;
};

/// Points of the circles: index [circle][column]; a point of the axis is the same in all columns.
using Grid = std::vector<std::vector<int>>;

/// Turns a profile about z, with so many columns. The profile runs round the solid with its inside to the left, from
/// the axis to the axis. Quads named in `left_out` {circle, column} are not made.
Grid revolve(SolidMesh& mesh, const std::vector<Circle>& profile, int columns,
             const std::vector<std::array<int, 2>>& left_out = {});

/// Drops points that no triangle has.
void dropUnused(SolidMesh& mesh);

/// Throws std::logic_error unless every edge has two triangles that run through it in opposite directions, no triangle
/// is degenerate, the volume is positive and the surface has so many handles (of a ball 0, of a ring 1).
void requireSolid(const SolidMesh& mesh, int handles);

/// Wavefront OBJ; coordinates in whole micrometres.
std::string objText(const SolidMesh& mesh, const std::string& comment);

}  // namespace assets
