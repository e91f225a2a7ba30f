// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/svg/canvas.hpp"

namespace carom::formats_detail {

/// Where a label is: never on another one, on a mark or on a leader line, and within its panel.
struct PlacedLabel {
  PixelBox box;
  Vec2 baseline;                                ///< start of the line of text
  std::optional<std::pair<Vec2, Vec2>> leader;  ///< a line from the mark to the words, where they stand apart
};

/// Finds free places for labels in a panel: as near to their marks as can be, and where there is a choice not on paths.
/// The first come are served best. The cost of a label does not depend on how many there are.
class LabelPlacer {
 public:
  explicit LabelPlacer(const PixelBox& panel);

  /// Nothing may be written on a mark.
  void avoid(const PixelBox& mark);
  /// Something is drawn here that words would hide.
  void avoidIfPossible(const Vec2& point);
  void avoidIfPossible(const PixelBox& box);

  /// A place for bold words beside a mark of the given radius, which is taken from then on; nothing if there is none.
  /// What is large has several anchors.
  std::optional<PlacedLabel> place(const std::vector<Vec2>& anchors, double radius, const std::string& words,
                                   double font_size);

 private:
  std::optional<PlacedLabel> labelAt(const PixelBox& box, const Vec2& anchor, double radius) const;
  void take(const PlacedLabel& label);
  bool isFree(const PixelBox& box) const;
  bool leaderIsFree(const Vec2& from, const Vec2& to, const Vec2& anchor, double radius) const;
  double inkUnder(const PixelBox& box) const;
  PixelBox panel_;
  std::vector<PixelBox> taken_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> taken_near_;  // by squares of the panel
  int ink_columns_, ink_rows_;
  std::vector<char> ink_;  // whether something is drawn in each small square
};

}  // namespace carom::formats_detail
