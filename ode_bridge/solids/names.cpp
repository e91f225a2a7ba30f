// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

#include <cmath>

namespace carom {

using namespace ode_bridge_detail;

std::string solids::signedAxis(int positive, int axis) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  return std::string(positive ? "+" : "-") + kAxes[axis];
}

std::string solids::numberedName(Family family, int index) {
  constexpr const char* kWords[] = {"vertex ", "edge ", "face ", "rim "};
  return kWords[static_cast<std::size_t>(family)] + std::to_string(index);
}

namespace {

/// A vertex or an edge that is this far from the middle of the part, as a share of its half extent, is on that side; a face that
/// looks this much along an axis faces there.
constexpr double kOnSide = 0.5;

/// "+x-z": the sides of a direction, or of a place within a box of half extents 1; empty: none.
std::string sidesOf(const Vec3& u) {
  std::string sides;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(u[axis]) > kOnSide) sides += solids::signedAxis(u[axis] > 0, axis);
  return sides;
}

/// What a number does not tell: " at +x-z", " facing +z".
std::string whereOf(const Part& part, Family family, const Feature& feature) {
  if (family == Family::face) {
    const std::string sides = sidesOf(part.axes.transpose() * feature.direction);
    return sides.empty() ? "" : " facing " + sides;
  }
  const Vec3 half = 0.5 * part.box.sizes(), from = part.axes.transpose() * (feature.point - part.origin) - part.box.center();
  Vec3 u = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (half[axis] > 0) u[axis] = from[axis] / half[axis];
  const std::string sides = sidesOf(u);
  return sides.empty() ? " in the middle" : " at " + sides;
}

}  // namespace

std::string ode_bridge_detail::nameOf(const Solid& solid, Family family, int index) {
  const Feature& feature = solid.feature(family, index);
  const Part& part = solid.parts[static_cast<std::size_t>(feature.part)];
  const std::string name = part.name + part.row->name(family, index - part.first(family));
  return part.row->numbered ? name + whereOf(part, family, feature) : name;
}

}  // namespace carom
