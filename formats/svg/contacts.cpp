// SPDX-License-Identifier: MIT
// Persistent contact: a broad, pale stroke where a body rolls, the same dashed where it slides, in long dashes where it rides and
// dotted where it pivots, and a square where it comes to rest. Each says on what when somebody points at it.
#include <algorithm>
#include <string>
#include <vector>

#include "adjoint/motion/lasting_contact.h"
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

/// Who does what on whom: of one picture.
class OnWhat {
 public:
  explicit OnWhat(const Motion& motion) : motion_(motion) {
    if (motion.has_events) contacts_ = lastingContacts(motion);
  }

  /// "top rests on left and right", within a range of arcs.
  std::string words(int body, const ArcRange& range, ArcKind kind, const char* verb) const {
    const std::vector<Arc>& arcs = motion_.world_lines[static_cast<std::size_t>(body)].arcs;
    const double from = arcs[static_cast<std::size_t>(range.first)].start();
    const auto next = static_cast<std::size_t>(range.last) + 1;
    const double until = next < arcs.size() ? arcs[next].start() : motion_.end;
    std::vector<std::string> names;
    for (const LastingContact& c : contacts_) {
      if (c.body != body || c.kind != kind || !(c.from < until) || !(c.to > from)) continue;
      const std::string& name = nameOfBody(c.with);
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    std::string text = nameOfBody(body) + " " + verb;
    for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? " on " : i + 1 < names.size() ? ", " : " and ") + names[i];
    return text;
  }

 private:
  const std::string& nameOfBody(int body) const { return motion_.scene->bodies[static_cast<std::size_t>(body)].name; }

  const Motion& motion_;
  std::vector<LastingContact> contacts_;
};

struct Stroke {
  ArcKind kind;
  Mark mark;
  const char *words, *dashes;
};

void drawStrokes(const LayerPage& page, const OnWhat& on, const Stroke& stroke) {
  const Motion& motion = page.picture.motion;
  SvgCanvas strokes;
  forLines(page.picture, [&](int body, const BodyLook& look) {
    for (const ArcRange& range : rangesOf(motion.world_lines[static_cast<std::size_t>(body)], stroke.kind)) {
      if (page.canvas.size() + strokes.size() > page.most) return;
      strokes.titled("path", {{"d", pathData(motion, body, page.view, page.picture.paths.tolerance, range)}, {"stroke", paleOf(look.colour)}},
                     on.words(body, range, stroke.kind, stroke.words));
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

void drawRests(const LayerPage& page, const OnWhat& on) {
  const Motion& motion = page.picture.motion;
  SvgCanvas squares;
  forLines(page.picture, [&](int body, const BodyLook& look) {
    const WorldLine& line = motion.world_lines[static_cast<std::size_t>(body)];
    for (const ArcRange& range : rangesOf(line, ArcKind::rest)) {
      if (page.canvas.size() + squares.size() > page.most) return;
      const Arc& arc = line.arcs[static_cast<std::size_t>(range.first)];
      const Vec2 at = page.view.pixel(arc.positionAt(arc.start()));
      SvgAttributes square = boxSides({at.x() - kRestSide / 2, at.y() - kRestSide / 2, kRestSide, kRestSide});
      square.emplace_back("stroke", look.colour.hex());
      squares.titled("rect", square, on.words(body, range, ArcKind::rest, "rests"));
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
  const OnWhat on(page.picture.motion);
  drawStrokes(page, on, {ArcKind::roll, Mark::roll, "rolls", "none"});
  drawStrokes(page, on, {ArcKind::slide, Mark::slide, "slides", "4 3"});
  drawStrokes(page, on, {ArcKind::pivot, Mark::pivot, "pivots", "1.5 3"});
  drawStrokes(page, on, {ArcKind::ride, Mark::ride, "rides", "9 3"});
  drawRests(page, on);
}

}  // namespace carom::formats_detail
