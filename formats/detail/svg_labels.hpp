#pragma once

#include <string>
#include <vector>

#include "formats/detail/svg_canvas.hpp"

namespace carom {

/// Finds free places for labels in a panel: beside their anchors, away from marks and other labels, and where it can be
/// from paths. The first come are served best.
class LabelPlacer {
 public:
  explicit LabelPlacer(const PixelBox& panel) : panel_(panel) {}

  void avoid(const PixelBox& mark) { taken_.push_back(mark); }
  void avoidIfPossible(const Vec2& point) { points_.push_back(point); }

  /// Baseline start of a line of text beside a mark of the given radius; the place is taken from then on.
  Vec2 place(const Vec2& anchor, double radius, const std::string& words, double font_size);

 private:
  double costOf(const PixelBox& box) const;
  PixelBox panel_;
  std::vector<PixelBox> taken_;
  std::vector<Vec2> points_;
};

}  // namespace carom
