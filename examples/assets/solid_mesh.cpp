// SPDX-License-Identifier: MIT
#include "examples/assets/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <stdexcept>

namespace assets {
namespace {

double micrometres(double metres) { return std::round(metres * 1e6) + 0.0; }  // + 0.0: no negative zero

const Point& at(const SolidMesh& mesh, int i) { return mesh.points[static_cast<std::size_t>(i)]; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

int SolidMesh::add(const Point& point) {
  points.push_back(point);
  return static_cast<int>(points.size()) - 1;
}

void SolidMesh::addQuad(int a, int b, int c, int d) {
  addTriangle(a, b, c);
  addTriangle(a, c, d);
}

Grid revolve(SolidMesh& mesh, const std::vector<Circle>& profile, int columns,
             const std::vector<std::array<int, 2>>& left_out) {
  Grid grid;
  for (const auto& [radius, z] : profile) {
    std::vector<int> row;
    for (int j = 0; j < columns; ++j) {
      const double turn = 2 * std::numbers::pi * j / columns;
      const bool made = radius == 0 && j > 0;
      row.push_back(made ? row.front() : mesh.add({radius * std::cos(turn), radius * std::sin(turn), z}));
    }
    grid.push_back(row);
  }
  for (int i = 0; i + 1 < static_cast<int>(profile.size()); ++i)
    for (int j = 0; j < columns; ++j) {
      if (std::find(left_out.begin(), left_out.end(), std::array{i, j}) != left_out.end()) continue;
      const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
      const std::size_t next = (column + 1) % static_cast<std::size_t>(columns);
      const int a = grid[row][column], b = grid[row][next], c = grid[row + 1][next], d = grid[row + 1][column];
      if (a == b)
        mesh.addTriangle(a, c, d);
      else if (c == d)
        mesh.addTriangle(a, b, c);
      else
        mesh.addQuad(a, b, c, d);
    }
  return grid;
}

void dropUnused(SolidMesh& mesh) {
  std::vector<int> renamed(mesh.points.size(), -1);
  std::vector<Point> kept;
  for (Triangle& triangle : mesh.triangles)
    for (int& corner : triangle) {
      int& name = renamed[static_cast<std::size_t>(corner)];
      if (name < 0) {
        kept.push_back(at(mesh, corner));
        name = static_cast<int>(kept.size()) - 1;
      }
      corner = name;
    }
  mesh.points = kept;
}

void requireSolid(const SolidMesh& mesh, int handles) {
  std::map<std::array<int, 2>, int> edges;
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = at(mesh, t[0]), &b = at(mesh, t[1]), &c = at(mesh, t[2]);
    const Point area = cross(minus(b, a), minus(c, a));
    if (!(dot(area, area) > 1e-20)) throw std::logic_error("a triangle has no area");
    volume += dot(a, cross(b, c)) / 6;
    for (int k = 0; k < 3; ++k) ++edges[{t[static_cast<std::size_t>(k)], t[static_cast<std::size_t>((k + 1) % 3)]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge[1], edge[0]});
    if (count != 1 || back == edges.end()) throw std::logic_error("an edge does not have two triangles, one each way");
  }
  if (!(volume > 0)) throw std::logic_error("the surface is inside out");
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  const int euler = count(mesh.points) - count(edges) / 2 + count(mesh.triangles);
  if (euler != 2 - 2 * handles) throw std::logic_error("the surface has another number of handles");
}

std::string objText(const SolidMesh& mesh, const std::string& comment) {
  std::string out = "# " + comment + "\n# Made by examples/assets/make_assets.cpp. Metres, z up.\n";
  char line[100];
  for (const Point& p : mesh.points) {
    std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", micrometres(p[0]) / 1e6, micrometres(p[1]) / 1e6,
                  micrometres(p[2]) / 1e6);
    out += line;
  }
  for (const Triangle& t : mesh.triangles) {
    std::snprintf(line, sizeof line, "f %d %d %d\n", t[0] + 1, t[1] + 1, t[2] + 1);
    out += line;
  }
  return out;
}

}  // namespace assets
