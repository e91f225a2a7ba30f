// SPDX-License-Identifier: MIT
// Makes the meshes of the example scenes.
//   make_assets FOLDER           writes mug.obj, cup.obj and pin.obj there
//   make_assets --check FOLDER   tells whether the files there are what it would write
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numbers>

#include "examples/assets/solid_mesh.h"

namespace assets {
namespace {

// The outer wall of the mug between two rows has a hole of 2 x 2 quads; its border are the 8 points around it.
struct Opening {
  int middle_row;
  double z;
};

constexpr int kMugColumns = 32;
constexpr double kMugRadius = 0.04;
constexpr Opening kLower{5, 0.026}, kUpper{9, 0.070};

// Point k of 8 around an opening of the grid about column 0, counter-clockwise from outside for up = 1.
int borderPoint(const Grid& grid, const Opening& opening, int k, int up) {
  constexpr int kAcross[] = {1, 1, 0, -1, -1, -1, 0, 1}, kUp[] = {0, 1, 1, 1, 0, -1, -1, -1};
  const int row = opening.middle_row + up * kUp[k], column = (kAcross[k] + kMugColumns) % kMugColumns;
  return grid[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
}

// A tube of 8 sides from the upper opening out, down and back into the lower one, along half an ellipse.
void addHandle(SolidMesh& mesh, const Grid& grid) {
  constexpr int kRings = 12;
  constexpr double kOut = 0.030, kHalfWidth = 0.0065, kHalfThickness = 0.0045;
  const double middle = 0.5 * (kUpper.z + kLower.z), drop = 0.5 * (kUpper.z - kLower.z);
  std::vector<int> last, next;
  for (int i = 0; i <= kRings; ++i) {
    const double t = std::numbers::pi * i / kRings;
    const double nx = drop * std::sin(t), nz = kOut * std::cos(t), length = std::hypot(nx, nz);
    next.clear();
    for (int k = 0; k < 8; ++k) {
      if (i == 0 || i == kRings) {
        next.push_back(i == 0 ? borderPoint(grid, kUpper, k, 1) : borderPoint(grid, kLower, k, -1));
        continue;
      }
      const double turn = std::numbers::pi * k / 4;
      const double across = kHalfWidth * std::cos(turn), out = kHalfThickness * std::sin(turn) / length;
      next.push_back(
          mesh.add({kMugRadius + kOut * std::sin(t) + out * nx, across, middle + drop * std::cos(t) + out * nz}));
    }
    for (std::size_t k = 0; i > 0 && k < 8; ++k) mesh.addQuad(last[k], last[(k + 1) % 8], next[(k + 1) % 8], next[k]);
    last = next;
  }
}

SolidMesh mug() {
  const std::vector<Circle> profile = {
      {0, 0},         {0.033, 0},     {0.038, 0.003},  {0.040, 0.010},                                        // foot
      {0.040, 0.018}, {0.040, 0.026}, {0.040, 0.034},  {0.040, 0.048},   {0.040, 0.062},                      // wall
      {0.040, 0.070}, {0.040, 0.078}, {0.040, 0.093},  {0.0390, 0.0948}, {0.0370, 0.0948}, {0.0360, 0.0930},  // rim
      {0.036, 0.052}, {0.036, 0.013}, {0.032, 0.0075}, {0, 0.006}};                                           // inside
  std::vector<std::array<int, 2>> holes;
  for (const Opening& opening : {kLower, kUpper})
    for (const int row : {opening.middle_row - 1, opening.middle_row})
      for (const int column : {kMugColumns - 1, 0}) holes.push_back({row, column});
  SolidMesh mesh;
  const Grid grid = revolve(mesh, profile, kMugColumns, holes);
  addHandle(mesh, grid);
  dropUnused(mesh);
  requireSolid(mesh, 1);
  return mesh;
}

// A wide cup whose wall leans outwards; its floor is round at the edge.
SolidMesh cup() {
  SolidMesh mesh;
  revolve(mesh,
          {{0, 0},
           {0.066, 0},
           {0.072, 0.006},
           {0.105, 0.158},
           {0.105, 0.162},
           {0.102, 0.164},
           {0.099, 0.162},
           {0.068, 0.026},
           {0.063, 0.016},
           {0.052, 0.011},
           {0, 0.010}},
          36);
  requireSolid(mesh, 0);
  return mesh;
}

// The convex hull of a ten-pin bowling pin: 15 inches high, diameters as the sport's rules give them; the neck, which
// is hollow, is left out.
SolidMesh pin() {
  constexpr double kInch = 0.0254;
  const std::vector<std::array<double, 2>> diameter_height = {{2.031, 0},     {2.828, 0.75},   {3.906, 2.25},
                                                              {4.510, 3.375}, {4.766, 4.5},    {4.563, 5.875},
                                                              {2.547, 13.5},  {2.206, 14.364}, {1.274, 14.829}};
  std::vector<Circle> profile = {{0, 0}};
  for (const auto& [diameter, height] : diameter_height) profile.push_back({diameter / 2 * kInch, height * kInch});
  profile.push_back({0, 15 * kInch});
  SolidMesh mesh;
  revolve(mesh, profile, 16);
  requireSolid(mesh, 0);
  return mesh;
}

struct Asset {
  const char* file;
  const char* comment;
  SolidMesh (*make)();
};

constexpr Asset kAssets[] = {
    {"mug.obj", "A mug with a handle: one closed surface. Its origin is the middle of its foot.", mug},
    {"cup.obj", "A wide cup. Its origin is the middle of its foot.", cup},
    {"pin.obj", "Points of the hull of a bowling pin. Its origin is the middle of its foot.", pin},
};

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool run(const std::string& folder, bool check) {
  bool good = true;
  for (const Asset& asset : kAssets) {
    const SolidMesh mesh = asset.make();
    const std::string path = folder + "/" + asset.file, text = objText(mesh, asset.comment);
    if (!check) std::ofstream(path, std::ios::binary) << text;
    const bool same = contentOf(path) == text;
    good = good && same;
    std::cout << path << ": " << mesh.points.size() << " points, " << mesh.triangles.size() << " triangles"
              << (same    ? "\n"
                  : check ? ": the file is another\n"
                          : ": cannot be written\n");
  }
  return good;
}

}  // namespace
}  // namespace assets

int main(int count, char** words) {
  const bool check = count == 3 && std::string(words[1]) == "--check";
  if (count != 2 && !check) {
    std::cerr << "usage: make_assets [--check] FOLDER\n";
    return 2;
  }
  return assets::run(words[count - 1], check) ? 0 : 1;
}
