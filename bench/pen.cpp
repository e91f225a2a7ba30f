// SPDX-License-Identifier: MIT
#include "bench/pen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

namespace carom {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  Vec3 vec(double size) {
    const double x = in(-size, size), y = in(-size, size), z = in(-size, size);
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
};

Body wall(const std::string& name, const Vec3& normal, double offset) {
  Body body;
  body.name = name;
  body.fixed = true;
  body.material = "pen";
  Plane plane;
  plane.normal = normal;
  plane.offset = offset;
  body.shape = plane;
  return body;
}

// Six walls about [0, size]^3.
void addWalls(Scene& scene, double size) {
  scene.bodies.push_back(wall("floor", {0, 0, 1}, 0));
  scene.bodies.push_back(wall("lid", {0, 0, -1}, -size));
  scene.bodies.push_back(wall("left", {1, 0, 0}, 0));
  scene.bodies.push_back(wall("right", {-1, 0, 0}, -size));
  scene.bodies.push_back(wall("front", {0, 1, 0}, 0));
  scene.bodies.push_back(wall("back", {0, -1, 0}, -size));
}

// Calls place(i, middle of a lattice cell) for so many bodies; returns the size of the lattice.
template <class Place>
double fillLattice(int count, double cell, const Place& place) {
  const int side = static_cast<int>(std::ceil(std::cbrt(count) - 1e-9));
  for (int i = 0; i < count; ++i) place(i, cell * Vec3(i % side + 0.5, i / side % side + 0.5, i / (side * side) + 0.5));
  return cell * side;
}

}  // namespace

Scene penOfBalls(int count, std::uint64_t seed) {
  constexpr double kRadius = 0.05;
  Scene scene;
  scene.materials.push_back({.name = "pen", .elasticity = 1, .friction = 0});
  Random random(seed);
  std::vector<Body> balls;
  const double size = fillLattice(count, 3 * kRadius, [&](int i, const Vec3& middle) {
    Body ball;
    ball.name = "ball " + std::to_string(i);
    ball.material = "pen";
    ball.mass = 1;
    ball.shape = Sphere{kRadius};
    ball.position = middle + random.vec(0.4 * kRadius);
    ball.velocity = random.vec(5);
    balls.push_back(ball);
  });
  addWalls(scene, size);
  scene.bodies.insert(scene.bodies.end(), balls.begin(), balls.end());
  return scene;
}

namespace {

// Bodies that tumble in a pen, with friction and elasticity 0.98.
Scene penOfTumbling(int count, double cell, const Shape& shape, std::uint64_t seed) {
  Scene scene;
  scene.materials.push_back({.name = "pen", .elasticity = 0.98, .friction = 0.2});
  Random random(seed);
  std::vector<Body> bodies;
  const double size = fillLattice(count, cell, [&](int i, const Vec3& middle) {
    Body body;
    body.name = "body " + std::to_string(i);
    body.material = "pen";
    body.mass = 1;
    body.shape = shape;
    body.position = middle;
    const Vec3 axis = random.vec(1);
    body.orientation = Quat(random.in(0.2, 1), axis.x(), axis.y(), axis.z()).normalized();
    body.velocity = random.vec(3);
    body.angular_velocity = random.vec(8);
    bodies.push_back(body);
  });
  addWalls(scene, size);
  scene.bodies.insert(scene.bodies.end(), bodies.begin(), bodies.end());
  return scene;
}

// Vertices and triangles of an OBJ file that holds nothing else.
Mesh readMug(const std::string& file) {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vec3& p = vertices.emplace_back();
      words >> p.x() >> p.y() >> p.z();
    } else if (word == "f") {
      std::array<int, 3>& t = triangles.emplace_back();
      for (int& corner : t) words >> corner, --corner;
    }
  }
  Mesh mug;
  mug.surface = meshSurface(vertices, triangles);
  return mug;
}

}  // namespace

Scene penOfBoxes(int count, std::uint64_t seed) { return penOfTumbling(count, 0.4, Box{{0.2, 0.15, 0.1}}, seed); }

Scene penOfMugs(int count, const std::string& mug_file, std::uint64_t seed) {
  return penOfTumbling(count, 0.25, readMug(mug_file), seed);
}

int movingBodies(const Scene& scene) {
  return static_cast<int>(
      std::count_if(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) { return !body.fixed; }));
}

}  // namespace carom
