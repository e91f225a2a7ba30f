// SPDX-License-Identifier: MIT
#include <cmath>

#include "formats/svg/layers.hpp"
#include "formats/svg/shapes.hpp"

namespace carom::formats_detail {

namespace {

// The free component runs through the whole panel: the nail is a line there.
void drawFreeLine(SvgCanvas& canvas, const View& view, const Vec2& p) {
  const PixelBox& panel = view.panel;
  const bool level = std::isfinite(p.y());
  const Vec2 from(level ? panel.x : p.x(), level ? p.y() : panel.y);
  const Vec2 to(level ? panel.x + panel.width : p.x(), level ? p.y() : panel.y + panel.height);
  canvas.element("line", {{"class", classOf(Mark::nail_line)}}, lineEnds(from, to),
                 {{"stroke", kNailColour}, {"stroke-width", "1.8"}, {"stroke-dasharray", "10 4"}});
}

void drawHoop(SvgCanvas& canvas, const Vec2& p, Mark mark) {
  for (const bool rim : {true, false})
    canvas.element("circle", {{"class", rim ? "rim" : classOf(mark)}}, circleAt(p, kHoopRadius),
                   {{"fill", "none"},
                    {"stroke", rim ? "#ffffff" : kNailColour},
                    {"stroke-width", rim ? "6" : "3.4"},
                    {"stroke-dasharray", mark == Mark::nail || rim ? "none" : "3 3"}});
}

void drawPose(SvgCanvas& canvas, const View& view, const Body& body, const Vec3& x, const Quat& q) {
  canvas.open("g", {{"class", classOf(Mark::target_pose)}, {"stroke-dasharray", "5 3"}, {"stroke-linejoin", "round"}});
  drawShape(canvas, view, body, x, q, {"none", kNailColour, 2, 1});
  canvas.close();
}

void drawNail(SvgCanvas& canvas, Legend& legend, const LayerPage& page, const NailMark& nail) {
  const View& view = page.view;
  if (nail.allowed && drawAllowed(canvas, view, *nail.allowed))
    legend.add({Mark::nail_range, "range of a nail", kNailColour});
  if (nail.orientation && nail.pose_origin) {
    const Body& body = page.picture.motion.scene->bodies[static_cast<std::size_t>(nail.body)];
    drawPose(canvas, view, body, *nail.pose_origin, *nail.orientation);
    legend.add({Mark::target_pose, "nailed pose", kNailColour});
  }
  const Vec2 p = seenNail(view, nail);
  if (p.allFinite()) {
    const Mark mark = nail.nails_position ? Mark::nail : Mark::nail_elsewhere;
    drawHoop(canvas, p, mark);
    legend.add({mark, nail.nails_position ? "nail" : "nail that leaves the place free", kNailColour});
  } else if (std::isfinite(p.x()) || std::isfinite(p.y())) {
    drawFreeLine(canvas, view, p);
    legend.add({Mark::nail_line, "nail, free along the line", kNailColour, "10 4", 1.8});
  }
}

}  // namespace

Vec2 seenNail(const View& view, const NailMark& nail) {
  return view.pixelOf({nail.target[view.across_axis], (view.up_is_negative ? -1 : 1) * nail.target[view.up_axis]});
}

void drawNails(const LayerPage& page) {
  page.canvas.open("g", {{"class", "layer"}});
  for (const NailMark& nail : page.picture.nails) {
    SvgCanvas one;
    Legend entries;
    drawNail(one, entries, page, nail);
    if (2 * (page.canvas.size() + one.size()) > page.most) {
      if (page.index == 0) page.legend.leaveOut("nails");
      continue;
    }
    page.canvas.append(one.finish());
    page.legend.merge(entries);
  }
  page.canvas.close();
}

}  // namespace carom::formats_detail
