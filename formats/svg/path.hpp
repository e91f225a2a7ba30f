// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// SVG path data in tenths of a pixel, step by step: pictures of many bodies are mostly these numbers. Each point is off
/// by at most kPathRounding; roundings do not add up.
class SvgPath {
 public:
  void move(const Vec2& to);
  void line(const Vec2& to);
  /// A parabola, with its control point.
  void parabola(const Vec2& control, const Vec2& to);
  /// A line to the right, apart from what came before; without length it is a dot where line caps are round.
  void stroke(const Vec2& from, double length);
  void close();
  const std::string& data() const { return out_; }

 private:
  void append(char command, const Vec2& step);
  std::string out_;
  Vec2 last_ = Vec2::Zero();  // tenths
  char command_ = 0;
};

inline constexpr double kPathRounding = 0.0708;  // px, half a diagonal of a tenth

/// Leaves out points that are within `tolerance` of the line between those that stay (Douglas and Peucker's method, on
/// 128 points at a time, so that the cost stays linear). The first and the last one stay.
std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance);

/// Distance of p from the line between a and b.
double distanceToLine(const Vec2& p, const Vec2& a, const Vec2& b);

/// Corners of the convex hull of some points, in order.
std::vector<Vec2> convexOutline(std::vector<Vec2> points);

}  // namespace carom::formats_detail
