// SPDX-License-Identifier: MIT
#include "formats/svg/silhouette.hpp"

#include <algorithm>
#include <cmath>

#include "formats/drawing/triangle_mesh.hpp"
#include "formats/shapes/rows.hpp"
#include "formats/svg/contours.hpp"
#include "formats/svg/path.hpp"

namespace carom::formats_detail {
namespace {

constexpr double kFlat = 0.12;    // pixels that the line of an outline may be off
constexpr double kMostPieces = 2000;  // of a line: of what is so long far most is outside the picture
constexpr double kPiece = 5;      // pixels of a line that are judged as one
constexpr double kBeside = 0.35;  // pixels from a line to the places that tell whether it is an outline
// Products of pieces and triangles (or pieces): a shape of more is drawn as its area, with all its loops as outline.
constexpr double kMostWork = 3e7;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

std::vector<Vec2> pixelsOf(const std::vector<Vec3>& points, const View& view) {
  std::vector<Vec2> out;
  for (const Vec3& p : points) out.push_back(view.pixel(p));
  return out;
}

Contours contoursOf(const Shape& shape, const Vec3& x, const Quat& q, const View& view) {
  Contours contours;
  addContours(contours, shape, x, q, view.towardsViewer());
  return contours;
}

// Adds a line, simplified, to path data.
void addLine(std::string& out, const std::vector<Vec2>& points, bool closed, double tolerance) {
  SvgPath path;
  bool first = true;
  for (const Vec2& p : simplified(points, tolerance)) {
    if (first)
      path.move(p);
    else
      path.line(p);
    first = false;
  }
  if (closed) path.close();
  out += path.data();
}

// A short piece of a line, in pixels, with its depth towards the viewer in metres.
struct OutlinePiece {
  Vec2 a, b;
  double depth = 0;  // of its middle
  Vec2 middle() const { return 0.5 * (a + b); }
};

class Judge {
 public:
  Judge(const Contours& contours, const Shape& shape, const Vec3& x, const Quat& q, const View& view)
      : view_(view), slack_(0.005 * radiusAbout(shape, Vec3::Zero())) {
    for (const auto& loop : contours.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) cut(loop[i], loop[(i + 1) % loop.size()], loops_);
    for (const auto& [a, b] : contours.edges) cut(a, b, edges_);
    mesh_ = meshOf(shape, 0);
    for (Vec3& p : mesh_.positions) {
      const Vec3 world = x + q * p;
      const Vec2 pixel = view.pixel(world);
      p = Vec3(pixel.x(), pixel.y(), world.dot(view.towardsViewer()));
    }
  }

  bool affordable() const {
    const auto pieces = static_cast<double>(loops_.size()), all = pieces + static_cast<double>(edges_.size());
    return pieces * pieces + all * static_cast<double>(mesh_.triangles.size() + mesh_.accent.size()) / 3 < kMostWork;
  }

  void draw(Silhouette& out) const {
    std::vector<OutlinePiece> outline, seen;
    for (const OutlinePiece& piece : loops_)
      if (bordersNothing(piece))
        outline.push_back(piece);
      else if (!hidden(piece))
        seen.push_back(piece);
    for (const OutlinePiece& piece : edges_)
      if (!hidden(piece)) seen.push_back(piece);
    out.outline = joined(outline);
    out.edges = joined(seen);
  }

 private:
  void cut(const Vec3& a, const Vec3& b, std::vector<OutlinePiece>& out) const {
    const double length = (view_.pixel(b) - view_.pixel(a)).norm();
    const double count = std::clamp(std::ceil(length / kPiece), 1.0, kMostPieces);
    for (double i = 0; i < count; ++i) {
      const Vec3 from = a + (i / count) * (b - a), to = a + ((i + 1) / count) * (b - a);
      out.push_back({view_.pixel(from), view_.pixel(to), 0.5 * (from + to).dot(view_.towardsViewer())});
    }
  }

