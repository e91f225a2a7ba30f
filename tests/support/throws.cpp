// SPDX-License-Identifier: MIT
#include "tests/support/throws.h"

#include <cmath>
#include <sstream>

#include "ode_bridge/convex_hull.h"

namespace carom::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Shape makeSphere(Random& r, bool) { return Sphere{r.in(0.05, 0.25)}; }
Shape makeBoxShape(Random& r, bool) { return Box{{r.in(0.06, 0.5), r.in(0.06, 0.5), r.in(0.06, 0.5)}}; }
Shape makePlaneShape(Random& r, bool) { return Plane{r.unit(), r.in(-0.3, 0.3)}; }
Shape makeCapsule(Random& r, bool) { return Capsule{r.in(0.03, 0.15), r.in(0.08, 0.4)}; }
Shape makeCylinder(Random& r, bool) { return Cylinder{r.in(0.04, 0.2), r.in(0.05, 0.4)}; }
Shape makeCone(Random& r, bool) { return Cone{r.in(0.04, 0.25), r.in(0.05, 0.5)}; }
Shape makeHull(Random& r, bool) { return pebbleHull(r, 6 + r.below(9)); }
Shape makeMesh(Random& r, bool fixed) {
  const double jitter = r.below(2) ? 0 : 0.006;
  if (fixed && r.below(3) == 0) return groundMesh(r);
  if (r.below(2)) return cupMesh(r, 5 + r.below(3), jitter);
  return bracketMesh(r, jitter);
}
Shape makeCompound(Random& r, bool) {
  using Maker = Shape (*)(Random&, bool);
  constexpr Maker makers[] = {makeSphere, makeBoxShape, makeCapsule, makeCylinder, makeHull};
  Compound c;
  const int parts = 2 + r.below(3);
  for (int i = 0; i < parts; ++i) {
    const Shape shape = makers[r.below(5)](r, false);
    c.parts.push_back({shape, r.vec(0.25), r.rotation()});
  }
  return c;
}

Mesh meshOf(Random& r, std::vector<Vec3> vertices, const std::vector<std::array<int, 3>>& triangles, double jitter) {
  const Vec3 shift = r.vec(0.05);
  for (Vec3& v : vertices) v += shift + r.vec(jitter);
  return {meshSurface(vertices, triangles), r.in(0.8, 1.25), ""};
}

/// A corner of a polygon, wrapped around.
void addQuad(std::vector<std::array<int, 3>>& triangles, int a, int b, int c, int d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

void giveMass(Body& body, Random& r) {
  if (r.below(2))
    body.mass = r.in(0.2, 3);
  else
    body.density = r.in(100, 2000);
  if (r.below(4) == 0)
    body.inertia = Inertia::fromMoments({r.in(0.004, 0.006), r.in(0.005, 0.007), r.in(0.006, 0.008)});
}

Body makeBody(const ShapeMaker& maker, const char* name, const char* material, bool fixed, Random& r) {
  Body body;
  body.name = name, body.material = material, body.fixed = fixed;
  body.shape = maker.make(r, fixed);
  body.orientation = r.rotation();
  if (fixed) return body;
  giveMass(body, r);
  if (r.below(8)) body.angular_velocity = r.vec(10);
  return body;
}

/// Where a body has to be so that it is surely apart from the other, which stands at the origin.
Vec3 startBeside(const Body& fixed, double reach, Random& r, Vec3& direction) {
  if (const auto* plane = std::get_if<Plane>(&fixed.shape)) {
    direction = fixed.orientation * plane->normal;
    Vec3 along = r.vec(0.5);
    along -= along.dot(direction) * direction;
    return fixed.position + (plane->offset + reach + r.in(0.01, 0.4)) * direction + along;
  }
  direction = r.unit();
  return fixed.position + (kindOf(fixed.shape).boundingRadius(fixed.shape) + reach + r.in(0.01, 0.4)) * direction;
}

}  // namespace

const std::vector<ShapeMaker>& shapeMakers() {
  static const std::vector<ShapeMaker> rows = {
      {"sphere", true, makeSphere},   {"box", true, makeBoxShape},      {"plane", false, makePlaneShape},
      {"capsule", true, makeCapsule}, {"cylinder", true, makeCylinder}, {"hull", true, makeHull},
      {"mesh", true, makeMesh},       {"compound", true, makeCompound}, {"cone", true, makeCone},
  };
  return rows;
}

std::vector<ShapePair> pairsThatMeet() {
  std::vector<ShapePair> pairs;
  for (const ShapeMaker& a : shapeMakers())
    for (const ShapeMaker& b : shapeMakers())
      if (a.moves || b.moves) pairs.push_back({&a, &b});
  return pairs;
}

Mesh bracketMesh(Random& random, double jitter) {
  const double length = random.in(0.2, 0.4), height = random.in(0.2, 0.4), bar = random.in(0.05, 0.1);
  const double width = random.in(0.06, 0.3);
  // the corners of an L, counter-clockwise
  const double x[] = {0, length, length, bar, bar, 0}, z[] = {0, 0, bar, bar, height, height};
  std::vector<Vec3> vertices;
  for (const double y : {width / 2, -width / 2})
    for (int i = 0; i < 6; ++i) vertices.push_back({x[i] - length / 2, y, z[i] - height / 2});
  std::vector<std::array<int, 3>> triangles = {{0, 3, 1}, {1, 3, 2}, {0, 5, 3},  {3, 5, 4},
                                               {6, 7, 9}, {7, 8, 9}, {6, 9, 11}, {9, 10, 11}};
  for (int i = 0; i < 6; ++i) addQuad(triangles, i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i);
  return meshOf(random, std::move(vertices), triangles, jitter);
}

