// SPDX-License-Identifier: MIT
#include <cmath>

#include "formats/drawing/motion_extent.hpp"
#include "formats/shapes/rows.hpp"
#include "formats/svg/labels.hpp"
#include "formats/svg/layers.hpp"

namespace carom::formats_detail {

namespace {

constexpr double kLabelFont = 13;
constexpr double kDotRadius = 5;  // of start and end, with some room
constexpr std::size_t kLongestName = 24, kLongestNail = 60;

PixelBox boxAround(const Vec2& p, double radius) { return {p.x() - radius, p.y() - radius, 2 * radius, 2 * radius}; }

/// Draws the labels of one view.
class Labeller {
 public:
  explicit Labeller(const LayerPage& page) : page_(page), view_(page.view), placer_(page.view.panel) {
    avoidMarks();
    avoidPaths();
    avoidNailLines();
    avoidShapes();
  }

  void draw() {
    // The white rim keeps words readable on lines.
    page_.canvas.open("g", {{"class", "labels"},
                            {"font-size", svgNumber(kLabelFont)},
                            {"font-weight", "600"},
                            {"stroke", "#ffffff"},
                            {"stroke-width", "3.5"},
                            {"stroke-linejoin", "round"},
                            {"paint-order", "stroke"}});
    labelNails();
    labelBodies();
    labelImpacts();
    labelRegions();
    page_.canvas.close();
  }

 private:
  void avoidMarks() {
    const ImpactPlan& impacts = page_.picture.impacts;
    if (!impacts.marks.empty())
      for (const ImpactMark& mark : impacts.marks[page_.index]) placer_.avoid(boxAround(mark.pixel, impacts.radius()));
    for (const NailMark& nail : page_.picture.nails) {
      const Vec2 p = seenNail(view_, nail);
      if (p.allFinite()) placer_.avoid(boxAround(p, kHoopRadius + 1));
    }
    for (std::size_t body = 0; body < page_.picture.paths.looks.size(); ++body)
      if (page_.picture.paths.looks[body].as == BodyLook::As::line)
        for (const double t : {0.0, page_.picture.motion.end})
          placer_.avoid(boxAround(view_.pixel(centreAt(page_.picture.motion, static_cast<int>(body), t)), 3.5));
  }

  void avoidPaths() {
    constexpr double kSpacing = 2, kMost = 20000;
    const auto avoid = [&](const Motion& motion, int body) {
      for (const PathSample& sample : samplesOfPath(motion, body, view_, kSpacing, kMost))
        placer_.avoidIfPossible(sample.pixel);
    };
    const std::vector<BodyLook>& looks = page_.picture.paths.looks;
    for (std::size_t body = 0; body < looks.size(); ++body)
      if (looks[body].as == BodyLook::As::line) {
        avoid(page_.picture.motion, static_cast<int>(body));
        // Most scenes have the same bodies before; one that has not is only less well avoided.
        if (page_.picture.before && body < page_.picture.before->scene->bodies.size())
          avoid(*page_.picture.before, static_cast<int>(body));
      }
  }

  // Nails that are lines hide words as paths do.
  void avoidNailLines() {
    for (const NailMark& nail : page_.picture.nails) {
      const Vec2 p = seenNail(view_, nail);
      if (p.allFinite()) continue;
      const PixelBox& panel = view_.panel;
      for (double i = 0; i <= panel.width + panel.height; i += 2)
        placer_.avoidIfPossible(
            Vec2(std::isfinite(p.x()) ? p.x() : panel.x + i, std::isfinite(p.y()) ? p.y() : panel.y + i));
    }
  }

  void avoidShapes() {
    const Picture& picture = page_.picture;
    const std::vector<double> times = ghostTimes(picture);
    for (std::size_t body = 0; body < picture.paths.looks.size(); ++body) {
      if (picture.paths.looks[body].as != BodyLook::As::line) continue;
      for (const double t : times) {
        const BodyState s = picture.motion.stateAt(static_cast<int>(body), t);
        placer_.avoidIfPossible(
            seenBox(shapeExtent(picture.motion.scene->bodies[body].shape, s.position, s.orientation)));
      }
    }
    for (const RegionMark& region : picture.regions) {
      const PixelBox box = seenBox(shapeExtent(region.shape, region.position, region.orientation));
      for (const double y : {box.y, box.y + box.height}) placer_.avoidIfPossible(PixelBox{box.x, y, box.width, 0});
      for (const double x : {box.x, box.x + box.width}) placer_.avoidIfPossible(PixelBox{x, box.y, 0, box.height});
    }
  }

