// SPDX-License-Identifier: MIT
#include <string_view>

#include "ode_bridge/solids/solid.hpp"

namespace carom {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

std::string signedAxis(int bit, int axis) { return std::string(bit ? "+" : "-") + kAxes[axis]; }

std::string boxName(Family family, int i) {
  if (family == Family::face) return "face " + signedAxis(i % 2, i / 2);
  std::string text = family == Family::edge ? "edge " : "vertex ";
  if (family == Family::edge)
    for (int j = 0; j < 2; ++j) text += signedAxis(i >> j & 1, (i / 4 + 1 + j) % 3);
  else
    for (int k = 0; k < 3; ++k) text += signedAxis(i >> k & 1, k);
  return text;
}

std::string capsuleName(Family family, int i) { return family == Family::edge ? "side" : "end " + signedAxis(i, 2); }

std::string cylinderName(Family family, int i) {
  switch (family) {
    case Family::vertex:
      return "mark " + std::to_string(i % 4) + " of rim " + signedAxis(i / 4, 2);
    case Family::edge:
      return "side";
    case Family::face:
      return "cap " + signedAxis(i, 2);
    case Family::rim:
      return "rim " + signedAxis(i, 2);
  }
  return {};
}

std::string numberedName(Family family, int i) {
  constexpr const char* kWords[] = {"vertex ", "edge ", "face ", "rim "};
  return kWords[static_cast<std::size_t>(family)] + std::to_string(i);
}

int firstOf(const Part& part, Family family) {
  switch (family) {
    case Family::vertex:
      return part.first_vertex;
    case Family::edge:
      return part.first_edge;
    case Family::face:
      return part.first_face;
    case Family::rim:
      return part.first_rim;
  }
  return 0;
}

}  // namespace

std::string nameOf(const Solid& solid, Family family, int index) {
  const Part& part = solid.parts[static_cast<std::size_t>(solid.feature(family, index).part)];
  const int i = index - firstOf(part, family);
  const std::string_view kind = part.kind;
  if (kind == "sphere") return part.name + "ball";
  if (kind == "plane") return part.name + "plane";
  if (kind == "box") return part.name + boxName(family, i);
  if (kind == "capsule") return part.name + capsuleName(family, i);
  if (kind == "cylinder") return part.name + cylinderName(family, i);
  return part.name + numberedName(family, i);
}

}  // namespace carom
