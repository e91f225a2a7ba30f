// SPDX-License-Identifier: MIT
// Persistent contact: a broad, pale stroke where a body rolls, the same dashed where it slides and dotted where it
// pivots, and a square where it comes to rest.
#include <string>
#include <vector>

#include "formats/drawing/motion_extent.hpp"
#include "formats/svg/layers.hpp"

namespace carom::formats_detail {
namespace {

constexpr double kStrokeWidth = 8, kRestSide = 11;  // px
constexpr double kWhite = 0.5;                      // share in the colour of a stroke
const Colour kKeyColour{0.27, 0.3, 0.34};  // of the legend, where it stands for all bodies

std::string paleOf(const Colour& colour) { return colour.mixedWith({1, 1, 1}, kWhite).hex(); }

/// Arcs of a body that follow each other and are of one kind.
std::vector<ArcRange> rangesOf(const WorldLine& line, ArcKind kind) {
  std::vector<ArcRange> ranges;
  for (int k = 0; k < static_cast<int>(line.arcs.size()); ++k) {
    if (line.arcs[static_cast<std::size_t>(k)].kind() != kind) continue;
    if (!ranges.empty() && ranges.back().last + 1 == k)
      ranges.back().last = k;
    else
      ranges.push_back({k, k});
  }
  return ranges;
}

/// Calls f with each body that has a line, and its look.
template <class F>
void forLines(const Picture& picture, F f) {
  for (std::size_t body = 0; body < picture.paths.looks.size(); ++body)
    if (picture.paths.looks[body].as == BodyLook::As::line) f(static_cast<int>(body), picture.paths.looks[body]);
}

struct Stroke {
  ArcKind kind;
  Mark mark;
  const char *words, *dashes;
};

void drawStrokes(const LayerPage& page, const Stroke& stroke) {
  const Motion& motion = page.picture.motion;
  SvgCanvas strokes;
  forLines(page.picture, [&](int body, const BodyLook& look) {
    for (const ArcRange& range : rangesOf(motion.world_lines[static_cast<std::size_t>(body)], stroke.kind)) {
      if (page.canvas.size() + strokes.size() > page.most) return;
      strokes.element("path", {{"d", pathData(motion, body, page.view, page.picture.paths.tolerance, range)},
                               {"stroke", paleOf(look.colour)}});
    }
  });
  if (strokes.size() == 0) return;
  const bool dashed = stroke.dashes != std::string("none");
  const SvgAttributes dashes{{"stroke-dasharray", stroke.dashes}};
  page.canvas.open("g",
                   {{"class", classOf(stroke.mark)},
                    {"fill", "none"},
                    {"stroke-width", svgNumber(kStrokeWidth)},
                    {"stroke-linejoin", "round"}},
                   dashed ? dashes : SvgAttributes());
  page.canvas.append(strokes.finish());
  page.canvas.close();
  page.legend.add({stroke.mark, stroke.words, paleOf(kKeyColour), stroke.dashes, kStrokeWidth});
}

void drawRests(const LayerPage& page) {
  const Motion& motion = page.picture.motion;
  SvgCanvas squares;
  forLines(page.picture, [&](int body, const BodyLook& look) {
    const WorldLine& line = motion.world_lines[static_cast<std::size_t>(body)];
    for (const ArcRange& range : rangesOf(line, ArcKind::rest)) {
      if (page.canvas.size() + squares.size() > page.most) return;
      const Arc& arc = line.arcs[static_cast<std::size_t>(range.first)];
      const Vec2 at = page.view.pixel(arc.positionAt(arc.start()));
      squares.element("rect", boxSides({at.x() - kRestSide / 2, at.y() - kRestSide / 2, kRestSide, kRestSide}),
                      {{"stroke", look.colour.hex()}});
    }
  });
  if (squares.size() == 0) return;
  page.canvas.open("g", {{"class", classOf(Mark::rest)}, {"fill", "#ffffff"}, {"stroke-width", "1.6"}});
  page.canvas.append(squares.finish());
  page.canvas.close();
  page.legend.add({Mark::rest, "rests", kKeyColour.hex()});
}

}  // namespace

void drawContacts(const LayerPage& page) {
  if (page.level == kContactLevels - 1) {
    if (page.index == 0) page.legend.leaveOut("where bodies roll, slide, pivot, ride and rest");
    return;
  }
  drawStrokes(page, {ArcKind::roll, Mark::roll, "rolls", "none"});
  drawStrokes(page, {ArcKind::slide, Mark::slide, "slides", "4 3"});
  drawStrokes(page, {ArcKind::pivot, Mark::pivot, "pivots", "1.5 3"});
  drawStrokes(page, {ArcKind::ride, Mark::ride, "rides", "9 3"});
  drawRests(page);
}

}  // namespace carom::formats_detail
