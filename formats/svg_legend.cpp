#include <variant>

#include "formats/detail/svg_layers.hpp"
#include "formats/palette.h"

namespace carom {
namespace {

constexpr double kFont = 13;
constexpr double kRow = 24;
constexpr double kSwatch = 30;
constexpr double kGap = 22;  // between entries
constexpr int kMaxBodies = 12;

enum class Swatch { path, before, ghost, fixed, impact, nail, pose, range, avoid, inside };

struct Entry {
  Swatch swatch;
  std::string words;
  std::string colour;
};

struct PlacedEntry {
  Entry entry;
  Vec2 at;  // from the legend's corner to the middle of the swatch's left end
};

bool anyNail(const Picture& picture, bool (*test)(const NailMark&)) {
  for (const NailMark& nail : picture.nails)
    if (test(nail)) return true;
  return false;
}

bool anyRegion(const Picture& picture, Region::Side side) {
  for (const RegionMark& region : picture.regions)
    if (region.side == side) return true;
  return false;
}

std::vector<Entry> entriesOf(const Picture& picture) {
  const Scene& scene = *picture.motion.scene;
  std::vector<Entry> entries;
  std::string fixed;
  int moving = 0;
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body) {
    const std::string& name = scene.bodies[body].name;
    if (scene.bodies[body].fixed)
      fixed += (fixed.empty() ? "" : ", ") + name;
    else if (++moving <= kMaxBodies)
      entries.push_back({Swatch::path, name, bodyColour(scene, body).hex()});
  }
  if (moving > kMaxBodies)
    entries.push_back({Swatch::path, std::to_string(moving - kMaxBodies) + " more bodies", kBeforeColour});
  if (picture.before) entries.push_back({Swatch::before, "path before the edit", kBeforeColour});
  if (moving > 0)
    entries.push_back({Swatch::ghost, "position every " + shortNumber(picture.ghost_interval) + " s", "#6d7580"});
  if (!picture.motion.events.empty()) {
    const char* words = impactsAreNumbered(picture) ? "impact, numbered" : "impact";
    entries.push_back({Swatch::impact, words, kImpactColour});
  }
  if (!picture.nails.empty()) entries.push_back({Swatch::nail, "nail", kNailColour});
  if (anyNail(picture, [](const NailMark& nail) { return nail.orientation && nail.pose_origin; }))
    entries.push_back({Swatch::pose, "nailed pose", kNailColour});
  if (anyNail(picture, [](const NailMark& nail) { return nail.allowed.has_value(); }))
    entries.push_back({Swatch::range, "range of a nail", kNailColour});
  if (anyRegion(picture, Region::Side::avoid))
    entries.push_back({Swatch::avoid, "region to stay out of", kAvoidColour});
  if (anyRegion(picture, Region::Side::inside)) entries.push_back({Swatch::inside, "region to stay in", kNailColour});
  constexpr std::size_t kLongest = 60;
  if (fixed.size() > kLongest) fixed = "bodies";
  if (!fixed.empty()) entries.push_back({Swatch::fixed, "fixed: " + fixed, "#7d8590"});
  return entries;
}

std::vector<PlacedEntry> flow(const std::vector<Entry>& entries, double width) {
  std::vector<PlacedEntry> out;
  Vec2 at(0, kRow / 2);
  for (const Entry& entry : entries) {
    const double wide = kSwatch + 8 + textWidth(entry.words, kFont);
    if (at.x() > 0 && at.x() + wide > width) at = {0, at.y() + kRow};
    out.push_back({entry, at});
    at.x() += wide + kGap;
  }
  return out;
}

void box(SvgCanvas& canvas, const Vec2& middle, const SvgAttributes& look) {
  SvgAttributes attributes{
      {"x", svgNumber(middle.x() - 9)}, {"y", svgNumber(middle.y() - 6)}, {"width", "18"}, {"height", "12"}};
  attributes.insert(attributes.end(), look.begin(), look.end());
  canvas.element("rect", attributes);
}

void line(SvgCanvas& canvas, const Vec2& at, const std::string& colour, const std::string& dashes) {
  canvas.element("line", {{"x1", svgNumber(at.x())},
                          {"y1", svgNumber(at.y())},
                          {"x2", svgNumber(at.x() + kSwatch)},
                          {"y2", svgNumber(at.y())},
                          {"stroke", colour},
                          {"stroke-width", dashes == "none" ? "2.6" : "1.8"},
                          {"stroke-dasharray", dashes}});
}

void drawSwatch(SvgCanvas& canvas, const Entry& entry, const Vec2& at) {
  const Vec2 middle = at + Vec2(kSwatch / 2, 0);
  if (entry.swatch == Swatch::path) line(canvas, at, entry.colour, "none");
  if (entry.swatch == Swatch::before) line(canvas, at, entry.colour, "7 5");
  if (entry.swatch == Swatch::ghost)
    box(canvas, middle, {{"fill", entry.colour}, {"fill-opacity", "0.25"}, {"stroke", entry.colour}});
  if (entry.swatch == Swatch::fixed) box(canvas, middle, {{"fill", "#dcdfe3"}, {"stroke", entry.colour}});
  if (entry.swatch == Swatch::pose)
    box(canvas, middle,
        {{"fill", "none"}, {"stroke", entry.colour}, {"stroke-width", "2"}, {"stroke-dasharray", "5 3"}});
  if (entry.swatch == Swatch::range)
    box(canvas, middle, {{"fill", entry.colour}, {"fill-opacity", "0.14"}, {"stroke", entry.colour}});
  if (entry.swatch == Swatch::avoid)
    box(canvas, middle, {{"fill", "url(#hatch-avoid)"}, {"stroke", entry.colour}, {"stroke-dasharray", "4 3"}});
  if (entry.swatch == Swatch::inside)
    box(canvas, middle, {{"fill", "none"}, {"stroke", entry.colour}, {"stroke-dasharray", "4 3"}});
  if (entry.swatch == Swatch::impact)
    canvas.element("polygon", {{"points", svgPoints({middle + Vec2(0, -5.5), middle + Vec2(5.5, 0),
                                                     middle + Vec2(0, 5.5), middle + Vec2(-5.5, 0)})},
                               {"fill", entry.colour}});
  if (entry.swatch == Swatch::nail)
    canvas.element("circle", {{"cx", svgNumber(middle.x())},
                              {"cy", svgNumber(middle.y())},
                              {"r", "7"},
                              {"fill", "none"},
                              {"stroke", entry.colour},
                              {"stroke-width", "3.2"}});
}

}  // namespace

bool impactsAreNumbered(const Picture& picture) {
  constexpr std::size_t kMost = 40;  // more numbers than these could not be read
  return picture.motion.events.size() <= kMost;
}

double legendHeight(const Picture& picture, double width) {
  const std::vector<PlacedEntry> placed = flow(entriesOf(picture), width);
  return placed.empty() ? 0 : placed.back().at.y() + kRow / 2;
}

void drawLegend(SvgCanvas& canvas, const Picture& picture, double x, double y, double width) {
  canvas.open("g", {{"class", "legend"}, {"font-size", svgNumber(kFont)}});
  for (const auto& [entry, offset] : flow(entriesOf(picture), width)) {
    const Vec2 at = Vec2(x, y) + offset;
    drawSwatch(canvas, entry, at);
    canvas.text(at + Vec2(kSwatch + 8, 4.5), entry.words);
  }
  canvas.close();
}

}  // namespace carom