Mesh cupMesh(Random& random, int sides, double jitter) {
  const double outer = random.in(0.1, 0.22), inner = outer - random.in(0.02, 0.05);
  const double height = random.in(0.12, 0.35), floor = random.in(0.03, 0.06);
  struct Ring {
    double radius, z;
  };
  const Ring rings[] = {{outer, 0}, {outer, height}, {inner, height}, {inner, floor}};
  std::vector<Vec3> vertices;
  for (const Ring& ring : rings)
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * kPi * i / sides;
      vertices.push_back({ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z - height / 2});
    }
  std::vector<std::array<int, 3>> triangles;
  for (int ring = 0; ring < 3; ++ring)
    for (int i = 0; i < sides; ++i) {
      const int j = (i + 1) % sides, low = ring * sides, high = low + sides;
      addQuad(triangles, low + i, low + j, high + j, high + i);
    }
  for (int i = 1; i + 1 < sides; ++i) {
    triangles.push_back({0, i + 1, i});                                  // from below
    triangles.push_back({3 * sides, 3 * sides + i, 3 * sides + i + 1});  // the inside's floor
  }
  return meshOf(random, std::move(vertices), triangles, jitter);
}

Mesh groundMesh(Random& random) {
  constexpr int n = 4;
  const double square = random.in(0.08, 0.15);
  std::vector<Vec3> vertices;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) vertices.push_back({square * (i - n / 2), square * (j - n / 2), random.in(0, 0.06)});
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int at = i * (n + 1) + j;
      addQuad(triangles, at, at + n + 1, at + n + 2, at + 1);
    }
  return meshOf(random, std::move(vertices), triangles, 0);
}

Hull pebbleHull(Random& random, int points) {
  const Vec3 axes(random.in(0.08, 0.3), random.in(0.08, 0.3), random.in(0.08, 0.3)), shift = random.vec(0.05);
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(shift + axes.cwiseProduct(random.unit()));
  return {convexHull(cloud), random.in(0.8, 1.25), ""};
}

Throw randomThrow(const ShapeMaker& a, const ShapeMaker& b, std::uint64_t seed) {
  Random r(seed);
  Throw t;
  t.duration = r.in(0.15, 0.5);
  Scene& scene = t.scene;
  scene.gravity = r.below(4) ? r.in(1, 12) * r.unit() : Vec3(Vec3::Zero());
  scene.materials = {makeMaterial("m", r.in(0.2, 0.95), r.in(0.05, 0.9), r.in(-0.5, 0.5)),
                     makeMaterial("n", r.in(0.2, 0.95), r.in(0.05, 0.9), r.in(-0.5, 0.5))};
  const int standing = r.below(4);  // 0, 1: that one is fixed; else none
  const bool fixed_a = !a.moves || (b.moves && standing == 0);
  const bool fixed_b = !b.moves || (a.moves && standing == 1);
  scene.bodies = {makeBody(a, "a", "m", fixed_a, r), makeBody(b, "b", "n", fixed_b, r)};

  // `flying` is thrown at `target`, which may fly as well
  const bool flip = fixed_a;
  Body &flying = scene.bodies[flip ? 1 : 0], &target = scene.bodies[flip ? 0 : 1];
  target.position = r.vec(0.3);
  const double reach = kindOf(flying.shape).boundingRadius(flying.shape);
  Vec3 direction;
  flying.position = startBeside(target, reach, r, direction);
  if (!target.fixed) target.velocity = r.vec(1);
  const double time = t.duration * r.in(0.3, 0.9);
  const bool flat = std::holds_alternative<Plane>(target.shape);
  const double wide = flat ? 0.3 : 0.8 * kindOf(target.shape).boundingRadius(target.shape);
  const Vec3 way = (flat ? Vec3(-direction) : Vec3(target.position - flying.position)) + wide * r.vec(1);
  flying.velocity = target.velocity + way / time;
  if (target.fixed) flying.velocity -= scene.gravity * (time / 2);
  return t;
}

std::string describe(const Throw& t) {
  std::ostringstream out;
  out.precision(17);
  const auto vector = [&](const char* name, const Vec3& v) {
    out << " " << name << " {" << v.x() << ", " << v.y() << ", " << v.z() << "}";
  };
  vector("gravity", t.scene.gravity);
  out << " duration " << t.duration << "\n";
  for (const Body& b : t.scene.bodies) {
    out << b.name << ": " << kindOf(b.shape).name << (b.fixed ? " fixed" : "") << " dimensions {"
        << kindOf(b.shape).dimensions(b.shape).transpose() << "}";
    vector("position", b.position);
    const Quat& q = b.orientation;
    out << " orientation {" << q.w() << ", " << q.x() << ", " << q.y() << ", " << q.z() << "}";
    vector("velocity", b.velocity);
    vector("spin", b.angular_velocity);
    out << "\n";
  }
  return out.str();
}

}  // namespace carom::test
