// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <variant>

#include "formats/shapes/rows.hpp"
#include "formats/svg/layers.hpp"
#include "formats/svg/shapes.hpp"

namespace carom::formats_detail {

namespace {

constexpr std::size_t kLongestList = 48;  // letters of names in the legend

/// Planes first, then the larger ones, so that the smallest are left out where there are too many.
std::vector<int> fixedBySize(const Scene& scene) {
  std::vector<int> bodies;
  std::vector<double> size(scene.bodies.size(), HUGE_VAL);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (!body.fixed) continue;
    bodies.push_back(static_cast<int>(i));
    if (!kindOf(body.shape).endless)
      size[i] = shapeExtent(body.shape, body.position, body.orientation).diagonal().norm();
  }
  std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) {
    return size[static_cast<std::size_t>(a)] > size[static_cast<std::size_t>(b)];
  });
  return bodies;
}

std::string fixedNames(const Scene& scene) {
  std::string names;
  std::size_t count = 0;
  for (const Body& body : scene.bodies) {
    if (!body.fixed) continue;
    ++count;
    if (names.size() <= kLongestList) names += (names.empty() ? "" : ", ") + body.name;
  }
  return names.size() <= kLongestList ? "fixed: " + names : counted(count, "fixed body", "fixed bodies");
}

}  // namespace

void drawFixedBodies(const LayerPage& page) {
  const Scene& scene = *page.picture.motion.scene;
  const ShapeLook look{"#dcdfe3", "#7d8590", 1.4, 1};
  const ShapeDetail detail = page.level == 0   ? ShapeDetail::edges
                             : page.level == 1 ? ShapeDetail::area
                                               : ShapeDetail::hull;
  const bool last = page.level == kFixedLevels - 1;
  page.canvas.open("g", {{"class", classOf(Mark::fixed)}, {"stroke-linejoin", "round"}});
  for (const int i : fixedBySize(scene)) {
    const Body& body = scene.bodies[static_cast<std::size_t>(i)];
    if (page.full() && !last) break;
    SvgCanvas one;
    if (!drawShape(one, page.view, body, body.position, body.orientation, look, detail)) continue;
    constexpr std::size_t kRoomToClose = 16;
    if (last && page.canvas.size() + one.size() + kRoomToClose > page.most / 2) {
      if (page.index == 0) page.legend.leaveOut("fixed bodies");
      continue;
    }
    page.canvas.append(one.finish());
    page.legend.add({Mark::fixed, fixedNames(scene), look.stroke});
  }
  page.canvas.close();
}

}  // namespace carom::formats_detail
