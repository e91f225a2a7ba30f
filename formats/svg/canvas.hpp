// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// Pixels: a corner and a size, y downwards.
struct PixelBox {
  double x = 0, y = 0, width = 0, height = 0;

  bool contains(const Vec2& p) const { return p.x() >= x && p.x() <= x + width && p.y() >= y && p.y() <= y + height; }
  bool contains(const PixelBox& o) const {
    return o.x >= x && o.y >= y && o.x + o.width <= x + width && o.y + o.height <= y + height;
  }
  bool overlaps(const PixelBox& o) const {
    return o.x < x + width && x < o.x + o.width && o.y < y + height && y < o.y + o.height;
  }
  PixelBox grownBy(double rim) const { return {x - rim, y - rim, width + 2 * rim, height + 2 * rim}; }
};

using SvgAttributes = std::vector<std::pair<std::string_view, std::string>>;

/// A coordinate for SVG, in hundredths of a pixel. Throws InputError for a number that is not finite.
std::string svgNumber(double value);
/// "x,y x,y ..." of a polygon.
std::string svgPoints(const std::vector<Vec2>& points);
/// Attributes that say where something is.
SvgAttributes lineEnds(const Vec2& a, const Vec2& b);
SvgAttributes boxSides(const PixelBox& box);
SvgAttributes circleAt(const Vec2& centre, double radius);
/// Width of a line of text in Helvetica, Arial or Liberation Sans, rather too wide than too narrow; bold is wider.
double textWidth(std::string_view words, double font_size, bool bold = false);

/// Builds an SVG document, or a part of one; elements that were opened are closed in the right order, text is escaped.
class SvgCanvas {
 public:
  /// A part, to be appended to a document.
  SvgCanvas() = default;
  /// A document; title and description are for people who cannot see it.
  SvgCanvas(double width, double height, std::string_view title, std::string_view description);

  void open(std::string_view name, const SvgAttributes& first = {}, const SvgAttributes& second = {});
  void close();
  /// With the attributes of all three lists.
  void element(std::string_view name, const SvgAttributes& first, const SvgAttributes& second = {},
               const SvgAttributes& third = {});
  /// The same with words that are shown where somebody points at it.
  void titled(std::string_view name, const SvgAttributes& attributes, std::string_view words);
  void text(const Vec2& at, std::string_view words, const SvgAttributes& attributes = {});
  void append(std::string_view part) { out_ += part; }
  /// Bytes so far.
  std::size_t size() const { return out_.size(); }
  std::string finish();

 private:
  void start(std::string_view name, std::initializer_list<const SvgAttributes*> lists, std::string_view end);
  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace carom::formats_detail
