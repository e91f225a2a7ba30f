// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "formats/svg/layers.hpp"
#include "formats/svg/path.hpp"
#include "formats/svg/silhouette.hpp"

namespace carom::formats_detail {

namespace {

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

double polygonArea(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

}  // namespace

bool drawAllowed(SvgCanvas& canvas, const View& view, const AllowedBox& box) {
  std::vector<Vec2> corners;
  for (int k = 0; k < 8; ++k) {
    Vec3 corner;
    for (int i = 0; i < 3; ++i) corner[i] = endAt((k >> i) % 2 == 0 ? box.low[i] : box.high[i], view);
    corners.push_back(view.pixel(box.origin + box.axes * corner));
  }
  const std::vector<Vec2> seen = clippedToPanel(convexOutline(corners), view.panel);
  if (seen.empty()) return false;
  Vec2 low = seen.front(), high = low;
  for (const Vec2& p : seen) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if ((high - low).maxCoeff() < 1) return false;                          // a range along the line of sight
  if (polygonArea(seen) > view.panel.width * view.panel.height) return false;  // nothing is asked of what is seen here
  canvas.element("polygon", {{"class", classOf(Mark::nail_range)},
                             {"points", svgPoints(seen)},
                             {"fill", kNailColour},
                             {"fill-opacity", "0.14"},
                             {"stroke", kNailColour},
                             {"stroke-width", "2"},
                             {"stroke-linejoin", "round"}});
  return true;
}

void drawRegions(const LayerPage& page) {
  if (page.picture.regions.empty()) return;
  page.canvas.open("g", {{"class", "layer"}});
  for (const RegionMark& region : page.picture.regions) {
    const Silhouette seen = silhouetteOf(region.shape, region.position, region.orientation, page.view);
    if (seen.area.empty()) continue;
    if (2 * (page.canvas.size() + seen.area.size() + seen.edges.size() + 300) > page.most) {
      if (page.index == 0) page.legend.leaveOut("regions");
      continue;
    }
    const bool avoid = region.side == Region::Side::avoid;
    const Mark mark = avoid ? Mark::avoid : Mark::inside;
    const std::string colour = avoid ? kAvoidColour : kNailColour;
    page.canvas.open("g", {{"class", classOf(mark)},
                           {"fill", avoid ? "url(#hatch-avoid)" : "none"},
                           {"stroke", colour},
                           {"stroke-width", "1.8"},
                           {"stroke-dasharray", "7 4"},
                           {"stroke-linejoin", "round"}});
    page.canvas.element("path", {{"d", seen.area}});
    if (!seen.edges.empty())
      page.canvas.element("path", {{"d", seen.edges}, {"fill", "none"}, {"stroke-width", "0.8"}});
    page.canvas.close();
    page.legend.add({mark, avoid ? "region to stay out of" : "region to stay in", colour});
  }
  page.canvas.close();
}

}  // namespace carom::formats_detail
