// SPDX-License-Identifier: MIT
#include "bench/charts/chart_scenes.h"

#include <cmath>
#include <random>

namespace carom::charts {
namespace {

Scene bouncingBall() {
  Scene scene = emptyScene(0.8, 0);
  scene.bodies = {fixedPlane("floor", Vec3::UnitZ(), 0), movingBody("ball", Sphere{0.1}, {0, 0, 1.1}, Vec3::Zero())};
  return scene;
}

Scene tumblingBox() {
  Scene scene = emptyScene(0.6, 0);
  Body box = movingBody("box", Box{{0.3, 0.2, 0.12}}, {0, 0, 0.8}, {1, 0.3, -1});
  box.orientation = Quat(0.9, 0.2, -0.3, 0.1).normalized();
  box.angular_velocity = {4, 6, 2};
  scene.bodies = {fixedPlane("floor", Vec3::UnitZ(), 0), box};
  return scene;
}

Scene meetingBoxes() {
  Scene scene = emptyScene(0.6, 0);
  Body a = movingBody("a", Box{{0.3, 0.2, 0.12}}, {-1, 0, 2}, {2, 0.05, 1});
  Body b = movingBody("b", Box{{0.25, 0.3, 0.1}}, {1, 0.05, 2.1}, {-2, 0, 0.9});
  a.orientation = Quat(0.9, 0.2, -0.3, 0.1).normalized();
  b.orientation = Quat(0.5, -0.4, 0.3, 0.6).normalized();
  a.angular_velocity = {3, -2, 5};
  b.angular_velocity = {-4, 3, 2};
  b.mass = 2;
  scene.bodies = {a, b};
  return scene;
}

// Fifteen balls whose gaps of about a millimetre differ, so that no two impacts fall together; seen from above, on a
// table without friction. Cushions all around.
Scene poolBreak() {
  constexpr double kRadius = 0.028575, kPitch = 2 * kRadius + 0.001;
  Scene scene = emptyScene(0.95, 0, Vec3::Zero());
  std::mt19937_64 engine(5);
  const auto jitter = [&] { return 2e-4 * (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5); };
  for (const auto& [name, normal, offset] :
       {std::tuple("left", Vec3(1, 0, 0), -1.27), std::tuple("right", Vec3(-1, 0, 0), -1.27),
        std::tuple("near", Vec3(0, 1, 0), -0.635), std::tuple("far", Vec3(0, -1, 0), -0.635)})
    scene.bodies.push_back(fixedPlane(name, normal, offset));
  scene.bodies.push_back(movingBody("cue", Sphere{kRadius}, {-0.635, 0.01, 0}, {8, 0, 0}));
  for (int row = 0; row < 5; ++row)
    for (int i = 0; i <= row; ++i) {
      const double dx = jitter(), dy = jitter();
      const Vec3 place(0.635 + row * kPitch * std::sqrt(0.75) + dx, (i - 0.5 * row) * kPitch + dy, 0);
      scene.bodies.push_back(
          movingBody("ball " + std::to_string(row) + std::to_string(i), Sphere{kRadius}, place, Vec3::Zero()));
    }
  return scene;
}

}  // namespace

Scene emptyScene(double elasticity, double friction, const Vec3& gravity) {
  Scene scene;
  scene.gravity = gravity;
  scene.materials.push_back({.name = "m", .elasticity = elasticity, .friction = friction});
  return scene;
}

Body movingBody(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity) {
  Body body;
  body.name = name, body.material = "m", body.mass = 1, body.shape = shape;
  body.position = position, body.velocity = velocity;
  return body;
}

Body fixedPlane(const std::string& name, const Vec3& normal, double offset) {
  Body body;
  body.name = name, body.material = "m", body.fixed = true, body.shape = Plane{normal, offset};
  return body;
}

const std::vector<ChartScene>& speedScenes() {
  static const std::vector<ChartScene> scenes = {{"ball", 2, 3, bouncingBall},
                                                 {"box", 0.9, 3, tumblingBox},
                                                 {"two boxes", 1, 3, meetingBoxes},
                                                 {"pool break", 0.3, 30, poolBreak}};
  return scenes;
}

}  // namespace carom::charts
