// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/svg/cells.hpp"
#include "formats/svg/view.hpp"

namespace carom::formats_detail {

/// Impacts that are seen in one place: where the first of them is.
struct ImpactMark {
  Vec2 pixel;
  std::vector<int> numbers;  ///< in increasing order, 1 = the motion's first
  /// Their numbers in few letters: "3, 5-7", or of many "3 ... 41 (12)".
  std::string words() const;
};

/// How reported impacts (Event::counts) are drawn: one by one with numbers, one by one, or summed in
/// cells when they could not be told apart.
struct ImpactPlan {
  enum class As { none, numbered, marks, cells };
  As as = As::none;
  std::vector<std::vector<ImpactMark>> marks;  ///< of each view
  std::vector<CellGrid> cells;                 ///< of each view
  std::vector<int> classes;                    ///< upper ends of the classes of the cells' sums
  bool merged = false;                         ///< some marks stand for several impacts
  double radius() const { return as == As::numbered ? 5.2 : 3.6; }
};

ImpactPlan planImpacts(const Motion& motion, const std::vector<View>& views);

/// Marks closer than this are one.
inline constexpr double kImpactsApart = 5;  // px
inline constexpr double kImpactCell = 9;    // px

}  // namespace carom::formats_detail
