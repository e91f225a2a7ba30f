// SPDX-License-Identifier: MIT
#include "formats/svg/view.hpp"

#include <algorithm>
#include <cmath>

#include "formats/drawing/motion_extent.hpp"
#include "formats/svg/path.hpp"

namespace carom::formats_detail {
namespace {

/// How far an arc that ends at a time is from the line between its ends, in pixels, at most.
double bulgeOf(const Arc& arc, double to, const View& view) {
  const double elapsed = to - arc.start();
  const double acceleration = view.project(arc.acceleration()).norm() + arc.accelerationVariation();
  return 0.125 * elapsed * elapsed * view.scale * acceleration;
}

double lengthOfArc(const Arc& arc, double to, const View& view) {
  return (view.pixel(arc.positionAt(to)) - view.pixel(arc.positionAt(arc.start()))).norm() + 2 * bulgeOf(arc, to, view);
}

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

std::string pathData(const Motion& motion, int body, const View& view, double tolerance) {
  // What the rounding leaves is shared by the arcs that are taken as lines and by the points that are left out.
  const double flat = 0.4 * (tolerance - kPathRounding), near = 0.6 * (tolerance - kPathRounding);
  const auto& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
  SvgPath path;
  std::vector<Vec2> run{view.pixel(arcs.front().positionAt(arcs.front().start()))};  // joined by lines, drawn up to its first
  path.move(run.front());
  const auto drawRun = [&] {
    const std::vector<Vec2> kept = simplified(run, near);
    for (std::size_t i = 1; i < kept.size(); ++i) path.line(kept[i]);
  };
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k) {
    const Arc& arc = arcs[static_cast<std::size_t>(k)];
    const double from = arc.start(), to = arcEnd(motion, body, k);
    const Vec2 end = view.pixel(arc.positionAt(to));
    const double bulge = bulgeOf(arc, to, view);
    if (bulge <= flat || arc.accelerationVariation() > 0) {  // a slide round a bend is no parabola
      const double count = std::clamp(std::ceil(std::sqrt(bulge / flat)), 1.0, 2000.0);
      for (double i = 1; i < count; ++i) run.push_back(view.pixel(arc.positionAt(from + (to - from) * (i / count))));
      run.push_back(end);
      continue;
    }
    drawRun();
    // The control point of a parabola as a quadratic Bezier curve lies where its end tangents meet, at half time.
    path.parabola(view.pixel(arc.positionAt(from) + (0.5 * (to - from)) * arc.velocityAt(from)), end);
    run = {end};
  }
  drawRun();
  return path.data();
}

std::vector<PathSample> samplesOfPath(const Motion& motion, int body, const View& view, double step, double most) {
  const auto& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
  const double spacing = std::max(step, lengthOfPath(motion, body, view) / most);
  std::vector<PathSample> samples;
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k) {
    const Arc& arc = arcs[static_cast<std::size_t>(k)];
    const double from = arc.start(), to = arcEnd(motion, body, k);
    const double count = std::max(1.0, std::ceil(lengthOfArc(arc, to, view) / spacing)), share = (to - from) / count;
    for (double i = 0; i < count; ++i)
      samples.push_back({view.pixel(arc.positionAt(from + (i + 0.5) * share)), share});
  }
  return samples;
}

double lengthOfPath(const Motion& motion, int body, const View& view) {
  const auto& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
  double length = 0;
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k)
    length += lengthOfArc(arcs[static_cast<std::size_t>(k)], arcEnd(motion, body, k), view);
  return length;
}

}  // namespace carom::formats_detail
