// SPDX-License-Identifier: MIT
// Makes the scene of many balls in a pen.
//   make_pen 500 examples/scenes/pen_500.json
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>
#include <string>

#include "formats/documents/scene_json.h"

namespace {

using namespace carom;

constexpr double kCell = 0.15;  // m, a ball each at the start
constexpr int kAcross = 8;      // cells along a side of the pen

// Numbers of few digits, the same on every machine.
class Random {
 public:
  double in(double low, double high) {
    const double x = low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    return std::round(1000 * x) / 1000;
  }
  Vec3 vec(double size) {
    const double x = in(-size, size), y = in(-size, size), z = in(-size, size);
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_{2026};
};

Body wall(const std::string& name, const Vec3& size, const Vec3& position) {
  Body body;
  body.name = name;
  body.fixed = true;
  body.material = "wood";
  body.shape = Box{size};
  body.position = position;
  return body;
}

Document pen(int count) {
  Document document;
  document.name = std::to_string(count) + " balls in a pen";
  document.schema = "formats/documents/scene.schema.json";  // from the repository's folder, where this is run
  document.duration = 1;
  Scene& scene = document.scene;
  scene.materials.push_back({.name = "rubber", .elasticity = 0.98, .friction = 0.05});
  scene.materials.push_back({.name = "wood", .elasticity = 0.98, .friction = 0.05});
  Body floor;
  floor.name = "floor";
  floor.fixed = true;
  floor.material = "wood";
  floor.shape = Plane{};
  const double inside = kCell * kAcross, thick = 0.04, height = 1.5, middle = 0.5 * (inside + thick);
  scene.bodies = {floor, wall("left", {thick, inside + 2 * thick, height}, {-middle, 0, 0.5 * height}),
                  wall("right", {thick, inside + 2 * thick, height}, {middle, 0, 0.5 * height}),
                  wall("front", {inside, thick, height}, {0, -middle, 0.5 * height}),
                  wall("back", {inside, thick, height}, {0, middle, 0.5 * height})};
  Random random;
  constexpr std::array kRadii{0.03, 0.04, 0.05};
  for (int i = 0; i < count; ++i) {
    const Vec3 cell(i % kAcross, i / kAcross % kAcross, i / (kAcross * kAcross));
    Body ball;
    ball.name = "ball " + std::to_string(i + 1);
    ball.material = "rubber";
    ball.density = 1100;
    ball.shape = Sphere{kRadii[static_cast<std::size_t>(i) % kRadii.size()]};
    ball.position = kCell * (cell + Vec3(0.5 - 0.5 * kAcross, 0.5 - 0.5 * kAcross, 0.5)) + random.vec(0.02);
    ball.position = (1000 * ball.position).array().round() / 1000;
    ball.velocity = random.vec(1.5);
    scene.bodies.push_back(ball);
  }
  if (count > 0) {  // something to direct: the last ball, after it has met the wall
    const std::string last = "ball " + std::to_string(count);
    document.controls = {velocity(last)};
    document.constraints = {{last, 0.22, {{"position", {0.18, 0.47, any}}}}};
  }
  return document;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: make_pen BALLS FILE\n";
    return 2;
  }
  try {
    saveDocument(words[2], pen(std::atoi(words[1])));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
