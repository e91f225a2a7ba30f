// SPDX-License-Identifier: MIT
// The bits of eleven long motions of different kinds, as hashes: the same in every build type and on every machine.
// Nothing here calls a function of the C library whose last digit may differ, in the scenes neither.
//
// A change of the arithmetic of motions (another order of sums, another series) changes the hashes of the motions that
// use it. Where that is meant, run the test and copy the hashes that it prints into the table; where it is not meant,
// it is a finding.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "ode_bridge/convex_hull.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom::test {
namespace {

const Vec3 kDown(0, 0, -9.81);

// FNV-1a over the bytes of numbers.
class Hash {
 public:
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(int x) { add(static_cast<std::uint64_t>(x)); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& v) {
    for (Eigen::Index i = 0; i < v.size(); ++i) add(v[i]);
  }
  std::uint64_t value() const { return value_; }

 private:
  void add(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) value_ = (value_ ^ ((bits >> (8 * i)) & 255)) * 1099511628211u;
  }
  std::uint64_t value_ = 14695981039346656037u;
};

std::uint64_t hashOf(const Motion& motion) {
  Hash hash;
  hash.add(motion.end);
  hash.add(static_cast<int>(motion.status));
  for (const Event& event : motion.events) {
    hash.add(event.time), hash.add(static_cast<int>(event.mode));
    for (const Contact& c : event.contacts) {
      for (int i : {c.a, c.b, static_cast<int>(c.features.kind), c.features.a, c.features.b}) hash.add(i);
      hash.add(c.at.point), hash.add(c.at.normal), hash.add(c.impulse);
    }
  }
  for (std::size_t body = 0; body < motion.world_lines.size(); ++body) {
    for (const Arc& arc : motion.world_lines[body].arcs) {
      const State& s = arc.startState();
      hash.add(arc.start()), hash.add(s.x), hash.add(s.v), hash.add(s.L), hash.add(s.q.coeffs());
    }
    const BodyState last = motion.stateAt(static_cast<int>(body), motion.end);
    hash.add(last.position), hash.add(last.velocity), hash.add(last.orientation.coeffs());
    hash.add(last.angular_velocity);
  }
  return hash.value();
}

void addWalls(std::vector<Body>& bodies, double size) {
  for (int k = 0; k < 3; ++k) {
    bodies.push_back(makePlane("low " + std::to_string(k), Vec3::Unit(k), 0));
    bodies.push_back(makePlane("high " + std::to_string(k), -Vec3::Unit(k), -size));
  }
}

// Bodies of these shapes in turn, thrown about in a cube with cells of 0.3 m.
Scene pen(int count, const std::vector<Shape>& shapes, double elasticity, double friction) {
  int side = 1;
  while (side * side * side < count) ++side;
  Random random(static_cast<std::uint64_t>(count));
  std::vector<Body> bodies;
  addWalls(bodies, 0.3 * side);
  for (int i = 0; i < count; ++i) {
    const Vec3 at = 0.3 * Vec3(i % side + 0.5, i / side % side + 0.5, i / (side * side) + 0.5);
    const Vec3 start = at + random.vec(0.02), velocity = random.vec(3);
    Body body = makeBall(std::to_string(i), 0.1, start, velocity);
    body.shape = shapes[static_cast<std::size_t>(i) % shapes.size()];
    body.angular_velocity = random.vec(5);
    const Vec3 turn = random.vec(1);
    body.orientation = Quat(random.in(-1, 1), turn.x(), turn.y(), turn.z()).normalized();
    bodies.push_back(body);
  }
  return makeScene(kDown, elasticity, friction, bodies);
}

// A star: a ball of triangles whose first twelve corners stand out, so that its edges are reflex in turn.
Mesh star() {
  Triangles ball = ballTriangles(0.06, 1);
  for (std::size_t i = 0; i < 12; ++i) ball.vertices[i] *= 1.7;
  return {ball.surface(), 1, ""};
}

Hull stone() {
  Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) points.push_back(0.11 * random.vec(1).normalized());
  return {convexHull(points), 1, ""};
}

Compound hammer() {
  Compound c;
  c.parts.push_back({Cylinder{0.02, 0.16}, Vec3(0, 0, -0.02), Quat::Identity()});
  c.parts.push_back({Box{{0.12, 0.05, 0.05}}, Vec3(0, 0, 0.07), Quat::Identity()});
  return c;
}

Scene spinning(const Vec3& size, const Vec3& spin) {
  Body body = makeBox("body", size, Vec3(0, 0, 1), Vec3(0.1, 0, 0));
  body.angular_velocity = spin;
  return makeScene(Vec3::Zero(), 1, 0, {body});
}

struct Row {
  const char* name;
  Scene scene;
  double duration;
  std::size_t impacts;  // events at the most; so many there are, but in free flight
  std::uint64_t hash;
};

std::vector<Row> rows() {
  return {
      {"thirty boxes", pen(30, {Box{{0.1, 0.14, 0.08}}}, 0.97, 0.2), 100, 1200, 0x6e47c78435cf5d3},
      {"boxes and balls", pen(27, {Box{{0.14, 0.1, 0.1}}, Sphere{0.1}}, 0.95, 0.3), 100, 800, 0xcdd5dcccd1ab45e9},
      {"balls alone", pen(125, {Sphere{0.1}}, 1, 0), 100, 4000, 0x457d647fb76d6172},
      {"billiard with friction", pen(8, {Sphere{0.12}}, 0.99, 0.4), 100, 1000, 0x172e03317a5f8a52},
      {"capsules and cylinders", pen(8, {Capsule{0.05, 0.1}, Cylinder{0.07, 0.1}}, 0.97, 0.2), 100, 250,
       0xe59be69bbe2f3710},
      {"stones", pen(8, {stone()}, 0.97, 0.2), 100, 250, 0x579488e62902611a},
      {"stars", pen(4, {star()}, 0.97, 0.1), 100, 150, 0x99787a03ba0c9985},
      {"hammers", pen(6, {hammer(), Sphere{0.09}}, 0.97, 0.2), 100, 200, 0x5e746ef08419d4ce},
      {"cones", pen(8, {Cone{0.09, 0.14}, Box{{0.12, 0.1, 0.1}}, Cone{0.06, 0.18}}, 0.97, 0.2), 100, 200,
       0x3060cd4ddbb12521},
      {"triaxial spin", spinning({0.3, 0.2, 0.1}, {0.2, 7, 0.1}), 5000, 10, 0xdba312752931f131},
      {"spin near the separatrix", spinning({0.3, 0.2, 0.1}, {1e-7, 5, 1e-8}), 500, 10, 0xe142d74632eaa94b},
  };
}

TEST(LongMotions, HaveTheBitsThatTheyAlwaysHad) {
  for (const Row& row : rows()) {
    const Motion motion = play(row.scene, row.duration, row.impacts);
    if (row.impacts > 10) {
      EXPECT_EQ(motion.events.size(), row.impacts) << row.name << ": " << motion.message;
    }
    const std::uint64_t hash = hashOf(motion);
    EXPECT_EQ(hash, row.hash) << row.name << " has the hash 0x" << std::hex << hash;
  }
}

}  // namespace
}  // namespace carom::test
