#include <algorithm>
#include <cmath>
#include <variant>

#include "formats/detail/svg_layers.hpp"
#include "formats/detail/svg_silhouette.hpp"
#include "formats/motion_extent.h"
#include "formats/palette.h"

namespace carom {
namespace {

constexpr double kHatchDepth = 16;  // pixels

struct Look {
  std::string fill, stroke;
  double stroke_width = 1.2;
  double fill_opacity = 1;
};

std::vector<Vec2> cornersOf(const PixelBox& panel) {
  return {{panel.x, panel.y},
          {panel.x + panel.width, panel.y},
          {panel.x + panel.width, panel.y + panel.height},
          {panel.x, panel.y + panel.height}};
}

void polygon(SvgCanvas& canvas, const std::vector<Vec2>& points, const Look& look) {
  canvas.element("polygon", {{"points", svgPoints(points)},
                             {"fill", look.fill},
                             {"fill-opacity", svgNumber(look.fill_opacity)},
                             {"stroke", look.stroke},
                             {"stroke-width", svgNumber(look.stroke_width)},
                             {"stroke-linejoin", "round"}});
}

void path(SvgCanvas& canvas, const std::string& data, SvgAttributes look) {
  if (data.empty()) return;
  look.insert(look.begin(), {"d", data});
  canvas.element("path", look);
}

struct ShapePainter {
  SvgCanvas& canvas;
  const View& view;
  const std::string& name;
  const Vec3& x;
  const Quat& q;
  const Look& look;

  void operator()(const Sphere& sphere) const {
    const Vec2 centre = view.pixel(x);
    canvas.element("circle", {{"data-body", name},
                              {"cx", svgNumber(centre.x())},
                              {"cy", svgNumber(centre.y())},
                              {"r", svgNumber(sphere.radius * view.scale)},
                              {"fill", look.fill},
                              {"fill-opacity", svgNumber(look.fill_opacity)},
                              {"stroke", look.stroke},
                              {"stroke-width", svgNumber(look.stroke_width)}});
  }

  template <class Any>
  void operator()(const Any& shape) const {
    const Silhouette seen = silhouetteOf(shape, x, q, view);
    canvas.open("g", {{"data-body", name},
                      {"fill", look.fill},
                      {"fill-opacity", svgNumber(look.fill_opacity)},
                      {"stroke", look.stroke},
                      {"stroke-width", svgNumber(look.stroke_width)},
                      {"stroke-linejoin", "round"}});
    path(canvas, seen.area, seen.outline.empty() ? SvgAttributes() : SvgAttributes{{"stroke", "none"}});
    path(canvas, seen.edges, {{"fill", "none"}, {"stroke-width", svgNumber(0.5 * look.stroke_width)}});
    path(canvas, seen.outline, {{"fill", "none"}});
    canvas.close();
  }

