#include <cmath>

#include "formats/detail/svg_layers.hpp"

namespace carom {
namespace {

constexpr double kTickSpacing = 70;  // pixels, at least
constexpr const char* kGrid = "#e9ebee";
constexpr const char* kFrame = "#9aa1ab";
constexpr const char* kAxisNames[] = {"x", "y", "z"};

void line(SvgCanvas& canvas, const Vec2& a, const Vec2& b, const char* colour) {
  canvas.element("line", {{"x1", svgNumber(a.x())},
                          {"y1", svgNumber(a.y())},
                          {"x2", svgNumber(b.x())},
                          {"y2", svgNumber(b.y())},
                          {"stroke", colour}});
}

// Multiples of the step inside [low, high].
std::vector<double> ticks(double low, double high, double step) {
  std::vector<double> out;
  for (double k = std::ceil(low / step); k * step <= high; ++k) out.push_back(k * step);
  return out;
}

}  // namespace

double niceStep(double least) {
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
  canvas.open("g", {{"class", "axes"}, {"font-size", "12"}, {"fill", "#565d67"}});
  for (const double u : ticks(view.low.x(), high.x(), step)) {
    const double x = view.pixelOf({u, view.low.y()}).x();
    line(canvas, {x, panel.y}, {x, bottom}, kGrid);
    canvas.text({x, bottom + 17}, shortNumber(u), {{"text-anchor", "middle"}});
  }
  for (const double v : ticks(view.low.y(), high.y(), half)) {
    const double y = view.pixelOf({view.low.x(), v}).y();
    line(canvas, {panel.x, y}, {panel.x + panel.width, y}, kGrid);
    canvas.text({panel.x - 7, y + 4}, shortNumber(view.up_is_negative ? -v : v), {{"text-anchor", "end"}});
  }
  canvas.element("rect", {{"x", svgNumber(panel.x)},
                          {"y", svgNumber(panel.y)},
                          {"width", svgNumber(panel.width)},
                          {"height", svgNumber(panel.height)},
                          {"fill", "none"},
                          {"stroke", kFrame}});
  canvas.text({panel.x + panel.width, bottom + 34}, std::string(kAxisNames[view.across_axis]) + " (m)",
              {{"text-anchor", "end"}, {"font-weight", "600"}});
  canvas.text({panel.x, panel.y - 10}, view.title, {{"font-size", "15"}, {"font-weight", "600"}, {"fill", "#2b2f36"}});
  const Vec2 middle(panel.x - 46, panel.y + panel.height / 2);
  canvas.text(middle, std::string(kAxisNames[view.up_axis]) + " (m)",
              {{"text-anchor", "middle"},
               {"font-weight", "600"},
               {"transform", "rotate(-90 " + svgNumber(middle.x()) + " " + svgNumber(middle.y()) + ")"}});
  canvas.close();
}

}  // namespace carom
