#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "adjoint/types.h"

namespace carom {

/// Pixels: a corner and a size, y downwards.
struct PixelBox {
  double x = 0, y = 0, width = 0, height = 0;

  bool contains(const Vec2& p) const { return p.x() >= x && p.x() <= x + width && p.y() >= y && p.y() <= y + height; }
  /// Area in common with another.
  double overlap(const PixelBox& other) const;
};

using SvgAttributes = std::vector<std::pair<std::string_view, std::string>>;

/// A coordinate for SVG, in hundredths of a pixel. Throws InputError for a number that is not finite.
std::string svgNumber(double value);
/// "x,y x,y ..." of a polygon.
std::string svgPoints(const std::vector<Vec2>& points);
/// A number as people write it, at most 4 digits.
std::string shortNumber(double value);
/// Width of a line of text in a common sans-serif font, rather too wide than too narrow.
double textWidth(std::string_view words, double font_size);

/// Builds an SVG document; elements that were opened are closed in the right order, text is escaped.
class SvgCanvas {
 public:
  SvgCanvas(double width, double height, std::string_view title);

  void open(std::string_view name, const SvgAttributes& attributes = {});
  void close();
  void element(std::string_view name, const SvgAttributes& attributes);
  void text(const Vec2& at, std::string_view words, SvgAttributes attributes = {});
  std::string finish();

 private:
  void start(std::string_view name, const SvgAttributes& attributes, std::string_view end);
  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace carom