  /// What is seen of a box in space, within the panel.
  PixelBox seenBox(const Extent& extent) const {
    const PixelBox& panel = view_.panel;
    const Vec2 a = view_.pixel(extent.min()), b = view_.pixel(extent.max());
    const Vec2 corner(panel.x, panel.y), far = corner + Vec2(panel.width, panel.height);
    const Vec2 low = a.cwiseMin(b).cwiseMax(corner).cwiseMin(far), high = a.cwiseMax(b).cwiseMax(corner).cwiseMin(far);
    return {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
  }

  void label(const std::vector<Vec2>& anchors, double radius, const std::string& words, const std::string& colour,
             const std::string& kind) {
    constexpr std::size_t kOneLabel = 700;  // bytes at most
    const std::optional<PlacedLabel> placed = 2 * (page_.canvas.size() + kOneLabel) < page_.most
                                                  ? placer_.place(anchors, radius, words, kLabelFont)
                                                  : std::nullopt;
    if (!placed) {
      page_.legend.leaveOut(kind + " in the " + view_.name + " view");
      return;
    }
    if (placed->leader) {
      const auto& [from, to] = *placed->leader;
      page_.canvas.element("line", {{"class", "leader"}}, lineEnds(from, to),
                           {{"stroke", colour}, {"stroke-width", "0.9"}});
    }
    page_.canvas.text(placed->baseline, words, {{"fill", colour}});
  }

  void labelNails() {
    const PixelBox& panel = view_.panel;
    for (const NailMark& nail : page_.picture.nails) {
      const Vec2 p = seenNail(view_, nail);
      if (!std::isfinite(p.x()) && !std::isfinite(p.y())) continue;
      const Vec2 anchor(std::isfinite(p.x()) ? p.x() : panel.x + panel.width - 60,
                        std::isfinite(p.y()) ? p.y() : panel.y + 20);
      label({anchor}, p.allFinite() ? kHoopRadius + 2 : 2, ellipsized(nail.label, kLongestNail), kNailColour,
            "labels of nails");
    }
  }

  void labelRegions() {
    for (const RegionMark& region : page_.picture.regions) {
      const std::string colour = region.side == Region::Side::avoid ? kAvoidColour : kNailColour;
      const PixelBox box = seenBox(shapeExtent(region.shape, region.position, region.orientation));
      const double right = box.x + box.width, bottom = box.y + box.height;
      label({{box.x + 0.5 * box.width, box.y}, {box.x, box.y}, {right, box.y}, {box.x, bottom}, {right, bottom}}, 2,
            ellipsized(region.label, kLongestNail), colour, "labels of regions");
    }
  }

  void labelBodies() {
    const std::vector<BodyLook>& looks = page_.picture.paths.looks;
    for (std::size_t body = 0; body < looks.size(); ++body) {
      if (looks[body].as != BodyLook::As::line) continue;
      const Vec2 start = view_.pixel(centreAt(page_.picture.motion, static_cast<int>(body), 0));
      label({start}, kDotRadius, ellipsized(page_.picture.motion.scene->bodies[body].name, kLongestName),
            looks[body].colour.mixedWith({0, 0, 0}, 0.25).hex(), "names");
    }
  }

  void labelImpacts() {
    const ImpactPlan& impacts = page_.picture.impacts;
    if (impacts.as != ImpactPlan::As::numbered) return;
    for (const ImpactMark& mark : impacts.marks[page_.index])
      label({mark.pixel}, impacts.radius(), mark.words(), "#b3162c", "numbers");
  }

  const LayerPage& page_;
  const View& view_;
  LabelPlacer placer_;
};

}  // namespace

void drawLabels(const LayerPage& page) { Labeller(page).draw(); }

}  // namespace carom::formats_detail
