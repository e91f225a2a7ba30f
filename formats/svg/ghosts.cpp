// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "formats/svg/layers.hpp"
#include "formats/svg/shapes.hpp"

namespace carom::formats_detail {

namespace {

constexpr const char* kGhostColour = "#6d7580";

/// Less and less of it: fewer times, then no edges.
struct GhostDetail {
  int times = 0;  // 0: as many as fit the number of bodies
  ShapeDetail shape = ShapeDetail::edges;
};
constexpr GhostDetail kGhostDetails[kGhostLevels] = {{0, ShapeDetail::edges}, {0, ShapeDetail::area},
                                                     {4, ShapeDetail::area},  {1, ShapeDetail::area},
                                                     {1, ShapeDetail::hull},  {0, ShapeDetail::hull}};

int intervalsFor(const Picture& picture, const GhostDetail& detail) {
  if (detail.times > 0) return detail.times;
  const int bodies = picture.paths.lines;
  return bodies <= 2 ? 12 : bodies <= 4 ? 8 : bodies <= 12 ? 3 : 1;
}

double ghostInterval(const Motion& motion, int intervals) {
  return intervals > 1 && motion.end > 0 ? niceStep(motion.end / intervals) : motion.end;
}

std::vector<double> timesUntil(double end, double step) {
  std::vector<double> times;
  // A ghost just before the last one would only blur it.
  for (double k = 0; step > 0 && k * step < end - 0.3 * step; ++k) times.push_back(k * step);
  times.push_back(end);
  return times;
}

void drawLineGhosts(const LayerPage& page, const std::vector<double>& times, ShapeDetail detail) {
  const Motion& motion = page.picture.motion;
  page.canvas.open("g", {{"class", classOf(Mark::ghost)}, {"stroke-linejoin", "round"}});
  for (std::size_t k = 0; k < times.size(); ++k) {
    const bool last = k + 1 == times.size();
    const double age = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(times.size() - 1, 1));
    page.canvas.open("g", {{"opacity", last ? "1" : svgNumber(0.35 + 0.45 * age)}});
    for (std::size_t body = 0; body < page.picture.paths.looks.size() && !page.full(); ++body) {
      const BodyLook& body_look = page.picture.paths.looks[body];
      if (body_look.as != BodyLook::As::line) continue;
      const BodyState s = motion.stateAt(static_cast<int>(body), times[k]);
      const ShapeLook look{body_look.colour.hex(), body_look.colour.mixedWith({0, 0, 0}, 0.25).hex(), 1.1,
                           last ? 0.5 : 0.28};
      drawShape(page.canvas, page.view, motion.scene->bodies[body], s.position, s.orientation, look, detail);
    }
    page.canvas.close();
  }
  page.canvas.close();
}

/// Where the bodies without lines of their own are at the end.
void drawCrowdGhosts(const LayerPage& page) {
  const Motion& motion = page.picture.motion;
  const ShapeLook look{"#ffffff", kCrowdColour, 0.8, 0.35};
  page.canvas.open("g", {{"class", classOf(Mark::crowd_ghost)}, {"stroke-linejoin", "round"}});
  for (std::size_t body = 0; body < page.picture.paths.looks.size() && !page.full(); ++body) {
    if (page.picture.paths.looks[body].as != BodyLook::As::crowd) continue;
    const BodyState s = motion.stateAt(static_cast<int>(body), motion.end);
    drawShape(page.canvas, page.view, motion.scene->bodies[body], s.position, s.orientation, look, ShapeDetail::hull);
  }
  page.canvas.close();
}

}  // namespace

std::vector<double> ghostTimes(const Picture& picture) {
  const Motion& motion = picture.motion;
  return timesUntil(motion.end, ghostInterval(motion, intervalsFor(picture, kGhostDetails[0])));
}

void drawGhosts(const LayerPage& page) {
  const PathPlan& paths = page.picture.paths;
  if (page.level == kGhostLevels - 1) {  // not even the hulls fit
    if (page.index == 0) page.legend.leaveOut("outlines of bodies", paths.lines + (paths.shaded ? 0 : paths.crowd));
    return;
  }
  const GhostDetail& detail = kGhostDetails[page.level];
  const bool crowd = paths.crowd > 0 && !paths.shaded;
  if (crowd && page.level < 2) {
    drawCrowdGhosts(page);
    page.legend.add({Mark::crowd_ghost, "the others at the end", kCrowdColour});
  } else if (crowd && page.index == 0) {
    page.legend.leaveOut("outlines of the other bodies at the end", paths.crowd);
  }
  if (paths.lines == 0) return;
  const double step = ghostInterval(page.picture.motion, intervalsFor(page.picture, detail));
  const std::vector<double> times = timesUntil(page.picture.motion.end, step);
  drawLineGhosts(page, times, detail.shape);
  const std::string words = times.size() > 2    ? "position every " + shortNumber(step) + " s"
                            : times.size() == 2 ? "position at start and end"
                                                : "position";
  page.legend.add({Mark::ghost, words, kGhostColour});
}

}  // namespace carom::formats_detail
