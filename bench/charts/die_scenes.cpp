// SPDX-License-Identifier: MIT
#include "bench/charts/die_scenes.h"

#include <random>

#include "bench/charts/chart_scenes.h"

namespace carom::charts {
namespace {

constexpr double kEdge = 0.016;

// The same numbers everywhere.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  Vec3 vec(double most) {
    const double x = in(-most, most), y = in(-most, most);
    return {x, y, in(-most, most)};
  }
  Quat rotation() {
    for (;;) {
      const Vec3 v = vec(1);
      const double w = in(-1, 1), square = v.squaredNorm() + w * w;
      if (square > 0.01 && square < 1) return Quat(w, v.x(), v.y(), v.z()).normalized();
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

Scene thrownDie(std::uint64_t seed, double elasticity, double friction) {
  Numbers numbers(seed);
  Scene scene = emptyScene(elasticity, friction);
  const Vec3 velocity = numbers.vec(1);
  Body die = movingBody("die", Box{Vec3::Constant(kEdge)}, {0, 0, kEdge * numbers.in(2, 8)}, velocity);
  die.orientation = numbers.rotation();
  die.angular_velocity = numbers.vec(0.5) / kEdge;
  scene.bodies = {die, fixedPlane("floor", Vec3::UnitZ(), 0)};
  return scene;
}

Scene anyDie(std::uint64_t seed) {
  const double elasticities[] = {0, 0.2, 0.5, 0.85}, frictions[] = {0.1, 0.4, 1};
  return thrownDie(seed, elasticities[seed % 4], frictions[seed / 4 % 3]);
}

}  // namespace carom::charts
