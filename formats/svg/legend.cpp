// SPDX-License-Identifier: MIT
#include "formats/svg/legend.hpp"

#include <algorithm>
#include <utility>

#include "formats/svg/layers.hpp"

namespace carom::formats_detail {
namespace {

constexpr double kLegendFont = 13;
constexpr double kRow = 23;
constexpr double kLineSwatch = 28, kMarkSwatch = 18;  // widths
constexpr double kWordsGap = 7, kEntryGap = 20;
constexpr double kShadeWidth = 15, kScaleGap = 10, kDotRoom = 10;  // of the steps of a scale

double swatchWidth(const Legend::Entry& entry) {
  if (!entry.scale.empty()) return 0;
  const bool line = entry.mark == Mark::path || entry.mark == Mark::crowd_path || entry.mark == Mark::before ||
                    entry.mark == Mark::nail_line;
  return (line ? kLineSwatch : kMarkSwatch) + kWordsGap;
}

double stepWidth(const ScaleStep& step) {
  const double words = step.words.empty() ? 0 : 4 + textWidth(step.words, kLegendFont);
  return step.size > 0 ? kDotRoom + words + kScaleGap : kShadeWidth + words;
}

double entryWidth(const Legend::Entry& entry) {
  double wide = swatchWidth(entry) + textWidth(entry.words, kLegendFont);
  for (const ScaleStep& step : entry.scale) wide += stepWidth(step);
  return wide + (entry.scale.empty() ? 0 : kScaleGap);
}

/// Offsets from the legend's corner to the middles of the left ends of the entries.
std::vector<Vec2> flowOf(const std::vector<Legend::Entry>& entries, double width) {
  std::vector<Vec2> places;
  Vec2 at(0, kRow / 2);
  for (const Legend::Entry& entry : entries) {
    const double wide = entryWidth(entry);
    if (at.x() > 0 && at.x() + wide > width) at = {0, at.y() + kRow};
    places.push_back(at);
    at.x() += wide + kEntryGap;
  }
  return places;
}

void drawKeyBox(SvgCanvas& canvas, const Vec2& middle, const SvgAttributes& look) {
  SvgAttributes attributes{
      {"x", svgNumber(middle.x() - 9)}, {"y", svgNumber(middle.y() - 6)}, {"width", "18"}, {"height", "12"}};
  attributes.insert(attributes.end(), look.begin(), look.end());
  canvas.element("rect", attributes);
}

void drawKeyLine(SvgCanvas& canvas, const Vec2& at, const Legend::Entry& entry) {
  SvgAttributes attributes{{"x1", svgNumber(at.x())},
                           {"y1", svgNumber(at.y())},
                           {"x2", svgNumber(at.x() + kLineSwatch)},
                           {"y2", svgNumber(at.y())},
                           {"stroke", entry.colour},
                           {"stroke-width", svgNumber(entry.width)}};
  if (entry.dashes != "none") attributes.push_back({"stroke-dasharray", entry.dashes});
  canvas.element("line", attributes);
}

void drawKeyCircle(SvgCanvas& canvas, const Vec2& middle, const char* radius, const SvgAttributes& look) {
  SvgAttributes attributes{{"cx", svgNumber(middle.x())}, {"cy", svgNumber(middle.y())}, {"r", radius}};
  attributes.insert(attributes.end(), look.begin(), look.end());
  canvas.element("circle", attributes);
}

void drawSwatch(SvgCanvas& canvas, const Legend::Entry& entry, const Vec2& at) {
  const Vec2 middle = at + Vec2(kMarkSwatch / 2, 0);
  const std::string& colour = entry.colour;
  switch (entry.mark) {
    case Mark::path:
    case Mark::crowd_path:
    case Mark::before:
    case Mark::nail_line:
      return drawKeyLine(canvas, at, entry);
    case Mark::start:
      return drawKeyCircle(canvas, middle, "3.2", {{"fill", "#ffffff"}, {"stroke", colour}, {"stroke-width", "1.6"}});
    case Mark::end:
      return drawKeyCircle(canvas, middle, "4", {{"fill", colour}});
    case Mark::ghost:
      return drawKeyBox(canvas, middle, {{"fill", colour}, {"fill-opacity", "0.25"}, {"stroke", colour}});
    case Mark::crowd_ghost:
      return drawKeyCircle(canvas, middle, "6", {{"fill", "#ffffff"}, {"stroke", colour}, {"stroke-width", "0.8"}});
    case Mark::impact:
      return canvas.element("polygon", {{"points", svgPoints({middle + Vec2(0, -5.5), middle + Vec2(5.5, 0),
                                                              middle + Vec2(0, 5.5), middle + Vec2(-5.5, 0)})},
                                        {"fill", colour}});
    case Mark::nail:
    case Mark::nail_elsewhere:
      return drawKeyCircle(canvas, middle, "7",
                           {{"fill", "none"},
                            {"stroke", colour},
                            {"stroke-width", "3.2"},
                            {"stroke-dasharray", entry.mark == Mark::nail ? "none" : "3 3"}});
    case Mark::nail_range:
      return drawKeyBox(canvas, middle, {{"fill", colour}, {"fill-opacity", "0.14"}, {"stroke", colour}});
    case Mark::target_pose:
      return drawKeyBox(canvas, middle,
                        {{"fill", "none"}, {"stroke", colour}, {"stroke-width", "2"}, {"stroke-dasharray", "5 3"}});
    case Mark::avoid:
      return drawKeyBox(canvas, middle,
                        {{"fill", "url(#hatch-avoid)"}, {"stroke", colour}, {"stroke-dasharray", "4 3"}});
    case Mark::inside:
      return drawKeyBox(canvas, middle, {{"fill", "none"}, {"stroke", colour}, {"stroke-dasharray", "4 3"}});
    case Mark::fixed:
      return drawKeyBox(canvas, middle, {{"fill", "#dcdfe3"}, {"stroke", colour}});
    case Mark::crowd_shade:
    case Mark::impact_cell:
      return;  // scales
  }
}

void drawScale(SvgCanvas& canvas, const Legend::Entry& entry, Vec2 at) {
  for (const ScaleStep& step : entry.scale) {
    double words_at = kShadeWidth;
    if (step.size > 0) {
      words_at = kDotRoom;
      drawKeyCircle(canvas, at + Vec2(kDotRoom / 2, 0), svgNumber(0.5 * step.size).c_str(),
                    {{"fill", entry.colour}, {"fill-opacity", svgNumber(step.opacity)}});
    } else {
      canvas.element("rect", {{"x", svgNumber(at.x())},
                              {"y", svgNumber(at.y() - 6)},
                              {"width", svgNumber(kShadeWidth)},
                              {"height", "12"},
                              {"fill", entry.colour},
                              {"fill-opacity", svgNumber(step.opacity)}});
    }
    if (!step.words.empty()) canvas.text(at + Vec2(words_at + 4, 4.5), step.words);
    at.x() += stepWidth(step);
  }
}

}  // namespace

const char* classOf(Mark mark) {
  switch (mark) {
    case Mark::path: return "path";
    case Mark::crowd_path: return "crowd-path";
    case Mark::crowd_shade: return "crowd-shade";
    case Mark::before: return "before";
    case Mark::start: return "start";
    case Mark::end: return "end";
    case Mark::ghost: return "ghost";
    case Mark::crowd_ghost: return "crowd-ghost";
    case Mark::impact: return "impact";
    case Mark::impact_cell: return "impact-cell";
    case Mark::nail: return "nail";
    case Mark::nail_elsewhere: return "nail-elsewhere";
    case Mark::nail_line: return "nail-line";
    case Mark::nail_range: return "nail-range";
    case Mark::target_pose: return "target-pose";
    case Mark::avoid: return "avoid";
    case Mark::inside: return "inside";
    case Mark::fixed: return "fixed";
  }
  return "";
}

void Legend::add(Entry entry) {
  for (const Entry& known : entries_)
    if (known.mark == entry.mark && known.words == entry.words && known.colour == entry.colour &&
        known.dashes == entry.dashes)
      return;
  entries_.push_back(std::move(entry));
}

void Legend::leaveOut(const std::string& what, int count) {
  if (count > 0) left_out_[what] += count;
}

void Legend::merge(const Legend& other) {
  for (const Entry& entry : other.entries_) add(entry);
  for (const auto& [what, count] : other.left_out_) leaveOut(what, count);
}

std::vector<Legend::Entry> Legend::sorted() const {
  std::vector<Entry> entries = entries_;
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.mark < b.mark; });
  return entries;
}

