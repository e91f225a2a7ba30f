// SPDX-License-Identifier: MIT
#include "formats/svg/shapes.hpp"

#include <cmath>
#include <variant>

#include "formats/base/short_text.hpp"
#include "formats/svg/silhouette.hpp"

namespace carom::formats_detail {
namespace {

constexpr double kHatchDepth = 16;        // pixels
constexpr double kAreaTolerance = 0.4;    // pixels, of a shape drawn without edges
constexpr double kHullTolerance = 0.8;
constexpr std::size_t kLongestBodyName = 40;  // letters of data-body

std::vector<Vec2> panelCorners(const PixelBox& panel) {
  return {{panel.x, panel.y},
          {panel.x + panel.width, panel.y},
          {panel.x + panel.width, panel.y + panel.height},
          {panel.x, panel.y + panel.height}};
}

void drawFilled(SvgCanvas& canvas, const std::vector<Vec2>& points, const char* fill) {
  canvas.element("polygon", {{"points", svgPoints(points)}, {"fill", fill}, {"stroke", "none"}});
}

void drawPath(SvgCanvas& canvas, const std::string& data, const SvgAttributes& look) {
  if (!data.empty()) canvas.element("path", {{"d", data}}, look);
}

struct ShapePainter {
  SvgCanvas& canvas;
  const View& view;
  std::string name;
  const Vec3& x;
  const Quat& q;
  const ShapeLook& look;
  ShapeDetail detail;

  SvgAttributes paint() const {
    return {{"fill", look.fill},
            {"fill-opacity", svgNumber(look.fill_opacity)},
            {"stroke", look.stroke},
            {"stroke-width", svgNumber(look.stroke_width)}};
  }

  bool operator()(const Sphere& sphere) const {
    canvas.element("circle", {{"data-body", name}}, circleAt(view.pixel(x), sphere.radius * view.scale), paint());
    return true;
  }

  template <class Any>
  bool operator()(const Any& shape) const {
    if (detail != ShapeDetail::edges) {
      const std::string area = detail == ShapeDetail::area ? silhouetteArea(shape, x, q, view, kAreaTolerance)
                                                           : silhouetteHull(shape, x, q, view, kHullTolerance);
      if (area.empty()) return false;
      canvas.element("path", {{"data-body", name}}, {{"d", area}}, paint());
      return true;
    }
    const Silhouette seen = silhouetteOf(shape, x, q, view);
    canvas.open("g", {{"data-body", name}}, paint());
    drawPath(canvas, seen.area, seen.outline.empty() ? SvgAttributes() : SvgAttributes{{"stroke", "none"}});
    drawPath(canvas, seen.edges, {{"fill", "none"}, {"stroke-width", svgNumber(0.5 * look.stroke_width)}});
    drawPath(canvas, seen.outline, {{"fill", "none"}});
    canvas.close();
    return true;
  }

  // The half space seen from its edge: a line, hatched on the solid side. Otherwise it has no outline to draw.
  bool operator()(const Plane& plane) const {
    const Vec3 n = q * plane.normal;
    if (!(std::abs(n.dot(view.towardsViewer())) < 1e-6)) return false;
    const Vec3 foot = x + plane.offset * n;
    const Vec2 out = Vec2(n.dot(view.right()), -n.dot(view.up())).normalized();  // pixels run downwards
    const double offset = out.dot(view.pixel(foot));
    const auto solid = clipped(panelCorners(view.panel), out, offset);
    const auto band = clipped(solid, -out, kHatchDepth - offset);
    if (solid.empty() || band.empty()) return false;
    drawFilled(canvas, solid, "#f1f2f4");
    drawFilled(canvas, band, "url(#hatch)");
    const Vec2 along(-out.y(), out.x()), middle = view.pixel(foot);
    const double reach = view.panel.width + view.panel.height + std::abs(along.dot(middle - solid.front()));
    const Vec2 a = middle - reach * along, b = middle + reach * along;
    canvas.element("line", {{"data-body", name}}, lineEnds(a, b), {{"stroke", look.stroke}, {"stroke-width", "1.8"}});
    return true;
  }
};

}  // namespace

bool drawShape(SvgCanvas& canvas, const View& view, const Body& body, const Vec3& x, const Quat& q,
               const ShapeLook& look, ShapeDetail detail) {
  return std::visit(ShapePainter{canvas, view, ellipsized(body.name, kLongestBodyName), x, q, look, detail}, body.shape);
}

}  // namespace carom::formats_detail
