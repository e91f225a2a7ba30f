#include <algorithm>
#include <cmath>

#include "formats/detail/svg_layers.hpp"
#include "formats/detail/svg_silhouette.hpp"
#include "formats/shape_extent.h"

namespace carom {
namespace {

/// Corners of the convex hull of some points, in order.
std::vector<Vec2> hullOf(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  const auto half = [](const std::vector<Vec2>& sorted) {
    std::vector<Vec2> chain;
    for (const Vec2& p : sorted) {
      const auto turnsRight = [&](const Vec2& a, const Vec2& b) {
        const Vec2 ab = b - a, ap = p - a;
        return ab.x() * ap.y() - ab.y() * ap.x() <= 0;
      };
      while (chain.size() > 1 && turnsRight(chain[chain.size() - 2], chain.back())) chain.pop_back();
      chain.push_back(p);
    }
    return chain;
  };
  std::vector<Vec2> lower = half(points);
  std::reverse(points.begin(), points.end());
  const std::vector<Vec2> upper = half(points);
  if (lower.size() > 1) lower.pop_back();
  lower.insert(lower.end(), upper.begin(), upper.end() - (upper.size() > 1 ? 1 : 0));
  return lower;
}

/// An end of a range as a number that lies outside the panel where there is no end.
double endAt(double end, const View& view) {
  constexpr double kFar = 100;  // sizes of the panel
  const double far = kFar * (view.panel.width + view.panel.height) / view.scale;
  return std::clamp(end, -far, far);
}

std::vector<Vec2> clippedToPanel(std::vector<Vec2> polygon, const PixelBox& panel) {
  constexpr double kRim = 4;  // pixels: what ends there is seen to go on
  polygon = clipped(polygon, {1, 0}, panel.x + panel.width + kRim);
  polygon = clipped(polygon, {-1, 0}, kRim - panel.x);
  polygon = clipped(polygon, {0, 1}, panel.y + panel.height + kRim);
  return clipped(polygon, {0, -1}, kRim - panel.y);
}

double areaOf(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

}  // namespace

void drawAllowed(SvgCanvas& canvas, const View& view, const AllowedBox& box) {
  std::vector<Vec2> corners;
  for (int k = 0; k < 8; ++k) {
    Vec3 corner;
    for (int i = 0; i < 3; ++i) corner[i] = endAt((k >> i) % 2 == 0 ? box.low[i] : box.high[i], view);
    corners.push_back(view.pixel(box.origin + box.axes * corner));
  }
  const std::vector<Vec2> seen = clippedToPanel(hullOf(corners), view.panel);
  if (seen.empty()) return;
  Vec2 low = seen.front(), high = low;
  for (const Vec2& p : seen) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if ((high - low).maxCoeff() < 1) return;                          // a range along the line of sight
  if (areaOf(seen) > view.panel.width * view.panel.height) return;  // nothing is asked of what is seen here
  canvas.element("polygon", {{"class", "nail-range"},
                             {"points", svgPoints(seen)},
                             {"fill", kNailColour},
                             {"fill-opacity", "0.14"},
                             {"stroke", kNailColour},
                             {"stroke-width", "2"},
                             {"stroke-linejoin", "round"}});
}

void drawRegions(SvgCanvas& canvas, const View& view, const Picture& picture) {
  if (picture.regions.empty()) return;
  canvas.open("g", {{"class", "regions"}});
  for (const RegionMark& region : picture.regions) {
    const bool avoid = region.side == Region::Side::avoid;
    const Silhouette seen = silhouetteOf(region.shape, region.position, region.orientation, view);
    const std::string colour = avoid ? kAvoidColour : kNailColour;
    canvas.open("g", {{"class", avoid ? "avoid" : "inside"},
                      {"fill", avoid ? "url(#hatch-avoid)" : "none"},
                      {"stroke", colour},
                      {"stroke-width", "1.8"},
                      {"stroke-dasharray", "7 4"},
                      {"stroke-linejoin", "round"}});
    if (!seen.area.empty()) canvas.element("path", {{"d", seen.area}});
    if (!seen.edges.empty()) canvas.element("path", {{"d", seen.edges}, {"fill", "none"}, {"stroke-width", "0.8"}});
    canvas.close();
  }
  canvas.close();
}

Vec2 topOf(const RegionMark& region, const View& view) {
  const Extent extent = shapeExtent(region.shape, region.position, region.orientation);
  const Vec3 half = 0.5 * extent.sizes();
  return view.pixel(extent.center()) - Vec2(0, view.scale * half[view.up_axis]);
}

}  // namespace carom