std::vector<std::string> Legend::leftOutLines(double width) const {
  std::vector<std::string> lines;
  for (const auto& [what, count] : left_out_) {
    const std::string words = what + " (" + std::to_string(count) + ")";
    if (lines.empty())
      lines.push_back("Left out for lack of room: " + words);
    else if (textWidth(lines.back() + ", " + words, kLegendFont) > width)
      lines.back() += ",", lines.push_back(words);
    else
      lines.back() += ", " + words;
  }
  return lines;
}

double Legend::height(double width) const {
  const std::vector<Vec2> places = flowOf(sorted(), width);
  const double entries = places.empty() ? 0 : places.back().y() + kRow / 2;
  return entries + kRow * static_cast<double>(leftOutLines(width).size());
}

void Legend::draw(SvgCanvas& canvas, const Vec2& corner, double width) const {
  const std::vector<Entry> entries = sorted();
  const std::vector<Vec2> places = flowOf(entries, width);
  canvas.open("g", {{"class", "legend"}, {"font-size", svgNumber(kLegendFont)}});
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Vec2 at = corner + places[i];
    canvas.open("g", {{"data-mark", classOf(entries[i].mark)}});
    const double words_at = swatchWidth(entries[i]);
    drawSwatch(canvas, entries[i], at);
    canvas.text(at + Vec2(words_at, 4.5), entries[i].words);
    const double scale_at = words_at + textWidth(entries[i].words, kLegendFont) + kScaleGap;
    drawScale(canvas, entries[i], at + Vec2(scale_at, 0));
    canvas.close();
  }
  const std::vector<std::string> lines = leftOutLines(width);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double up = kRow * (static_cast<double>(lines.size() - i) - 0.5);
    canvas.text(corner + Vec2(0, height(width) - up + 4.5), lines[i],
                {{"class", "left-out"}, {"fill", "#565d67"}, {"font-style", "italic"}});
  }
  canvas.close();
}

}  // namespace carom::formats_detail
