// SPDX-License-Identifier: MIT
#include "formats/svg/export_svg.h"

#include <algorithm>

#include "formats/drawing/motion_extent.hpp"
#include "formats/svg/layout.hpp"

namespace carom {

using namespace formats_detail;

namespace {

constexpr double kWidth = 800;
constexpr double kSideMargin = 20;
constexpr double kTitleHeight = 62;
constexpr std::size_t kLongestTitle = 60;

// From back to front, with what each may take, in bytes.
constexpr std::size_t kPathBytes = 60'000, kShadeBytes = 45'000;
constexpr Layer kLayers[] = {{drawFixedBodies, kFixedLevels, 60'000},
                             {drawCrowd, 1, kPathBytes},
                             {drawImpactCells, 1, 50'000},
                             {drawRegions, 1, 20'000},
                             {drawPathsBefore, kBeforeLevels, 40'000},
                             {drawGhosts, kGhostLevels, 60'000},
                             {drawContacts, kContactLevels, 15'000},
                             {drawPaths, 1, kPathBytes + 15'000},
                             {drawNails, 1, 25'000},
                             {drawImpactMarks, 1, 40'000},
                             {drawLabels, 1, 25'000}};

constexpr std::size_t bytesOfLayers() {
  constexpr std::size_t kAxesAndLegend = 30'000;
  std::size_t sum = kAxesAndLegend;
  for (const Layer& layer : kLayers) sum += layer.most;
  return sum;
}
static_assert(bytesOfLayers() <= kMostSvgBytes);

/// Draws a layer in all views at the first level that fits.
void addLayer(const Layer& layer, const Picture& picture, const std::vector<View>& views, Legend& legend,
              std::vector<SvgCanvas>& pages) {
  for (int level = 0; level < layer.levels; ++level) {
    std::vector<SvgCanvas> drawn(views.size());
    Legend entries;
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < views.size() && bytes <= layer.most; ++i) {
      layer.draw({drawn[i], entries, picture, views[i], i, level, layer.most});
      bytes += drawn[i].size();
    }
    if (bytes > layer.most && level + 1 < layer.levels) continue;
    for (std::size_t i = 0; i < views.size(); ++i) pages[i].append(drawn[i].finish());
    legend.merge(entries);
    return;
  }
}

std::string subtitleOf(const Picture& picture) {
  const Motion& motion = picture.motion;
  std::string words = counted(movingCount(*motion.scene), "moving body", "moving bodies");
  words += " · " + counted(motion.impacts, "impact") + " · " + shortNumber(motion.end) + " s";
  if (motion.status != MotionStatus::complete)
    words += " of " + shortNumber(motion.duration) + " s (" + nameOf(motion.status) + ")";
  return words;
}

std::string descriptionOf(const Picture& picture) {
  const Motion& motion = picture.motion;
  std::string words = "Side view and top view, to scale, of " +
                      counted(movingCount(*motion.scene), "moving body", "moving bodies") + " with " +
                      counted(motion.impacts, "impact") + " in " + shortNumber(motion.end) + " seconds";
  if (picture.before) words += ", and of the motion before the edit";
  if (!picture.nails.empty()) words += ", with " + counted(picture.nails.size(), "nail");
  words += ". Paths of the centres of mass are off by at most " + shortNumber(picture.paths.tolerance) + " pixels.";
  return words;
}

void addHatch(SvgCanvas& canvas, const char* id, const char* colour, const char* width, const char* turn) {
  canvas.open(
      "pattern",
      {{"id", id}, {"width", "8"}, {"height", "8"}, {"patternUnits", "userSpaceOnUse"}, {"patternTransform", turn}});
  canvas.element("line", lineEnds({0, 0}, {0, 8}), {{"stroke", colour}, {"stroke-width", width}});
  canvas.close();
}

void addDefinitions(SvgCanvas& canvas, const std::vector<View>& views, const Picture& picture) {
  canvas.open("defs");
  addHatch(canvas, "hatch", "#9aa1ab", "2", "rotate(45)");
  if (!picture.regions.empty()) addHatch(canvas, "hatch-avoid", kAvoidColour, "0.9", "rotate(-45)");
  for (const View& view : views) {
    canvas.open("clipPath", {{"id", "clip-" + view.name}});
    canvas.element("rect", boxSides(view.panel));
    canvas.close();
  }
  canvas.close();
}

/// Bodies that nails are about, which have lines before others.
std::vector<int> nailedBodies(const Picture& picture) {
  std::vector<int> bodies;
  for (const NailMark& nail : picture.nails)
    if (!picture.motion.scene->bodies[static_cast<std::size_t>(nail.body)].fixed) bodies.push_back(nail.body);
  return bodies;
}

}  // namespace

std::string svgText(const std::string& heading, const Document& document, const Motion& motion, const Motion* before) {
  Picture picture{motion, before, nailsOf(document, motion), regionsOf(document)};
  const std::vector<View> views = layOutViews(picture, kWidth, kTitleHeight);
  picture.paths = planPaths(motion, views, nailedBodies(picture), kPathBytes);
  picture.shade = planShade(motion, views, picture.paths, kShadeBytes);
  picture.impacts = planImpacts(motion, views);

  std::vector<SvgCanvas> pages(views.size());
  Legend legend;
  for (const Layer& layer : kLayers) addLayer(layer, picture, views, legend, pages);

  double legend_top = 0;
  for (const View& view : views)
    legend_top = std::max(legend_top, view.panel.y + view.panel.height + kAxisRoom + 6);
  const double legend_width = kWidth - 2 * kSideMargin;
  const std::string title = ellipsized(heading, kLongestTitle);
  SvgCanvas canvas(kWidth, legend_top + legend.height(legend_width) + 12, title, descriptionOf(picture));
  addDefinitions(canvas, views, picture);
  canvas.text({kSideMargin, 31}, title, {{"font-size", "21"}, {"font-weight", "700"}});
  canvas.text({kSideMargin, 52}, subtitleOf(picture), {{"font-size", "14"}, {"fill", "#565d67"}});
  for (std::size_t i = 0; i < views.size(); ++i) {
    canvas.open("g", {{"id", "view-" + views[i].name}});
    drawAxes(canvas, views[i]);
    canvas.open("g", {{"clip-path", "url(#clip-" + views[i].name + ")"}});
    canvas.append(pages[i].finish());
    canvas.close();
    canvas.close();
  }
  legend.draw(canvas, {kSideMargin, legend_top}, legend_width);
  return canvas.finish();
}

}  // namespace carom
