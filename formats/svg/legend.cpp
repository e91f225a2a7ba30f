// SPDX-License-Identifier: MIT
#include "formats/svg/legend.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/svg/layers.hpp"

namespace carom::formats_detail {
namespace {

constexpr double kLegendFont = 13;
constexpr double kRow = 23;
constexpr double kLineSwatch = 28, kMarkSwatch = 18;  // widths
constexpr double kWordsGap = 7, kEntryGap = 20;
constexpr double kShadeWidth = 15, kScaleGap = 10, kDotRoom = 10;  // of the steps of a scale

enum class Swatch { scale, line, box, circle, diamond };
constexpr const char* kOwn = "own";  // the colour of the entry

/// A row of the table of marks: its class, and what stands before its words. Attributes that are null are left out.
struct MarkRow {
  const char* name;
  Swatch swatch;
  double radius = 0;  // of a circle, px
  const char* fill = nullptr;
  const char* fill_opacity = nullptr;
  const char* stroke = kOwn;
  const char* stroke_width = nullptr;
  const char* dashes = nullptr;
};
// In the order of Mark.
constexpr std::array<MarkRow, 23> kMarks = {{
    {.name = "path", .swatch = Swatch::line},
    {.name = "crowd-path", .swatch = Swatch::line},
    {.name = "crowd-shade", .swatch = Swatch::scale},
    {.name = "before", .swatch = Swatch::line},
    {.name = "start", .swatch = Swatch::circle, .radius = 3.2, .fill = "#ffffff", .stroke_width = "1.6"},
    {.name = "end", .swatch = Swatch::circle, .radius = 4, .fill = kOwn, .stroke = nullptr},
    {.name = "roll", .swatch = Swatch::line},
    {.name = "slide", .swatch = Swatch::line},
    {.name = "pivot", .swatch = Swatch::line},
    {.name = "ride", .swatch = Swatch::line},
    {.name = "rest", .swatch = Swatch::box, .fill = "#ffffff", .stroke_width = "1.6"},
    {.name = "ghost", .swatch = Swatch::box, .fill = kOwn, .fill_opacity = "0.25"},
    {.name = "crowd-ghost", .swatch = Swatch::circle, .radius = 6, .fill = "#ffffff", .stroke_width = "0.8"},
    {.name = "impact", .swatch = Swatch::diamond, .fill = kOwn, .stroke = nullptr},
    {.name = "impact-cell", .swatch = Swatch::scale},
    {.name = "nail", .swatch = Swatch::circle, .radius = 7, .fill = "none", .stroke_width = "3.2", .dashes = "none"},
    {.name = "nail-elsewhere",
     .swatch = Swatch::circle,
     .radius = 7,
     .fill = "none",
     .stroke_width = "3.2",
     .dashes = "3 3"},
    {.name = "nail-line", .swatch = Swatch::line},
    {.name = "nail-range", .swatch = Swatch::box, .fill = kOwn, .fill_opacity = "0.14"},
    {.name = "target-pose", .swatch = Swatch::box, .fill = "none", .stroke_width = "2", .dashes = "5 3"},
    {.name = "avoid", .swatch = Swatch::box, .fill = "url(#hatch-avoid)", .dashes = "4 3"},
    {.name = "inside", .swatch = Swatch::box, .fill = "none", .dashes = "4 3"},
    {.name = "fixed", .swatch = Swatch::box, .fill = "#dcdfe3"},
}};
static_assert(kMarks.size() == static_cast<std::size_t>(Mark::fixed) + 1);

const MarkRow& rowOf(Mark mark) { return kMarks[static_cast<std::size_t>(mark)]; }

double swatchWidth(const Legend::Entry& entry) {
  if (!entry.scale.empty()) return 0;
  return (rowOf(entry.mark).swatch == Swatch::line ? kLineSwatch : kMarkSwatch) + kWordsGap;
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

SvgAttributes paintOf(const MarkRow& row, const std::string& colour) {
  SvgAttributes out;
  const std::pair<const char*, const char*> all[] = {{"fill", row.fill},
                                                     {"fill-opacity", row.fill_opacity},
                                                     {"stroke", row.stroke},
                                                     {"stroke-width", row.stroke_width},
                                                     {"stroke-dasharray", row.dashes}};
  for (const auto& [name, value] : all)
    if (value != nullptr) out.emplace_back(name, value == kOwn ? colour : value);
  return out;
}

void drawKeyLine(SvgCanvas& canvas, const Vec2& at, const Legend::Entry& entry) {
  const SvgAttributes dashes{{"stroke-dasharray", entry.dashes}};
  canvas.element("line", lineEnds(at, at + Vec2(kLineSwatch, 0)),
                 {{"stroke", entry.colour}, {"stroke-width", svgNumber(entry.width)}},
                 entry.dashes != "none" ? dashes : SvgAttributes());
}

void drawSwatch(SvgCanvas& canvas, const Legend::Entry& entry, const Vec2& at) {
  const MarkRow& row = rowOf(entry.mark);
  const Vec2 middle = at + Vec2(kMarkSwatch / 2, 0);
  const SvgAttributes paint = paintOf(row, entry.colour);
  constexpr double kDiamond = 5.5;
  switch (row.swatch) {
    case Swatch::scale:
      return;
    case Swatch::line:
      return drawKeyLine(canvas, at, entry);
    case Swatch::box:
      return canvas.element("rect", boxSides({middle.x() - 9, middle.y() - 6, 18, 12}), paint);
    case Swatch::circle:
      return canvas.element("circle", circleAt(middle, row.radius), paint);
    case Swatch::diamond: {
      const Vec2 up(0, -kDiamond), right(kDiamond, 0);
      const std::vector<Vec2> corners{middle + up, middle + right, middle - up, middle - right};
      canvas.element("polygon", {{"points", svgPoints(corners)}}, paint);
    }
  }
}

void drawScale(SvgCanvas& canvas, const Legend::Entry& entry, Vec2 at) {
  for (const ScaleStep& step : entry.scale) {
    const SvgAttributes shade{{"fill", entry.colour}, {"fill-opacity", svgNumber(step.opacity)}};
    const double words_at = step.size > 0 ? kDotRoom : kShadeWidth;
    if (step.size > 0)
      canvas.element("circle", circleAt(at + Vec2(kDotRoom / 2, 0), 0.5 * step.size), shade);
    else
      canvas.element("rect", boxSides({at.x(), at.y() - 6, kShadeWidth, 12}), shade);
    if (!step.words.empty()) canvas.text(at + Vec2(words_at + 4, 4.5), step.words);
    at.x() += stepWidth(step);
  }
}

}  // namespace

const char* classOf(Mark mark) { return rowOf(mark).name; }

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
