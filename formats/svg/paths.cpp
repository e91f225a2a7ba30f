// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "formats/drawing/motion_extent.hpp"
#include "formats/svg/layers.hpp"

namespace carom::formats_detail {

namespace {

constexpr std::size_t kLongestLegendName = 24;

std::string crowdWords(const PathPlan& plan) {
  const auto count = static_cast<std::size_t>(plan.crowd);
  if (plan.lines == 0) return counted(count, "body", "bodies");
  return counted(count, "more body", "more bodies");
}

/// To two digits.
std::string twoDigits(double value) {
  const double power = value > 0 ? std::pow(10, std::floor(std::log10(value)) - 1) : 1;
  return shortNumber(std::round(value / power) * power);
}

void drawShade(const LayerPage& page) {
  const ShadePlan& plan = page.picture.shade;
  page.canvas.open("g", {{"class", classOf(Mark::crowd_shade)},
                         {"stroke", kCrowdColour},
                         {"stroke-width", svgNumber(plan.cell)},
                         {"shape-rendering", "crispEdges"}});
  Legend::Entry entry{Mark::crowd_shade, crowdWords(page.picture.paths) + ", shaded by how many are there on average:",
                      kCrowdColour};
  for (std::size_t k = 0; k < kShades.size(); ++k) {
    const std::string& cells = plan.paths[page.index][k];
    if (!cells.empty()) page.canvas.element("path", {{"d", cells}, {"stroke-opacity", svgNumber(kShades[k])}});
    entry.scale.push_back({"", 0, kShades[k]});
  }
  entry.scale.back().words = "up to " + twoDigits(plan.largest) + " a cell";
  page.canvas.close();
  page.legend.add(entry);
}

void drawThinLines(const LayerPage& page) {
  page.canvas.open("g", {{"class", classOf(Mark::crowd_path)},
                         {"fill", "none"},
                         {"stroke", kCrowdColour},
                         {"stroke-width", "0.9"},
                         {"stroke-opacity", "0.7"},
                         {"stroke-linejoin", "round"}});
  for (const BodyLook& look : page.picture.paths.looks)
    if (look.as == BodyLook::As::crowd) page.canvas.element("path", {{"d", look.paths[page.index]}});
  page.canvas.close();
  page.legend.add({Mark::crowd_path, crowdWords(page.picture.paths), kCrowdColour, "none", 0.9});
}

/// The bodies of the motion before whose paths are drawn: those that are lines now, by name, and those that are gone.
std::vector<int> bodiesBefore(const Picture& picture) {
  std::map<std::string, BodyLook::As> now;
  const Scene &scene = *picture.motion.scene, &scene_before = *picture.before->scene;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    now[scene.bodies[body].name] = picture.paths.looks[body].as;
  std::vector<int> bodies;
  for (std::size_t body = 0; body < scene_before.bodies.size(); ++body) {
    const auto found = now.find(scene_before.bodies[body].name);
    if (!scene_before.bodies[body].fixed && (found == now.end() || found->second != BodyLook::As::crowd))
      bodies.push_back(static_cast<int>(body));
  }
  return bodies;
}

void drawDots(const LayerPage& page, bool at_start) {
  const Motion& motion = page.picture.motion;
  const PathPlan& paths = page.picture.paths;
  const Mark mark = at_start ? Mark::start : Mark::end;
  page.canvas.open("g", {{"class", classOf(mark)}, {"stroke-width", "1.6"}});
  for (std::size_t body = 0; body < paths.looks.size(); ++body) {
    if (paths.looks[body].as != BodyLook::As::line) continue;
    const Vec2 at = page.view.pixel(centreAt(motion, static_cast<int>(body), at_start ? 0 : motion.end));
    const std::string colour = paths.looks[body].colour.hex();
    page.canvas.element("circle", circleAt(at, 3.2), {{"fill", at_start ? "#ffffff" : colour}, {"stroke", colour}});
  }
  page.canvas.close();
  page.legend.add({mark, at_start ? "start" : "end", "#454c56"});
}

}  // namespace

void drawCrowd(const LayerPage& page) {
  if (page.picture.paths.crowd == 0) return;
  if (page.picture.paths.shaded)
    drawShade(page);
  else
    drawThinLines(page);
}

void drawPathsBefore(const LayerPage& page) {
  if (!page.picture.before) return;
  constexpr std::array kTolerances = {0.25, 0.5, 1.0};
  static_assert(kTolerances.size() + 1 == kBeforeLevels);
  const std::vector<int> bodies = bodiesBefore(page.picture);
  if (page.level == kBeforeLevels - 1) {
    if (page.index == 0) page.legend.leaveOut("paths before the edit", static_cast<int>(bodies.size()));
    return;
  }
  if (bodies.empty()) return;
  page.canvas.open("g", {{"class", classOf(Mark::before)},
                         {"fill", "none"},
                         {"stroke", kBeforeColour},
                         {"stroke-width", "1.5"},
                         {"stroke-dasharray", "6 4"}});
  for (const int body : bodies) {
    if (page.full()) break;
    const double tolerance = kTolerances[static_cast<std::size_t>(page.level)];
    page.canvas.element("path", {{"d", pathData(*page.picture.before, body, page.view, tolerance)}});
  }
  page.canvas.close();
  const bool all = page.picture.paths.crowd == 0;
  page.legend.add({Mark::before, all ? "path before the edit" : "path before the edit, of bodies with a line",
                   kBeforeColour, "6 4", 1.5});
}

void drawPaths(const LayerPage& page) {
  const PathPlan& paths = page.picture.paths;
  if (paths.lines == 0) return;
  page.canvas.open("g", {{"class", classOf(Mark::path)},
                         {"fill", "none"},
                         {"stroke-width", svgNumber(paths.lineWidth())},
                         {"stroke-linejoin", "round"}});
  for (std::size_t body = 0; body < paths.looks.size(); ++body) {
    const BodyLook& look = paths.looks[body];
    if (look.as != BodyLook::As::line) continue;
    const SvgAttributes dashes{{"stroke-dasharray", kPathDashes[look.dash]}};
    page.canvas.element("path", {{"d", look.paths[page.index]}, {"stroke", look.colour.hex()}},
                        look.dash > 0 ? dashes : SvgAttributes());
    page.legend.add({Mark::path, ellipsized(page.picture.motion.scene->bodies[body].name, kLongestLegendName),
                     look.colour.hex(), kPathDashes[look.dash], paths.lineWidth()});
  }
  page.canvas.close();
  drawDots(page, true);
  drawDots(page, false);
}

}  // namespace carom::formats_detail
