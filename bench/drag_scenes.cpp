// SPDX-License-Identifier: MIT
#include "bench/drag_scenes.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// A generator of our own: the standard distributions differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double within(double low, double high) {
    // splitmix64 (Steele, Lea and Flood 2014)
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

constexpr double kWall = 2.5;  // m

Scene room(double elasticity, double friction) {
  Scene scene;
  scene.materials = {{.name = "floor", .elasticity = elasticity, .friction = friction},
                     {.name = "toy", .elasticity = elasticity, .friction = friction}};
  const auto plane = [&](const char* name, const Vec3& normal, double offset) {
    Body body;
    body.name = name, body.fixed = true, body.material = "floor", body.shape = Plane{normal, offset};
    scene.bodies.push_back(body);
  };
  plane("floor", Vec3::UnitZ(), 0);
  plane("wall", -Vec3::UnitX(), -kWall);
  return scene;
}

void put(Scene& scene, const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity,
         const Vec3& spin) {
  Body body;
  body.name = name, body.material = "toy", body.density = 400, body.shape = shape;
  body.position = position, body.velocity = velocity, body.angular_velocity = spin;
  scene.bodies.push_back(body);
}

DragCase oneBall() {
  DragCase c{.name = "ball", .scene = room(0.8, 0.3), .duration = 2.4};
  put(c.scene, "ball", Sphere{0.1}, {0, 0, 1}, {0.9, 0, 1}, {0, 8, 0});
  c.controls = {velocity("ball"), angularVelocity("ball"), elasticity("toy"), friction("toy")};
  c.body = "ball", c.at = 2.2;
  return c;
}

DragCase oneBox() {
  DragCase c{.name = "box", .scene = room(0.6, 0.4), .duration = 1.25};
  put(c.scene, "box", Box{{0.3, 0.2, 0.1}}, {0, 0, 1}, {1.5, 0.1, 1.5}, {2, 3, 1});
  c.controls = {position("box"), orientation("box"), velocity("box"), angularVelocity("box"), elasticity("toy"),
                friction("toy"), mass("box"),        inertia("box"),  tilt("box", 1)};
  c.body = "box", c.at = 1.1;
  return c;
}

/// Dragged against the wall, and to places behind it.
DragCase boxAtTheWall() {
  DragCase c = oneBox();
  c.name = "box at a wall";
  c.scene.bodies.back().velocity = {2.2, 0.1, 1.5};
  c.at = 1.0;
  c.farthest_x = kWall - 0.5 * 0.1;  // its flattest side against the wall
  return c;
}

DragCase nailedBox() {
  DragCase c = oneBox();
  c.name = "box with nail";
  c.nails = {nailConstraint("box", 0.0, {.position = Vec3(0, 0, 1)})};
  c.grip.orientation = true;
  c.at = 0.9;
  return c;
}

DragCase threeBodies() {
  DragCase c{.name = "three bodies", .scene = room(0.7, 0.3), .duration = 1};
  put(c.scene, "cue", Sphere{0.12}, {0, 0, 0.9}, {2.4, 0.02, 1.2}, {0, 6, 0});
  put(c.scene, "box", Box{{0.25, 0.2, 0.2}}, {1.2, 0, 0.9}, {-0.6, 0, 1.8}, {1, 2, 0.5});
  put(c.scene, "ball", Sphere{0.1}, {1.9, 0.05, 0.6}, {-0.3, 0, 1.5}, {0, -5, 0});
  for (const char* name : {"cue", "box", "ball"}) {
    c.controls.push_back(velocity(name));
    c.controls.push_back(angularVelocity(name));
  }
  for (const char* name : {"cue", "ball"}) c.controls.push_back(position(name));
  c.controls.push_back(orientation("box"));
  c.controls.push_back(elasticity("toy"));
  c.controls.push_back(friction("toy"));
  c.body = "box", c.at = 0.85;
  return c;
}

DragCase tenBodies(const std::string& name, const Shape& shape, double at) {
  DragCase c{.name = name, .scene = room(0.6, 0.3), .duration = 1.4, .limit = 16};
  Random random(7);
  for (int i = 0; i < 10; ++i) {
    const Vec3 place(0.55 * (i % 5) - 0.9, 0.5 * (i / 5) - 0.25, 0.8 + 0.25 * (i % 3));
    const Vec3 speed(random.within(0.2, 1.2), random.within(-0.4, 0.4), random.within(0, 1.5));
    const Vec3 spin(random.within(-3, 3), random.within(-3, 3), random.within(-3, 3));
    const std::string toy = "toy " + std::to_string(i);
    put(c.scene, toy, shape, place, speed, spin);
    c.controls.push_back(velocity(toy));
    c.controls.push_back(angularVelocity(toy));
  }
  c.body = "toy 7", c.at = at;
  return c;
}

}  // namespace

std::vector<DragCase> dragCases() {
  return {oneBall(),
          oneBox(),
          nailedBox(),
          boxAtTheWall(),
          threeBodies(),
          tenBodies("ten balls", Sphere{0.1}, 1.2),
          tenBodies("ten boxes", Box{{0.22, 0.16, 0.12}}, 1.0)};
}

std::vector<Vec3> mousePath(const Vec3& start, double wide, double seconds, std::uint64_t seed) {
  constexpr double kRate = 60;       // Hz
  constexpr double kPixel = 0.0015;  // m
  Random random(seed);
  const double tremor_x = random.within(8, 12), tremor_z = random.within(8, 12);  // Hz
  const double phase_x = random.within(0, 6.28), phase_z = random.within(0, 6.28);
  std::vector<Vec3> path;
  Vec3 from = start, to = start;
  double begin = 0, end = 0, rest = 0;
  for (int frame = 0; frame < static_cast<int>(seconds * kRate); ++frame) {
    const double t = frame / kRate;
    if (t >= end + rest) {
      from = to;
      const double up = random.within(-0.6 * wide, wide), aside = random.within(-wide, wide);
      to = start + Vec3(aside, 0, up);
      to.z() = std::max(to.z(), 0.25);
      const double far = (to - from).norm();
      begin = t, end = t + 0.25 + 0.25 * std::log2(1 + far / 0.02);  // Fitts' law, for a target of 2 cm
      rest = random.within(0, 0.4);
    }
    const double s = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
    const double jerkless = s * s * s * (10 - 15 * s + 6 * s * s);
    Vec3 p = from + jerkless * (to - from);
    p.x() += 4e-4 * std::sin(6.283185307179586 * tremor_x * t + phase_x);
    p.z() += 4e-4 * std::sin(6.283185307179586 * tremor_z * t + phase_z);
    const Vec3 moved = p - start;
    path.push_back(start + Vec3(kPixel * std::round(moved.x() / kPixel), 0, kPixel * std::round(moved.z() / kPixel)));
  }
  return path;
}

}  // namespace carom
