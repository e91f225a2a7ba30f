// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

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

std::string ode_bridge_detail::nameOf(const Solid& solid, Family family, int index) {
  const Part& part = solid.parts[static_cast<std::size_t>(solid.feature(family, index).part)];
  return part.name + part.row->name(family, index - part.first(family));
}

}  // namespace carom
