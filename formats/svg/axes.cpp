// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "formats/svg/layers.hpp"

namespace carom::formats_detail {

namespace {

constexpr double kTickSpacing = 64;  // pixels, at least
constexpr double kTickFont = 12;
constexpr const char* kGrid = "#e9ebee";
constexpr const char* kFrame = "#9aa1ab";
constexpr const char* kAxisNames[] = {"x", "y", "z"};

// Multiples of the step inside [low, high]; of numbers so large that the step is lost in them, few.
std::vector<double> ticks(double low, double high, double step) {
  constexpr double kMostTicks = 200;
  std::vector<double> out;
  const double first = std::ceil(low / step), count = std::min(kMostTicks, std::floor(high / step) - first + 1);
  for (double k = 0; k < count; ++k)
    if (const double tick = (first + k) * step; out.empty() || tick != out.back()) out.push_back(tick);
  return out;
}

// How the numbers of an axis are written: in metres where these are short, else in a unit that makes them so, and from a
// place near by where all of them are far from 0.
struct AxisNumbers {
  double unit = 1, origin = 0;
  int digits = 3;
  std::string name;  // such as "x (m)"

  std::string words(double value) const {
    const double number = (value - origin) / unit;
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", digits, number);
    return text;
  }
};

std::string metresOf(int exponent) {
  const std::map<int, const char*> prefixes{{-9, "n"}, {-6, "\u00b5"}, {-3, "m"}, {0, ""}, {3, "k"}};
  const auto found = prefixes.find(exponent);
  return found == prefixes.end() ? "1e" + std::to_string(exponent) + " m" : std::string(found->second) + "m";
}

AxisNumbers axisNumbers(const char* axis, double low, double high, double step) {
  constexpr int kMostDigits = 5;
  AxisNumbers numbers;
  const double span = high - low, thousands = std::floor(std::log10(span) / 3);
  const int exponent = span >= 2e-3 && span < 1e5 ? 0 : 3 * static_cast<int>(thousands);
  numbers.unit = std::pow(10, exponent);
  numbers.name = axis;
  const auto digitsOf = [&](double largest) { return static_cast<int>(std::ceil(std::log10(largest / step) + 1e-9)) + 2; };
  numbers.digits = digitsOf(std::max(std::abs(low), std::abs(high)));
  if (numbers.digits > kMostDigits) {
    const double hundreds = std::pow(10, std::ceil(std::log10(100 * step)));
    numbers.origin = hundreds * std::floor(low / hundreds);
    numbers.digits = kMostDigits;
    char text[40];
    std::snprintf(text, sizeof text, " %s %.15g m", numbers.origin < 0 ? "+" : "\u2212", std::abs(numbers.origin));
    numbers.name += text;
  }
  numbers.name += " (" + metresOf(exponent) + ")";
  return numbers;
}

}  // namespace

double niceStep(double least) {
  least = std::max(least, std::numeric_limits<double>::min());
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

void drawAxes(SvgCanvas& canvas, const View& view) {
  const PixelBox& panel = view.panel;
  const double bottom = panel.y + panel.height, step = niceStep(kTickSpacing / view.scale);
  const Vec2 high = view.low + Vec2(panel.width, panel.height) / view.scale;
  const double half = niceStep(0.5 * kTickSpacing / view.scale);  // upright numbers need less room than wide ones
  canvas.open("g", {{"class", "axes"}, {"font-size", svgNumber(kTickFont)}, {"fill", "#565d67"}});
  const AxisNumbers across = axisNumbers(kAxisNames[view.across_axis], view.low.x(), high.x(), step);
  for (const double u : ticks(view.low.x(), high.x(), step)) {
    const double x = view.pixelOf({u, view.low.y()}).x();
    canvas.element("line", lineEnds({x, panel.y}, {x, bottom}), {{"stroke", kGrid}});
    canvas.text({x, bottom + 17}, across.words(u), {{"text-anchor", "middle"}});
  }
  const double sign = view.up_is_negative ? -1 : 1;
  const AxisNumbers upwards = axisNumbers(kAxisNames[view.up_axis], std::min(sign * view.low.y(), sign * high.y()),
                                          std::max(sign * view.low.y(), sign * high.y()), half);
  double widest = 0;
  for (const double v : ticks(view.low.y(), high.y(), half)) {
    const double y = view.pixelOf({view.low.x(), v}).y();
    const std::string words = upwards.words(sign * v);
    widest = std::max(widest, textWidth(words, kTickFont));
    canvas.element("line", lineEnds({panel.x, y}, {panel.x + panel.width, y}), {{"stroke", kGrid}});
    canvas.text({panel.x - 7, y + 4}, words, {{"text-anchor", "end"}});
  }
  canvas.element("rect", boxSides(panel), {{"fill", "none"}, {"stroke", kFrame}});
  canvas.text({panel.x + panel.width, bottom + 34}, across.name,
              {{"text-anchor", "end"}, {"font-weight", "600"}});
  canvas.text({panel.x, panel.y - 10}, view.title, {{"font-size", "15"}, {"font-weight", "600"}, {"fill", "#2b2f36"}});
  const Vec2 middle(panel.x - 13 - std::max(24.0, widest), panel.y + panel.height / 2);
  canvas.text(middle, upwards.name,
              {{"text-anchor", "middle"},
               {"font-weight", "600"},
               {"transform", "rotate(-90 " + svgNumber(middle.x()) + " " + svgNumber(middle.y()) + ")"}});
  canvas.close();
}

}  // namespace carom::formats_detail
