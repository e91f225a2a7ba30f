#include <cmath>

#include "formats/detail/svg_labels.hpp"
#include "formats/detail/svg_layers.hpp"
#include "formats/motion_extent.h"
#include "formats/palette.h"

namespace carom {

namespace {

constexpr double kFont = 13;
constexpr double kImpactRadius = 5.5, kSmallRadius = 3.5;
constexpr int kMaxNames = 12;

PixelBox boxAround(const Vec2& p, double radius) { return {p.x() - radius, p.y() - radius, 2 * radius, 2 * radius}; }

void label(SvgCanvas& canvas, const Vec2& at, const std::string& words, const std::string& colour) {
  // The white rim keeps words readable on lines.
  canvas.text(at, words,
              {{"fill", colour},
               {"stroke", "#ffffff"},
               {"stroke-width", "3.5"},
               {"stroke-linejoin", "round"},
               {"paint-order", "stroke"},
               {"font-weight", "600"}});
}

Vec3 placeOf(const Event& event) {
  Vec3 sum = Vec3::Zero();
  for (const Contact& contact : event.contacts) sum += contact.at.point;
  return event.contacts.empty() ? sum : Vec3(sum / static_cast<double>(event.contacts.size()));
}

void drawImpactMark(SvgCanvas& canvas, const Vec2& p, double r) {
  canvas.element(
      "polygon",
      {{"class", "impact"}, {"points", svgPoints({p + Vec2(0, -r), p + Vec2(r, 0), p + Vec2(0, r), p + Vec2(-r, 0)})}});
}

// The free component runs through the whole panel: the nail is a line there.
void drawFreeLine(SvgCanvas& canvas, const View& view, const Vec2& p) {
  const PixelBox& panel = view.panel;
  const bool level = std::isfinite(p.y());
  canvas.element("line", {{"class", "nail-line"},
                          {"x1", svgNumber(level ? panel.x : p.x())},
                          {"y1", svgNumber(level ? p.y() : panel.y)},
                          {"x2", svgNumber(level ? panel.x + panel.width : p.x())},
                          {"y2", svgNumber(level ? p.y() : panel.y + panel.height)},
                          {"stroke", kNailColour},
                          {"stroke-width", "1.8"},
                          {"stroke-dasharray", "10 4"}});
}

void drawHoop(SvgCanvas& canvas, const Vec2& p, bool nails_position) {
  for (const bool rim : {true, false})
    canvas.element("circle", {{"class", rim ? "nail-rim" : "nail"},
                              {"cx", svgNumber(p.x())},
                              {"cy", svgNumber(p.y())},
                              {"r", svgNumber(kHoopRadius)},
                              {"fill", "none"},
                              {"stroke", rim ? "#ffffff" : kNailColour},
                              {"stroke-width", rim ? "6" : "3.4"},
                              {"stroke-dasharray", nails_position || rim ? "none" : "3 3"}});
}

// Where a nail is seen, in pixels; a component that the nail leaves free is NaN.
Vec2 seen(const View& view, const NailMark& nail) {
  return view.pixelOf({nail.target[view.across_axis], (view.up_is_negative ? -1 : 1) * nail.target[view.up_axis]});
}

void avoidPaths(const View& view, const Picture& picture, LabelPlacer& placer) {
  constexpr double kSamples = 160;  // i / kSamples is 1 at most, so the time is never past the end
  for (const Motion* motion : {&picture.motion, picture.before}) {
    if (!motion) continue;
    for (int body = 0; body < static_cast<int>(motion->scene->bodies.size()); ++body)
      if (!motion->scene->bodies[body].fixed)
        for (int i = 0; i <= kSamples; ++i)
          placer.avoidIfPossible(view.pixel(centreAt(*motion, body, motion->end * (i / kSamples))));
  }
}

void drawNails(SvgCanvas& canvas, const View& view, const Picture& picture, LabelPlacer& placer) {
  for (const NailMark& nail : picture.nails) {
    const Vec2 p = seen(view, nail);
    if (nail.allowed) drawAllowed(canvas, view, *nail.allowed);
    if (nail.orientation && nail.pose_origin)
      drawPose(canvas, view, picture.motion.scene->bodies[nail.body], *nail.pose_origin, *nail.orientation);
    if (p.allFinite()) {
      drawHoop(canvas, p, nail.nails_position);
      placer.avoid(boxAround(p, kHoopRadius + 2));
    } else if (std::isfinite(p.x()) || std::isfinite(p.y())) {
      drawFreeLine(canvas, view, p);
    }
  }
}

void labelNails(SvgCanvas& canvas, const View& view, const Picture& picture, LabelPlacer& placer) {
  const PixelBox& panel = view.panel;
  for (const NailMark& nail : picture.nails) {
    const Vec2 p = seen(view, nail);
    if (!std::isfinite(p.x()) && !std::isfinite(p.y())) continue;
    const Vec2 anchor(std::isfinite(p.x()) ? p.x() : panel.x + panel.width - 60,
                      std::isfinite(p.y()) ? p.y() : panel.y + 20);
    const double radius = p.allFinite() ? kHoopRadius + 2 : 2;
    label(canvas, placer.place(anchor, radius, nail.label, kFont), nail.label, kNailColour);
  }
}

void labelRegions(SvgCanvas& canvas, const View& view, const Picture& picture, LabelPlacer& placer) {
  for (const RegionMark& region : picture.regions) {
    const std::string colour = region.side == Region::Side::avoid ? kAvoidColour : kNailColour;
    label(canvas, placer.place(topOf(region, view), 2, region.label, kFont), region.label, colour);
  }
}

void labelBodies(SvgCanvas& canvas, const View& view, const Picture& picture, LabelPlacer& placer) {
  const Scene& scene = *picture.motion.scene;
  int names = 0;
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body) {
    if (scene.bodies[body].fixed || ++names > kMaxNames) continue;
    const Vec2 start = view.pixel(centreAt(picture.motion, body, 0));
    const Colour colour = bodyColour(scene, body).mixedWith({0, 0, 0}, 0.2);
    const std::string& name = scene.bodies[body].name;
    label(canvas, placer.place(start, 5, name, kFont), name, colour.hex());
  }
}

}  // namespace

void drawMarks(SvgCanvas& canvas, const View& view, const Picture& picture) {
  LabelPlacer placer(view.panel);
  avoidPaths(view, picture, placer);
  canvas.open("g", {{"class", "nails"}});
  drawNails(canvas, view, picture, placer);
  canvas.close();
  canvas.open("g", {{"class", "impacts"}, {"fill", kImpactColour}, {"stroke", "#ffffff"}, {"stroke-width", "1.2"}});
  const bool numbered = impactsAreNumbered(picture);
  std::vector<Vec2> places;
  for (const Event& event : picture.motion.events) {
    places.push_back(view.pixel(placeOf(event)));
    drawImpactMark(canvas, places.back(), numbered ? kImpactRadius : kSmallRadius);
    if (numbered) placer.avoid(boxAround(places.back(), kImpactRadius));
  }
  canvas.close();
  canvas.open("g", {{"class", "labels"}, {"font-size", svgNumber(kFont)}});
  labelNails(canvas, view, picture, placer);
  labelRegions(canvas, view, picture, placer);
  for (std::size_t k = 0; numbered && k < places.size(); ++k) {
    const std::string number = std::to_string(k + 1);
    label(canvas, placer.place(places[k], kImpactRadius, number, kFont), number, kImpactColour);
  }
  labelBodies(canvas, view, picture, placer);
  canvas.close();
}

}  // namespace carom
