#include "formats/export_svg.h"

#include <algorithm>
#include <filesystem>

#include "formats/detail/svg_layout.hpp"
#include "formats/write_file.h"

namespace carom {
namespace {

constexpr double kWidth = 1000;
constexpr double kSideMargin = 28;
constexpr double kHeader = 70;

std::string counted(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

std::size_t movingBodies(const Scene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) { return !body.fixed; }));
}

double ghostInterval(const Motion& motion) {
  const double ghosts = movingBodies(*motion.scene) <= 2 ? 12 : 8;
  return motion.end > 0 ? niceStep(motion.end / ghosts) : 1;
}

std::string subtitleOf(const Picture& picture) {
  const Motion& motion = picture.motion;
  std::string words = counted(movingBodies(*motion.scene), "moving body");
  if (words.ends_with("bodys")) words.replace(words.size() - 5, 5, "bodies");
  words += " · " + counted(motion.events.size(), "impact") + " · " + shortNumber(motion.end) + " s";
  if (motion.status != MotionStatus::complete)
    words += " of " + shortNumber(motion.duration) + " s (" + nameOf(motion.status) + ")";
  return words;
}

void addHatch(SvgCanvas& canvas, const char* id, const char* colour, const char* width, const char* turn) {
  canvas.open(
      "pattern",
      {{"id", id}, {"width", "8"}, {"height", "8"}, {"patternUnits", "userSpaceOnUse"}, {"patternTransform", turn}});
  canvas.element("line",
                 {{"x1", "0"}, {"y1", "0"}, {"x2", "0"}, {"y2", "8"}, {"stroke", colour}, {"stroke-width", width}});
  canvas.close();
}

void addDefinitions(SvgCanvas& canvas, const std::vector<View>& views, const Picture& picture) {
  canvas.open("defs");
  addHatch(canvas, "hatch", "#9aa1ab", "2", "rotate(45)");
  if (!picture.regions.empty()) addHatch(canvas, "hatch-avoid", kAvoidColour, "0.9", "rotate(-45)");
  for (const View& view : views) {
    canvas.open("clipPath", {{"id", "clip-" + view.name}});
    canvas.element("rect", {{"x", svgNumber(view.panel.x)},
                            {"y", svgNumber(view.panel.y)},
                            {"width", svgNumber(view.panel.width)},
                            {"height", svgNumber(view.panel.height)}});
    canvas.close();
  }
  canvas.close();
}

void drawView(SvgCanvas& canvas, const View& view, const Picture& picture) {
  canvas.open("g", {{"id", "view-" + view.name}});
  drawAxes(canvas, view);
  canvas.open("g", {{"clip-path", "url(#clip-" + view.name + ")"}});
  drawFixedBodies(canvas, view, picture);
  drawRegions(canvas, view, picture);
  drawPathsBefore(canvas, view, picture);
  drawGhosts(canvas, view, picture);
  drawPaths(canvas, view, picture);
  drawMarks(canvas, view, picture);
  canvas.close();
  canvas.close();
}

}  // namespace

void exportSvg(const std::string& path, const Document& document, const Motion& motion, const Motion* before) {
  const Picture picture{motion, before, nailsOf(document, motion), regionsOf(document), ghostInterval(motion)};
  const std::vector<View> views = layOutViews(picture, kWidth, kHeader);
  const PixelBox& last = views.back().panel;
  const double legend_top = last.y + last.height + kAxisRoom + 8, legend_width = kWidth - 2 * kSideMargin;
  const std::string title = std::filesystem::path(path).stem().string();

  SvgCanvas canvas(kWidth, legend_top + legendHeight(picture, legend_width) + 16, title);
  addDefinitions(canvas, views, picture);
  canvas.text({kSideMargin, 36}, title, {{"font-size", "22"}, {"font-weight", "700"}});
  canvas.text({kSideMargin, 58}, subtitleOf(picture), {{"font-size", "14"}, {"fill", "#565d67"}});
  for (const View& view : views) drawView(canvas, view, picture);
  drawLegend(canvas, picture, kSideMargin, legend_top, legend_width);
  writeFile(path, canvas.finish());
}

}  // namespace carom