  // The half space seen from its edge: a line, hatched on the solid side. Otherwise it has no outline to draw.
  void operator()(const Plane& plane) const {
    const Vec3 n = q * plane.normal;
    if (!(std::abs(n.dot(view.towardsViewer())) < 1e-6)) return;
    const Vec3 foot = x + plane.offset * n;
    const Vec2 out = Vec2(n.dot(view.right()), -n.dot(view.up())).normalized();  // pixels run downwards
    const double offset = out.dot(view.pixel(foot));
    const auto solid = clipped(cornersOf(view.panel), out, offset);
    const auto band = clipped(solid, -out, kHatchDepth - offset);
    if (solid.empty() || band.empty()) return;
    polygon(canvas, solid, {"#f1f2f4", "none", 0, 1});
    polygon(canvas, band, {"url(#hatch)", "none", 0, 1});
    const Vec2 along(-out.y(), out.x()), middle = view.pixel(foot);
    const double reach = view.panel.width + view.panel.height + std::abs(along.dot(middle - solid.front()));
    const Vec2 a = middle - reach * along, b = middle + reach * along;
    canvas.element("line", {{"data-body", name},
                            {"x1", svgNumber(a.x())},
                            {"y1", svgNumber(a.y())},
                            {"x2", svgNumber(b.x())},
                            {"y2", svgNumber(b.y())},
                            {"stroke", look.stroke},
                            {"stroke-width", "1.8"}});
  }
};

void drawShape(SvgCanvas& canvas, const View& view, const Body& body, const Vec3& x, const Quat& q, const Look& look) {
  std::visit(ShapePainter{canvas, view, body.name, x, q, look}, body.shape);
}

void dot(SvgCanvas& canvas, const Vec2& at, const std::string& fill, const std::string& stroke) {
  canvas.element("circle", {{"cx", svgNumber(at.x())},
                            {"cy", svgNumber(at.y())},
                            {"r", "3.2"},
                            {"fill", fill},
                            {"stroke", stroke},
                            {"stroke-width", "1.6"}});
}

std::vector<double> ghostTimes(const Picture& picture) {
  std::vector<double> times;
  const double end = picture.motion.end, step = picture.ghost_interval;
  // A ghost just before the last one would only blur it.
  for (double k = 0; k * step < end - 0.3 * step; ++k) times.push_back(k * step);
  times.push_back(end);
  return times;
}

}  // namespace

void drawFixedBodies(SvgCanvas& canvas, const View& view, const Picture& picture) {
  const Scene& scene = *picture.motion.scene;
  const Look look{"#dcdfe3", "#7d8590", 1.4, 1};
  canvas.open("g", {{"class", "fixed"}});
  for (const bool planes : {true, false})
    for (const Body& body : scene.bodies)
      if (body.fixed && std::holds_alternative<Plane>(body.shape) == planes)
        drawShape(canvas, view, body, body.position, body.orientation, look);
  canvas.close();
}

void drawPathsBefore(SvgCanvas& canvas, const View& view, const Picture& picture) {
  if (!picture.before) return;
  canvas.open("g", {{"class", "before"},
                    {"fill", "none"},
                    {"stroke", kBeforeColour},
                    {"stroke-width", "1.6"},
                    {"stroke-dasharray", "7 5"}});
  const Scene& scene = *picture.before->scene;
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body)
    if (!scene.bodies[body].fixed) canvas.element("path", {{"d", pathData(*picture.before, body, view)}});
  canvas.close();
}

void drawGhosts(SvgCanvas& canvas, const View& view, const Picture& picture) {
  const Motion& motion = picture.motion;
  const Scene& scene = *motion.scene;
  const std::vector<double> times = ghostTimes(picture);
  canvas.open("g", {{"class", "ghosts"}});
  for (std::size_t k = 0; k < times.size(); ++k) {
    const bool last = k + 1 == times.size();
    const double age = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(times.size() - 1, 1));
    canvas.open("g", {{"opacity", last ? "1" : svgNumber(0.35 + 0.45 * age)}});
    for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body) {
      if (scene.bodies[body].fixed) continue;
      const BodyState s = motion.stateAt(body, times[k]);
      const Colour colour = bodyColour(scene, body);
      const Look look{colour.hex(), colour.mixedWith({0, 0, 0}, 0.25).hex(), 1.1, last ? 0.5 : 0.28};
      drawShape(canvas, view, scene.bodies[body], s.position, s.orientation, look);
    }
    canvas.close();
  }
  canvas.close();
}

void drawPaths(SvgCanvas& canvas, const View& view, const Picture& picture) {
  const Motion& motion = picture.motion;
  canvas.open("g", {{"class", "paths"}, {"fill", "none"}, {"stroke-width", "2.2"}, {"stroke-linejoin", "round"}});
  for (int body = 0; body < static_cast<int>(motion.scene->bodies.size()); ++body) {
    if (motion.scene->bodies[body].fixed) continue;
    const std::string colour = bodyColour(*motion.scene, body).hex();
    canvas.element("path", {{"d", pathData(motion, body, view)}, {"stroke", colour}});
    dot(canvas, view.pixel(centreAt(motion, body, 0)), "#ffffff", colour);
    dot(canvas, view.pixel(centreAt(motion, body, motion.end)), colour, colour);
  }
  canvas.close();
}

void drawPose(SvgCanvas& canvas, const View& view, const Body& body, const Vec3& x, const Quat& q) {
  canvas.open("g", {{"class", "target-pose"}, {"stroke-dasharray", "5 3"}});
  drawShape(canvas, view, body, x, q, {"none", kNailColour, 2, 1});
  canvas.close();
}

}  // namespace carom
