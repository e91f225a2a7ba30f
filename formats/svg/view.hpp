// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/svg/canvas.hpp"

namespace carom::formats_detail {

/// An orthographic view of the world in a panel of the picture, to scale. The viewer looks along -(right x up).
struct View {
  std::string name;  ///< "side" or "top"
  std::string title;
  int across_axis = 0;  ///< world axis that runs to the right
  int up_axis = 2;      ///< world axis that runs upwards, or downwards
  bool up_is_negative = false;
  Vec2 low = Vec2::Zero();  ///< world (across, up) at the panel's lower left corner, m
  double scale = 1;         ///< pixels a metre
  PixelBox panel;

  Vec3 right() const { return Vec3::Unit(across_axis); }
  Vec3 up() const { return (up_is_negative ? -1.0 : 1.0) * Vec3::Unit(up_axis); }
  Vec3 towardsViewer() const { return right().cross(up()); }

  Vec2 project(const Vec3& p) const { return {p.dot(right()), p.dot(up())}; }
  Vec2 pixelOf(const Vec2& across_up) const {
    const Vec2 offset = scale * (across_up - low);
    return {panel.x + offset.x(), panel.y + panel.height - offset.y()};
  }
  Vec2 pixel(const Vec3& p) const { return pixelOf(project(p)); }
};

/// The part of a convex polygon where normal . p <= offset.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const Vec2& normal, double offset);

/// SVG path data of the path of a body's centre of mass: off by at most `tolerance` pixels, which is more than
/// 2 kPathRounding. Arcs that are seen as curves are parabolas, which SVG draws exactly; of flat ones the ends are joined,
/// and thinned out, as are places on slides round a bend.
std::string pathData(const Motion& motion, int body, const View& view, double tolerance);
/// Arcs of a body from one to another.
struct ArcRange {
  int first = 0, last = 0;
};
/// The part of it on some arcs.
std::string pathData(const Motion& motion, int body, const View& view, double tolerance, const ArcRange& range);

/// A place of a path with the time that it stands for.
struct PathSample {
  Vec2 pixel;
  double seconds = 0;
};

/// Places along the path of a body, each in the middle of an equal share of its arc's time: in the mean at most `step`
/// pixels apart, and no more than `most` of them (but one an arc).
std::vector<PathSample> samplesOfPath(const Motion& motion, int body, const View& view, double step, double most);

/// The length of a path in pixels; of curved arcs rather too long.
double lengthOfPath(const Motion& motion, int body, const View& view);

}  // namespace carom::formats_detail
