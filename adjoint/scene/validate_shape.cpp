// SPDX-License-Identifier: MIT
#include "adjoint/scene/validation.hpp"

namespace carom::validation {
namespace {

constexpr int kDeepest = 16;  // compounds inside compounds

// What a shape must be: each checks the members of one kind, `where` being the kind's word ("/bodies/3/shape/box").
struct Checker {
  const Place& where;
  const char* derived;  // what is derived from the volume of a moving body; null when nothing is
  int depth;

  void operator()(const Sphere& s) const { requireLength(where / "radius", s.radius); }
  void operator()(const Box& s) const {
    for (int i = 0; i < 3; ++i) requireLength(where / "size" / i, s.size[i]);
  }
  void operator()(const Plane& s) const {
    if (!(std::abs(s.normal.norm() - 1) <= 1e-9))
      fail(where / "normal", "a vector of length " + text(s.normal.norm()), "a unit vector");
    requireFinite(where / "offset", s.offset);
  }
  void operator()(const Capsule& s) const {
    requireLength(where / "radius", s.radius);
    requireLength(where / "height", s.height);
  }
  void operator()(const Cylinder& s) const {
    requireLength(where / "radius", s.radius);
    requireLength(where / "height", s.height);
  }
  void operator()(const Hull& s) const {
    if (!s.surface) fail(where, "no surface", "one made by convexHull");
    if (!s.surface->closed || !(s.surface->volume > 0)) fail(where, "a surface that is not closed", "a convex hull");
    requireScale(s.scale, s);
  }
  void operator()(const Mesh& s) const {
    if (!s.surface) fail(where, "no surface", "one made by meshSurface");
    if (s.surface->faces.empty()) fail(where, "no triangles", "a triangle or more");
    requireScale(s.scale, s);
    if (derived && !s.surface->closed)
      fail(where, "an open mesh (" + border(*s.surface) + ") on a moving body, whose " + derived,
           "a closed mesh, or \"mass\" and \"inertia\" both written, or \"fixed\": true");
  }
  void operator()(const Compound& s) const;

  void requireScale(double scale, const Shape& shape) const {
    requirePositive(where / "scale", scale);
    if (scale == 1) return;  // the surface itself was checked when it was made
    const double extent = kindOf(shape).boundingRadius(shape);
    if (!(extent >= kLeastLength))
      fail(where / "scale", text(scale) + ", which takes it to " + text(extent) + " m",
           "an extent of at least " + text(kLeastLength) + " m");
    if (!(extent <= 2 * kLargest))
      fail(where / "scale", text(scale) + ", which takes it to " + text(extent) + " m", "coordinates of at most 1e9");
  }
  static std::string border(const Surface& s) {
    for (const Surface::Edge& e : s.edges)
      if (e.right < 0)
        return "the edge from " + text(s.vertices[static_cast<std::size_t>(e.from)]) + " to " +
               text(s.vertices[static_cast<std::size_t>(e.to)]) + " has one triangle";
    return "its surface does not close";
  }
};

void Checker::operator()(const Compound& s) const {
  if (s.parts.empty()) fail(where, "no parts", "one or more");
  if (depth == kDeepest) fail(where, "compounds nested deeper than " + std::to_string(kDeepest), "fewer levels");
  for (std::size_t i = 0; i < s.parts.size(); ++i) {
    const CompoundPart& part = s.parts[i];
    const Place here = where / i, kind = here / kindOf(part.shape).name;
    if (std::holds_alternative<Plane>(part.shape)) fail(kind, "a plane", "a part of finite extent");
    std::visit(Checker{kind, derived, depth + 1}, part.shape);
    requireFinite(here / "position", part.position);
    requireUnit(here / "orientation", part.orientation);
  }
}

}  // namespace

void validateShape(const Place& where, const Body& body) {
  const Place shape = where / "shape";
  const char* derived = nullptr;
  if (!body.fixed) {
    if (std::holds_alternative<Plane>(body.shape)) fail(shape, "a moving plane", "\"fixed\": true");
    if (body.inertia.source == Inertia::Source::derived) derived = "inertia is to be derived from its volume";
    if (body.density) derived = "mass is to be derived from its volume";
  }
  std::visit(Checker{shape / kindOf(body.shape).name, derived, 0}, body.shape);
}

}  // namespace carom::validation
