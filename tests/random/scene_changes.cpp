// SPDX-License-Identifier: MIT
#include "tests/random/scene_changes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ode_bridge/convex_hull.h"
#include "tests/support/solids.h"

namespace carom::metamorphic {
namespace {

BodyState same(const BodyState& s, double) { return s; }

constexpr const char* kKinds[] = {"boxes", "hulls", "meshes", "compounds"};

Shape boxAs(Kind kind, const Vec3& size) {
  switch (kind) {
    case Kind::box:
      return Box{size};
    case Kind::hull:
      return Hull{convexHull(test::boxTriangles(size).vertices), 1, ""};
    case Kind::mesh:
      return Mesh{test::boxTriangles(size).surface(), 1, ""};
    case Kind::compound:
      break;
  }
  Compound one;
  one.parts.push_back({Box{size}, Vec3::Zero(), Quat::Identity()});
  return one;
}

}  // namespace

Change turned(const Scene& scene, test::Random& random) {
  Change c{"turned", scene, {}, 1, 1};
  const Quat q = random.rotation();
  c.scene.gravity = q * scene.gravity;
  for (Body& b : c.scene.bodies) {
    b.position = q * b.position;
    b.orientation = (q * b.orientation).normalized();
    b.velocity = q * b.velocity;
    b.angular_velocity = q * b.angular_velocity;
  }
  c.back = [q](const BodyState& s, double) {
    const Quat r = q.conjugate();
    return BodyState{r * s.position, (r * s.orientation).normalized(), r * s.velocity, r * s.angular_velocity};
  };
  return c;
}

Change moved(const Scene& scene, test::Random& random) {
  Change c{"moved by 1 km", scene, {}, 1, 1000};
  const Vec3 by = 1000 * random.unit();
  for (Body& b : c.scene.bodies) b.position += by;
  c.back = [by](BodyState s, double) {
    s.position -= by;
    return s;
  };
  return c;
}

Change mirrored(const Scene& scene) {
  const auto flip = [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); };
  const auto flipTurn = [](const Vec3& w) { return Vec3(w.x(), -w.y(), -w.z()); };
  const auto flipPose = [](const Quat& q) { return Quat(q.w(), q.x(), -q.y(), -q.z()); };
  Change c{"mirrored", scene, {}, 1, 1};
  for (Body& b : c.scene.bodies) {
    b.position = flip(b.position);
    b.orientation = flipPose(b.orientation);
    b.velocity = flip(b.velocity);
    b.angular_velocity = flipTurn(b.angular_velocity);
    if (Plane* plane = std::get_if<Plane>(&b.shape)) plane->normal = flip(plane->normal);
  }
  c.back = [=](const BodyState& s, double) {
    return BodyState{flip(s.position), flipPose(s.orientation), flip(s.velocity), flipTurn(s.angular_velocity)};
  };
  return c;
}

bool hasPlanes(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& b) { return std::holds_alternative<Plane>(b.shape); });
}

Change boosted(const Scene& scene, test::Random& random) {
  Change c{"boosted", scene, {}, 1, 30};
  const Vec3 v = 30 * random.unit();
  for (Body& b : c.scene.bodies) {
    if (b.fixed) b.fixed = false, b.kinematic = true;
    b.velocity += v;
  }
  c.back = [v](BodyState s, double t) {
    s.position -= t * v;
    s.velocity -= v;
    return s;
  };
  return c;
}

Change inUnits(const Scene& scene, double L, double T, double M) {
  Change c{"other units", scene, {}, T, 1};
  c.scene.gravity *= L / (T * T);
  for (Body& b : c.scene.bodies) {
    b.position *= L;
    b.velocity *= L / T;
    b.angular_velocity /= T;
    if (b.mass) *b.mass *= M;
    if (b.density) *b.density *= M / (L * L * L);
    if (Plane* plane = std::get_if<Plane>(&b.shape)) {
      plane->offset *= L;
    } else {
      const ShapeKind& kind = kindOf(b.shape);
      kind.setDimensions(b.shape, L * kind.dimensions(b.shape));
    }
  }
  c.back = [=](BodyState s, double) {
    s.position /= L;
    s.velocity /= L / T;
    s.angular_velocity *= T;
    return s;
  };
  return c;
}

// Inches, pounds and milliseconds, or the like.
Change inUnits(const Scene& scene, test::Random& random) {
  const double L = std::pow(10, random.in(-2, 2)), T = std::pow(10, random.in(-1, 1)), M = std::pow(10, random.in(-3, 3));
  return inUnits(scene, L, T, M);
}

Change reordered(const Scene& scene, test::Random& random) {
  Change c{"in another order", scene, same, 1, 1};
  for (std::size_t i = c.scene.bodies.size(); i > 1; --i)
    std::swap(c.scene.bodies[i - 1], c.scene.bodies[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return c;
}

Change withFarBodies(const Scene& scene, test::Random& random) {
  Change c{"with far bodies", scene, same, 1, 1};
  Vec3 away = random.unit();
  if (hasPlanes(scene)) away = Vec3(0, 0, 1);  // within walls that lean inwards they would strike them
  for (int i = 0; i < 3; ++i) {
    Body far = test::makeBall("far" + std::to_string(i), 0.5, 1e5 * (i + 1) * away, 10 * away);
    far.material = scene.materials[0].name;
    c.scene.bodies.insert(c.scene.bodies.begin() + random.below(static_cast<int>(c.scene.bodies.size())), far);
  }
  return c;
}

Change boxesAs(Kind kind, const Scene& scene) {
  Change c{std::string("boxes as ") + kKinds[static_cast<int>(kind)], scene, same, 1, 1};
  for (Body& b : c.scene.bodies)
    if (const Box* box = std::get_if<Box>(&b.shape)) b.shape = boxAs(kind, Vec3(box->size));
  return c;
}

Change planesAs(Kind kind, const Scene& scene) {
  constexpr double kBlock = 40;
  Change c{std::string("planes as ") + kKinds[static_cast<int>(kind)], scene, same, 1, kBlock};
  for (Body& b : c.scene.bodies) {
    const Plane* plane = std::get_if<Plane>(&b.shape);
    if (!plane) continue;
    const Vec3 n = b.orientation * plane->normal;
    const double top = plane->offset + n.dot(b.position);
    b.position = (top - kBlock / 2) * n;
    b.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), n).normalized();
    b.shape = boxAs(kind, Vec3::Constant(kBlock));
  }
  return c;
}

}  // namespace carom::metamorphic
