#include "formats/detail/svg_labels.hpp"

#include <algorithm>
#include <limits>

namespace carom {
namespace {

constexpr double kBold = 1.1;     // labels are bold
constexpr double kOverlap = 1.0;  // a square pixel on a mark or another label
constexpr double kOutside = 4.0;  // a square pixel outside the panel
constexpr double kOnPath = 6.0;   // a sample of a path under the label
constexpr double kFurther = 3.0;  // each step away from the anchor

}  // namespace

Vec2 LabelPlacer::place(const Vec2& anchor, double radius, const std::string& words, double font_size) {
  const double width = kBold * textWidth(words, font_size), height = font_size;
  PixelBox best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 4; ++step) {
    const double gap = radius + 3 + 9 * step;
    // Right above, right below, left above, left below, above, below, right, left of the anchor.
    const double right = anchor.x() + 0.7 * gap, left = anchor.x() - 0.7 * gap - width, mid = anchor.x() - width / 2;
    const double above = anchor.y() - 0.7 * gap - height, below = anchor.y() + 0.7 * gap;
    for (const PixelBox& box :
         {PixelBox{right, above, width, height}, PixelBox{right, below, width, height},
          PixelBox{left, above, width, height}, PixelBox{left, below, width, height},
          PixelBox{mid, anchor.y() - gap - height, width, height}, PixelBox{mid, anchor.y() + gap, width, height},
          PixelBox{anchor.x() + gap, anchor.y() - height / 2, width, height},
          PixelBox{anchor.x() - gap - width, anchor.y() - height / 2, width, height}}) {
      const double cost = costOf(box) + kFurther * step;
      if (cost < best_cost) best = box, best_cost = cost;
    }
  }
  avoid(best);
  return {best.x, best.y + 0.85 * height};
}

double LabelPlacer::costOf(const PixelBox& box) const {
  double cost = kOutside * (box.width * box.height - box.overlap(panel_));
  for (const PixelBox& other : taken_) cost += kOverlap * box.overlap(other);
  for (const Vec2& p : points_) cost += box.contains(p) ? kOnPath : 0;
  return cost;
}

}  // namespace carom
