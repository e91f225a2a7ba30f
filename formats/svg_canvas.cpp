#include "formats/detail/svg_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "adjoint/errors.h"

namespace carom {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += ' ';  // control characters are not allowed in XML
    else
      out += c;
  }
  return out;
}

}  // namespace

double PixelBox::overlap(const PixelBox& other) const {
  const double across = std::min(x + width, other.x + other.width) - std::max(x, other.x);
  const double down = std::min(y + height, other.y + other.height) - std::max(y, other.y);
  return across > 0 && down > 0 ? across * down : 0;
}

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

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-12 ? 0.0 : value);
  return text;
}

double textWidth(std::string_view words, double font_size) {
  const auto count = std::count_if(words.begin(), words.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return 0.6 * font_size * static_cast<double>(count);
}

SvgCanvas::SvgCanvas(double width, double height, std::string_view title) {
  const std::string w = svgNumber(width), h = svgNumber(height);
  out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
               {"viewBox", "0 0 " + w + " " + h},
               {"width", w},
               {"height", h},
               {"font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"},
               {"font-size", "13"},
               {"fill", "#2b2f36"}});
  out_ += "<title>" + escaped(title) + "</title>\n";
  element("rect", {{"width", w}, {"height", h}, {"fill", "#ffffff"}});
}

void SvgCanvas::start(std::string_view name, const SvgAttributes& attributes, std::string_view end) {
  out_.append("<").append(name);
  for (const auto& [key, value] : attributes) out_.append(" ").append(key).append("=\"" + escaped(value) + "\"");
  out_.append(end);
}

void SvgCanvas::open(std::string_view name, const SvgAttributes& attributes) {
  start(name, attributes, ">\n");
  open_.emplace_back(name);
}

void SvgCanvas::close() {
  out_ += "</" + open_.back() + ">\n";
  open_.pop_back();
}

void SvgCanvas::element(std::string_view name, const SvgAttributes& attributes) { start(name, attributes, "/>\n"); }

void SvgCanvas::text(const Vec2& at, std::string_view words, SvgAttributes attributes) {
  attributes.insert(attributes.begin(), {{"x", svgNumber(at.x())}, {"y", svgNumber(at.y())}});
  start("text", attributes, ">");
  out_ += escaped(words) + "</text>\n";
}

std::string SvgCanvas::finish() {
  while (!open_.empty()) close();
  return std::move(out_);
}

}  // namespace carom
