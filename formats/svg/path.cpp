// SPDX-License-Identifier: MIT
#include "formats/svg/path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/svg/canvas.hpp"

namespace carom::formats_detail {
namespace {

constexpr std::size_t kBlock = 128;  // points that are simplified together

Vec2 tenthsOf(const Vec2& p) { return {std::round(10 * p.x()), std::round(10 * p.y())}; }

void keepFar(const std::vector<Vec2>& points, std::size_t first, std::size_t last, double tolerance,
             std::vector<char>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> spans{{first, last}};
  while (!spans.empty()) {
    const auto [from, to] = spans.back();
    spans.pop_back();
    double most = tolerance;
    std::size_t furthest = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off = distanceToLine(points[i], points[from], points[to]);
      if (!(off <= most)) most = off, furthest = i;
    }
    if (furthest == from) continue;
    kept[furthest] = 1;
    spans.emplace_back(from, furthest);
    spans.emplace_back(furthest, to);
  }
}

}  // namespace

void SvgPath::append(char command, const Vec2& step) {
  for (const double tenths : {step.x(), step.y()}) {
    const std::string number = svgNumber(tenths / 10);
    if (command != command_)
      out_ += command;
    else if (number[0] != '-')
      out_ += ' ';
    command_ = command;
    out_ += number;
  }
}

void SvgPath::move(const Vec2& to) {
  const Vec2 at = tenthsOf(to);
  command_ = 0;
  append('M', at);
  last_ = at;
}

void SvgPath::line(const Vec2& to) {
  const Vec2 at = tenthsOf(to);
  if (at == last_) return;
  append('l', at - last_);
  last_ = at;
}

void SvgPath::parabola(const Vec2& control, const Vec2& to) {
  const Vec2 middle = tenthsOf(control), at = tenthsOf(to);
  append('q', middle - last_);
  append('q', at - last_);
  last_ = at;
}

void SvgPath::stroke(const Vec2& from, double length) {
  if (out_.empty()) {
    move(from);
  } else {
    const Vec2 at = tenthsOf(from);
    command_ = 0;
    append('m', at - last_);
    last_ = at;
  }
  const double tenths = std::round(10 * length);
  out_ += 'h' + svgNumber(tenths / 10);
  last_.x() += tenths;
  command_ = 'h';
}

void SvgPath::close() {
  if (command_ == 'M') out_ += "l0 0";
  out_ += 'Z';
  command_ = 'Z';
}

double distanceToLine(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double share = d.squaredNorm() > 0 ? std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0) : 0;
  return (p - a - share * d).norm();
}

std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<char> kept(points.size(), 0);
  for (std::size_t first = 0; first + 1 < points.size();) {
    const std::size_t last = std::min(first + kBlock, points.size() - 1);
    kept[first] = kept[last] = 1;
    keepFar(points, first, last, tolerance, kept);
    first = last;
  }
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) out.push_back(points[i]);
  return out;
}

std::vector<Vec2> convexOutline(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  const auto half = [](const std::vector<Vec2>& sorted) {
    std::vector<Vec2> chain;
    for (const Vec2& p : sorted) {
      const auto turnsRight = [&](const Vec2& a, const Vec2& b) {
        const Vec2 ab = b - a, ap = p - a;
        return ab.x() * ap.y() - ab.y() * ap.x() <= 0;
      };
      while (chain.size() > 1 && turnsRight(chain[chain.size() - 2], chain.back())) chain.pop_back();
      chain.push_back(p);
    }
    return chain;
  };
  std::vector<Vec2> lower = half(points);
  std::reverse(points.begin(), points.end());
  const std::vector<Vec2> upper = half(points);
  if (lower.size() > 1) lower.pop_back();
  lower.insert(lower.end(), upper.begin(), upper.end() - (upper.size() > 1 ? 1 : 0));
  return lower;
}

}  // namespace carom::formats_detail
