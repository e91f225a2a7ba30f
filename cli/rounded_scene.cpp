// SPDX-License-Identifier: MIT
#include "cli/rounded_scene.h"

#include <cmath>
#include <limits>
#include <random>

#include "adjoint/numeric/so3.hpp"

namespace carom::cli {

using namespace adjoint_detail;

namespace {

constexpr double kFewRoundings = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

Scene rounded(Scene scene, unsigned draw) {
  std::mt19937 engine(draw);
  const auto change = [&](double& x) { x *= 1 + kFewRoundings * (std::ldexp(engine(), -31) - 1); };
  const auto changeAll = [&](Vec3& v) {
    for (double& x : v) change(x);
  };
  changeAll(scene.gravity);
  for (Material& m : scene.materials) change(m.friction), change(m.tangential_elasticity);
  for (Body& b : scene.bodies) {
    changeAll(b.position), changeAll(b.velocity), changeAll(b.angular_velocity);
    changeAll(b.surface_velocity), changeAll(b.surface_angular_velocity);
    if (b.mass) change(*b.mass);
    if (b.density) change(*b.density);
    if (draw % 3 != 0) continue;
    Vec3 turn = Vec3::Constant(0.5);
    changeAll(turn);
    b.orientation = (expSO3(turn - Vec3::Constant(0.5)) * b.orientation).normalized();
  }
  return scene;
}

}  // namespace carom::cli