  // How often the loops run round a point.
  int winding(const Vec2& p) const {
    int turns = 0;
    for (const OutlinePiece& piece : loops_) {
      const bool up = piece.a.y() <= p.y() && piece.b.y() > p.y(), down = piece.b.y() <= p.y() && piece.a.y() > p.y();
      if (!up && !down) continue;
      const double side = cross(piece.b - piece.a, p - piece.a);
      turns += up && side > 0 ? 1 : down && side < 0 ? -1 : 0;
    }
    return turns;
  }

  bool bordersNothing(const OutlinePiece& piece) const {
    const Vec2 d = piece.b - piece.a;
    if (!(d.norm() > 0)) return false;
    const Vec2 beside = kBeside * Vec2(-d.y(), d.x()).normalized();
    return winding(piece.middle() + beside) == 0 || winding(piece.middle() - beside) == 0;
  }

  bool hidden(const OutlinePiece& piece) const {
    return coveredBy(mesh_.triangles, piece.middle(), piece.depth + slack_) ||
           coveredBy(mesh_.accent, piece.middle(), piece.depth + slack_);
  }

  bool coveredBy(const std::vector<std::uint32_t>& triangles, const Vec2& p, double depth) const {
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
      const Vec3 &a = mesh_.positions[triangles[i]], &b = mesh_.positions[triangles[i + 1]],
                 &c = mesh_.positions[triangles[i + 2]];
      if (std::max({a.z(), b.z(), c.z()}) <= depth) continue;
      const Vec2 ab = (b - a).head<2>(), ac = (c - a).head<2>(), ap = p - a.head<2>();
      const double area = cross(ab, ac), u = cross(ap, ac) / area, v = cross(ab, ap) / area;  // not finite edge-on
      if (u >= 0 && v >= 0 && u + v <= 1 && a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z()) > depth) return true;
    }
    return false;
  }

  static std::string joined(const std::vector<OutlinePiece>& pieces) {
    std::string out;
    std::vector<Vec2> run;
    for (const OutlinePiece& piece : pieces) {
      if (!run.empty() && run.back() != piece.a) addLine(out, run, false, kFlat), run.clear();
      if (run.empty()) run.push_back(piece.a);
      run.push_back(piece.b);
    }
    if (!run.empty()) addLine(out, run, false, kFlat);
    return out;
  }

  const View& view_;
  double slack_;  // m: less than this behind the mesh is not hidden
  std::vector<OutlinePiece> loops_, edges_;
  TriangleMesh mesh_;  // pixels and depth
};

}  // namespace

Silhouette silhouetteOf(const Shape& shape, const Vec3& x, const Quat& q, const View& view) {
  const Contours contours = contoursOf(shape, x, q, view);
  Silhouette out;
  for (const auto& loop : contours.loops) addLine(out.area, pixelsOf(loop, view), true, kFlat);
  if (!contours.convex) {
    const Judge judge(contours, shape, x, q, view);
    if (judge.affordable()) judge.draw(out);
    return out;
  }
  for (const auto& [a, b] : contours.edges) addLine(out.edges, {view.pixel(a), view.pixel(b)}, false, kFlat);
  return out;
}

std::string silhouetteArea(const Shape& shape, const Vec3& x, const Quat& q, const View& view, double tolerance) {
  const Contours contours = contoursOf(shape, x, q, view);
  std::string out;
  for (const auto& loop : contours.loops) {
    const std::vector<Vec2> points = pixelsOf(loop, view);
    Vec2 low = points.front(), high = low;
    for (const Vec2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    // What is smaller than the tolerance may go, unless it is all there is.
    if (contours.loops.size() == 1 || (high - low).maxCoeff() > tolerance) addLine(out, points, true, tolerance);
  }
  return out;
}

std::string silhouetteHull(const Shape& shape, const Vec3& x, const Quat& q, const View& view, double tolerance) {
  const Contours contours = contoursOf(shape, x, q, view);
  std::vector<Vec2> points;
  for (const auto& loop : contours.loops)
    for (const Vec3& p : loop) points.push_back(view.pixel(p));
  std::string out;
  if (!points.empty()) addLine(out, convexOutline(std::move(points)), true, tolerance);
  return out;
}

}  // namespace carom::formats_detail
