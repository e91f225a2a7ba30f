#include "formats/detail/svg_silhouette.hpp"

#include <algorithm>
#include <cmath>

#include "formats/detail/gltf_mesh.hpp"
#include "formats/detail/svg_contours.hpp"
#include "formats/shape_extent.h"

namespace carom {
namespace {

constexpr double kFlat = 0.12;    // pixels that a curve may be off
constexpr double kPiece = 5;      // pixels of a line that are judged as one
constexpr double kBeside = 0.35;  // pixels from a line to the places that tell whether it is an outline
// Products of pieces and triangles (or pieces): a shape of more is drawn as its area, with all its loops as outline.
constexpr double kMostWork = 3e7;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double share = d.squaredNorm() > 0 ? std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0) : 0;
  return (p - a - share * d).norm();
}

// Leaves out points that lie on the line between those that stay.
std::vector<Vec2> thinned(const std::vector<Vec2>& points) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool end = i == 0 || i + 1 == points.size();
    if (end || distance(points[i], out.back(), points[i + 1]) > kFlat) out.push_back(points[i]);
  }
  return out;
}

// Tenths of a pixel, and steps from point to point: pictures of many bodies are mostly these numbers.
void addPath(std::string& out, const std::vector<Vec2>& points, bool closed) {
  const auto append = [&](double tenths) {
    const std::string number = svgNumber(tenths / 10);
    if (number[0] != '-' && out.back() != 'M' && out.back() != 'l') out += ' ';
    out += number;
  };
  Vec2 last(0, 0);
  bool first = true;
  for (const Vec2& p : thinned(points)) {
    const Vec2 tenths(std::round(10 * p.x()), std::round(10 * p.y())), step = tenths - last;
    if (!first && step.isZero(0)) continue;
    if (first) out += 'M';
    append(step.x());
    append(step.y());
    if (first) out += 'l';
    last = tenths, first = false;
  }
  if (out.ends_with('l')) out += "0 0";
  if (closed) out += 'Z';
}

// A short piece of a line, in pixels, with its depth towards the viewer in metres.
struct Piece {
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
    std::vector<Piece> outline, seen;
    for (const Piece& piece : loops_)
      if (bordersNothing(piece))
        outline.push_back(piece);
      else if (!hidden(piece))
        seen.push_back(piece);
    for (const Piece& piece : edges_)
      if (!hidden(piece)) seen.push_back(piece);
    out.outline = joined(outline);
    out.edges = joined(seen);
  }

 private:
  void cut(const Vec3& a, const Vec3& b, std::vector<Piece>& out) const {
    const double length = (view_.pixel(b) - view_.pixel(a)).norm(), count = std::max(1.0, std::ceil(length / kPiece));
    for (double i = 0; i < count; ++i) {
      const Vec3 from = a + (i / count) * (b - a), to = a + ((i + 1) / count) * (b - a);
      out.push_back({view_.pixel(from), view_.pixel(to), 0.5 * (from + to).dot(view_.towardsViewer())});
    }
  }

  // How often the loops run round a point.
  int winding(const Vec2& p) const {
    int turns = 0;
    for (const Piece& piece : loops_) {
      const bool up = piece.a.y() <= p.y() && piece.b.y() > p.y(), down = piece.b.y() <= p.y() && piece.a.y() > p.y();
      if (!up && !down) continue;
      const double side = cross(piece.b - piece.a, p - piece.a);
      turns += up && side > 0 ? 1 : down && side < 0 ? -1 : 0;
    }
    return turns;
  }

  bool bordersNothing(const Piece& piece) const {
    const Vec2 d = piece.b - piece.a;
    if (!(d.norm() > 0)) return false;
    const Vec2 beside = kBeside * Vec2(-d.y(), d.x()).normalized();
    return winding(piece.middle() + beside) == 0 || winding(piece.middle() - beside) == 0;
  }

  bool hidden(const Piece& piece) const {
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

  static std::string joined(const std::vector<Piece>& pieces) {
    std::string out;
    std::vector<Vec2> run;
    for (const Piece& piece : pieces) {
      if (!run.empty() && run.back() != piece.a) addPath(out, run, false), run.clear();
      if (run.empty()) run.push_back(piece.a);
      run.push_back(piece.b);
    }
    if (!run.empty()) addPath(out, run, false);
    return out;
  }

  const View& view_;
  double slack_;  // m: less than this behind the mesh is not hidden
  std::vector<Piece> loops_, edges_;
  TriangleMesh mesh_;  // pixels and depth
};

}  // namespace

Silhouette silhouetteOf(const Shape& shape, const Vec3& x, const Quat& q, const View& view) {
  Contours contours;
  addContours(contours, shape, x, q, view.towardsViewer());
  Silhouette out;
  for (const auto& loop : contours.loops) {
    std::vector<Vec2> points;
    for (const Vec3& p : loop) points.push_back(view.pixel(p));
    addPath(out.area, points, true);
  }
  if (!contours.convex) {
    const Judge judge(contours, shape, x, q, view);
    if (judge.affordable()) judge.draw(out);
    return out;
  }
  for (const auto& [a, b] : contours.edges) addPath(out.edges, {view.pixel(a), view.pixel(b)}, false);
  return out;
}

}  // namespace carom
