// SPDX-License-Identifier: MIT
#include "formats/svg/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "adjoint/base/errors.h"
#include "formats/base/short_text.hpp"

namespace carom::formats_detail {
namespace {

// Advance widths of Helvetica in thousandths of the font size, from the space on to the tilde (its published metrics).
constexpr std::array<int, 95> kLetterWidths = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,          // space to /
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015,    // 0 to @
    667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778,     // A to Q
    722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, 333,               // R to `
    556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556,     // a to q
    333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};                        // r to ~
constexpr int kOtherLetter = 1000;  // Chinese, say

std::string xmlText(std::string_view text) {
  constexpr std::pair<char, const char*> kMarkup[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string out = escaped(text, kMarkup);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';  // control characters are not allowed in XML
  return out;
}

}  // namespace

std::string svgNumber(double value) {
  if (!std::isfinite(value)) throw InputError("svg", "a coordinate is not a finite number; nothing was written");
  char text[400];  // the longest double with two decimals has 313 characters
  std::snprintf(text, sizeof text, "%.2f", value);
  std::string out = text;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

std::string svgPoints(const std::vector<Vec2>& points) {
  std::string out;
  for (const Vec2& p : points) out += (out.empty() ? "" : " ") + svgNumber(p.x()) + "," + svgNumber(p.y());
  return out;
}

SvgAttributes lineEnds(const Vec2& a, const Vec2& b) {
  return {{"x1", svgNumber(a.x())}, {"y1", svgNumber(a.y())}, {"x2", svgNumber(b.x())}, {"y2", svgNumber(b.y())}};
}

SvgAttributes boxSides(const PixelBox& box) {
  return {{"x", svgNumber(box.x)},
          {"y", svgNumber(box.y)},
          {"width", svgNumber(box.width)},
          {"height", svgNumber(box.height)}};
}

SvgAttributes circleAt(const Vec2& centre, double radius) {
  return {{"cx", svgNumber(centre.x())}, {"cy", svgNumber(centre.y())}, {"r", svgNumber(radius)}};
}

double textWidth(std::string_view words, double font_size, bool bold) {
  double thousandths = 0;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;  // belongs to the letter before
    thousandths += byte >= 0x20 && byte < 0x7F ? kLetterWidths[byte - 0x20] : byte < 0x80 ? 0 : kOtherLetter;
  }
  return (bold ? 1.12 : 1.04) * font_size * thousandths / 1000;
}

SvgCanvas::SvgCanvas(double width, double height, std::string_view title, std::string_view description) {
  const std::string w = svgNumber(width), h = svgNumber(height);
  out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
               {"viewBox", "0 0 " + w + " " + h},
               {"width", w},
               {"height", h},
               {"role", "img"},
               {"aria-labelledby", "title desc"},
               {"font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"},
               {"font-size", "13"},
               {"fill", "#2b2f36"}});
  out_ += "<title id=\"title\">" + xmlText(title) + "</title>\n";
  out_ += "<desc id=\"desc\">" + xmlText(description) + "</desc>\n";
  element("rect", {{"width", w}, {"height", h}, {"fill", "#ffffff"}});
}

void SvgCanvas::start(std::string_view name, std::initializer_list<const SvgAttributes*> lists, std::string_view end) {
  out_.append("<").append(name);
  for (const SvgAttributes* attributes : lists)
    for (const auto& [key, value] : *attributes) out_.append(" ").append(key).append("=\"" + xmlText(value) + "\"");
  out_.append(end);
}

void SvgCanvas::open(std::string_view name, const SvgAttributes& first, const SvgAttributes& second) {
  start(name, {&first, &second}, ">\n");
  open_.emplace_back(name);
}

void SvgCanvas::close() {
  out_ += "</" + open_.back() + ">\n";
  open_.pop_back();
}

void SvgCanvas::element(std::string_view name, const SvgAttributes& first, const SvgAttributes& second,
                        const SvgAttributes& third) {
  start(name, {&first, &second, &third}, "/>\n");
}

void SvgCanvas::titled(std::string_view name, const SvgAttributes& attributes, std::string_view words) {
  start(name, {&attributes}, "><title>");
  out_ += xmlText(words) + "</title></" + std::string(name) + ">\n";
}

void SvgCanvas::text(const Vec2& at, std::string_view words, const SvgAttributes& attributes) {
  const SvgAttributes place{{"x", svgNumber(at.x())}, {"y", svgNumber(at.y())}};
  start("text", {&place, &attributes}, ">");
  out_ += xmlText(words) + "</text>\n";
}

std::string SvgCanvas::finish() {
  while (!open_.empty()) close();
  return std::move(out_);
}

}  // namespace carom::formats_detail
