#include "formats/detail/svg_view.hpp"

#include "formats/motion_extent.h"

namespace carom {
namespace {

std::string pointText(const Vec2& p) { return svgNumber(p.x()) + "," + svgNumber(p.y()); }

}  // namespace

std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const Vec2& normal, double offset) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = normal.dot(a) - offset, db = normal.dot(b) - offset;
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) out.push_back(a + (da / (da - db)) * (b - a));
  }
  return out;
}

std::string pathData(const Motion& motion, int body, const View& view) {
  const auto& arcs = motion.world_lines[body].arcs;
  std::string out;
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k) {
    const double from = arcs[k].start(), to = arcEnd(motion, body, k);
    const Vec3 x = arcs[k].positionAt(from);
    if (k == 0) out += "M" + pointText(view.pixel(x));
    // The control point of a parabola as a quadratic Bezier curve lies where its end tangents meet, at half time.
    const Vec3 control = x + (0.5 * (to - from)) * arcs[k].velocityAt(from);
    out += " Q" + pointText(view.pixel(control)) + " " + pointText(view.pixel(arcs[k].positionAt(to)));
  }
  return out;
}

}  // namespace carom
