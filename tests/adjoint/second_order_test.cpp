// SPDX-License-Identifier: MIT
// Second derivatives without a reference: their matrix over scene numbers and reading times is symmetric (but for
// turns, which do not commute), the gradient found on the way is the gradient, and closed forms hold.

#include "adjoint/second_order/second_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/seed.hpp"
#include "tests/support/compare.h"
#include "tests/support/dot_product_scenes.h"
#include "tests/support/transposed.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

constexpr double kSymmetry = 1e-11;  ///< of the sums of absolute products
constexpr double kSame = 1e-13;      ///< of the largest entry

ReadingDirection randomReadingDirection(const Scene& scene, std::size_t seeds, Random& random) {
  return {randomDirection(scene, random), random.vector(static_cast<Eigen::Index>(seeds))};
}

// What is read at an event moves with it, not by itself.
void holdTimesOfEvents(const std::vector<StateSeed>& seeds, std::vector<ReadingDirection>& directions) {
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (ReadingDirection& d : directions)
      if (seeds[i].at.event >= 0 && d.time.size() > 0) d.time[static_cast<Eigen::Index>(i)] = 0;
}

double product(const SecondOrder& second, std::size_t along, const ReadingDirection& by) {
  return second.gradient_rates[along].dot(by.scene) + second.time_rates[along].dot(by.time);
}
double absoluteProduct(const SecondOrder& second, std::size_t along, const ReadingDirection& by) {
  return flatten(second.gradient_rates[along]).cwiseAbs().dot(flatten(by.scene).cwiseAbs()) +
         second.time_rates[along].cwiseAbs().dot(by.time.cwiseAbs());
}

// df.(b x a) of the turns of all bodies at the start: left factors do not commute.
double turnsOfStarts(const SceneGradient& gradient, const SceneTangent& a, const SceneTangent& b) {
  double sum = 0;
  for (std::size_t i = 0; i < gradient.bodies.size(); ++i)
    sum += gradient.bodies[i].orientation.dot(b.bodies[i].orientation.cross(a.bodies[i].orientation));
  return sum;
}

// How the body that seed `i` reads turns along a direction, its reading time with it.
Vec3 turnOf(const Motion& motion, const MotionTangent& along, const ReadingDirection& direction, const StateSeed& seed,
            std::size_t i) {
  const Vec3 turn = along.at(seed.body, seed.at).orientation;
  if (seed.at.event >= 0) return turn;
  const BodyState state = motion.stateAt(seed.body, seed.at.time);
  return turn + direction.time[static_cast<Eigen::Index>(i)] * state.angular_velocity;
}

// The weight w of a turn is no gradient of a function of orientations: with D_a R = [a] R, D_a D_b R = D_b D_a R gives
// D_a b - D_b a = a x b, and so w.(a x b).
double turnsOfReadings(DerivativeTape& tape, std::span<const StateSeed> seeds, const ReadingDirection& a,
                       const ReadingDirection& b) {
  const MotionTangent along_a = tangent(tape, a.scene), along_b = tangent(tape, b.scene);
  double sum = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    sum += seeds[i].orientation.dot(
        turnOf(tape.motion(), along_a, a, seeds[i], i).cross(turnOf(tape.motion(), along_b, b, seeds[i], i)));
  return sum;
}

void expectSymmetric(const Motion& motion, std::uint64_t number) {
  Random random(number);
  std::vector<StateSeed> seeds;
  for (int b : movingBodies(*motion.scene)) {
    seeds.push_back(randomSeed(b, Instant::at(random.in(0.3, 0.9) * motion.end), random));
    seeds.push_back(randomSeed(b, Instant::at(0.97 * motion.end), random));
    for (int n = 1; n <= 2; ++n)
      if (const auto e = motion.findImpact(b, n)) seeds.push_back(randomSeed(b, Instant::before(*e), random));
    seeds.push_back(randomSeedOfScene(*motion.scene, b, Instant::at(0.4 * motion.end), random));
    if (const auto e = motion.findImpact(b, 1))
      seeds.push_back(randomSeedOfScene(*motion.scene, b, Instant::after(*e), random));
    // read at the time of an event that it may have no part in
    seeds.push_back(randomSeed(b, Instant::before(static_cast<int>(motion.events.size()) - 1), random));
  }
  // where nobody asks for orientations they are not carried along, and a turn is not that of the body
  for (StateSeed& seed : seeds)
    if (motion.plan.bodies[static_cast<std::size_t>(seed.body)].derivative_tier == Tier::none)
      seed.orientation.setZero();
  std::vector<ReadingDirection> directions;
  for (int i = 0; i < 6; ++i) directions.push_back(randomReadingDirection(*motion.scene, seeds.size(), random));
  holdTimesOfEvents(seeds, directions);
  DerivativeTape tape(motion);
  const SecondOrder second = secondOrder(tape, seeds, {}, directions);
  const SceneGradient gradient = adjoint(tape, seeds);
  const Eigen::VectorXd plain = flatten(gradient), dual = flatten(second.gradient);
  for (Eigen::Index i = 0; i < plain.size(); ++i)
    EXPECT_TRUE(std::abs(plain[i] - dual[i]) <= kSame * plain.cwiseAbs().maxCoeff())
        << "entry " << i << ": " << dual[i] << ", by the reverse pass " << plain[i];
  for (std::size_t a = 0; a < directions.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double ab = product(second, a, directions[b]), ba = product(second, b, directions[a]);
      const double size = absoluteProduct(second, a, directions[b]) + absoluteProduct(second, b, directions[a]);
      const double turns = turnsOfStarts(gradient, directions[a].scene, directions[b].scene) +
                           turnsOfReadings(tape, seeds, directions[a], directions[b]);
      EXPECT_TRUE(std::abs(ab - ba - turns) <= kSymmetry * size)
          << "directions " << a << " and " << b << ": " << ab << " and " << ba << ", of them " << turns
          << " by turns, error " << std::abs(ab - ba - turns) / size;
    }
}

class SecondOrderSymmetry : public ::testing::TestWithParam<DotProductScene> {};

TEST_P(SecondOrderSymmetry, ForEveryLawTierAndFeature) {
  const Motion m = motionOf(GetParam());
  ASSERT_FALSE(m.events.empty());
  if (!hasSecondOrder(m)) {
    DerivativeTape tape(m);
    EXPECT_THROW(secondOrder(tape, {}, {}, {}), NotComputable);
    return;
  }
  const std::string before = m.signature();
  const double time = m.events.back().time;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectSymmetric(m, seed);
  }
  EXPECT_EQ(m.signature(), before);
  EXPECT_EQ(m.events.back().time, time);
}

INSTANTIATE_TEST_SUITE_P(Rows, SecondOrderSymmetry, ::testing::ValuesIn(dotProductScenes()),
                         [](const auto& row) { return std::string(row.param.name); });

// Directions of which each changes one number or one body, surface, tilt or time, and the rest nothing.
std::vector<ReadingDirection> sparseDirections(const Scene& scene, Eigen::Index seeds, Random& random) {
  const SceneTangent full = randomDirection(scene, random);
  std::vector<ReadingDirection> out;
  const auto add = [&]() -> SceneTangent& { return out.emplace_back(ReadingDirection{SceneTangent(scene), {}}).scene; };
  add().gravity = full.gravity;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) add().materials[m] = full.materials[m];
  for (std::size_t t = 0; t < scene.tilts.size(); ++t) add().tilts[t] = full.tilts[t];
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyDerivative& d = full.bodies[b];
    add().bodies[b].position = d.position;
    add().bodies[b].orientation = d.orientation;
    add().bodies[b].velocity = d.velocity;
    add().bodies[b].angular_velocity = d.angular_velocity;
    add().bodies[b].mass = d.mass;
    add().bodies[b].density = d.density;
    add().bodies[b].inertia = d.inertia;
    add().bodies[b].size = d.size;
  }
  // in a flat scene no impact comes earlier or later by these
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) add().bodies[b].position.z() = 1;
  for (Eigen::Index s = 0; s < seeds; ++s)
    out.push_back({SceneTangent(scene), random.in(0.5, 1) * Eigen::VectorXd::Unit(seeds, s)});
  return out;
}

// A direction's part does not depend on the others that are asked for at the same time, nor on what of the motion they
// leave as it is, which later directions leave out.
void expectApart(const Motion& m) {
  const Scene& scene = *m.scene;
  Random random(1);
  std::vector<StateSeed> seeds;
  for (int b : movingBodies(scene)) {
    seeds.push_back(randomSeed(b, Instant::at(0.5 * m.end), random));
    seeds.push_back(randomSeed(b, Instant::at(m.end), random));
    seeds.push_back(randomSeed(b, Instant::before(static_cast<int>(m.events.size()) - 1), random));
  }
  const auto count = static_cast<Eigen::Index>(seeds.size());
  std::vector<ReadingDirection> directions = sparseDirections(scene, count, random);
  directions.insert(directions.begin(), randomReadingDirection(scene, seeds.size(), random));
  holdTimesOfEvents(seeds, directions);
  DerivativeTape tape(m);
  const SecondOrder all = secondOrder(tape, seeds, {}, directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const SecondOrder one = secondOrder(tape, seeds, {}, std::span(&directions[i], 1));
    const Eigen::VectorXd apart = flatten(one.gradient_rates[0]), together = flatten(all.gradient_rates[i]);
    const std::string what = "direction " + std::to_string(i);
    const auto largest = [](const Eigen::VectorXd& v) { return std::max(v.cwiseAbs().maxCoeff(), 1e-300); };
    expectEntries(together, apart, kSame, what, largest(apart));
    expectEntries(all.time_rates[i], one.time_rates[0], kSame, what, largest(one.time_rates[0]));
  }
}

TEST_P(SecondOrderSymmetry, DirectionsAreApart) {
  const Motion m = motionOf(GetParam());
  if (hasSecondOrder(m)) expectApart(m);
}

// Balls that meet on a table one after the other, so that most directions come to some of them late or never.
TEST(SecondOrder, DirectionsAreApartInALongChain) {
  std::vector<Body> balls;
  for (int i = 0; i < 6; ++i) {
    balls.push_back(makeBall("ball " + std::to_string(i), 0.05, {0.3 * i, 0.01 * (i % 3), 0}));
    balls.push_back(makeBall("other " + std::to_string(i), 0.05, {0.3 * i, 1, 0}));
  }
  balls[0].velocity = {3, 0, 0};
  const Motion m = play(makeScene({0, 0, 0}, 0.9, 0.1, balls), 1);
  ASSERT_GE(m.events.size(), 4u);
  expectApart(m);
}

// y(T) = v1 (T - t1) - g (T - t1)^2/2 with t1 = sqrt(2 y0/g), v1 = e g t1.
TEST(SecondOrder, PointBall) {
  const double y0 = 5, e = 0.8, g = 9.8, T = 2.5;
  Scene scene =
      makeScene({0, -g, 0}, e, 0, {makeBall("ball", 0.1, {0, y0 + 0.1, 0}), makePlane("floor", Vec3::UnitY(), 0)});
  const Motion m = play(scene, T);
  ASSERT_EQ(m.events.size(), 1u);
  const std::vector<StateSeed> seeds{seedOf(0, Instant::at(T), 1)};
  std::vector<ReadingDirection> directions(3, {SceneTangent(scene), {}});
  directions[0].scene.materials[0].elasticity = 1;
  directions[1].scene.bodies[0].position.y() = 1;
  directions[2].time = Eigen::VectorXd::Ones(1);
  DerivativeTape tape(m);
  const SecondOrder s = secondOrder(tape, seeds, {}, directions);
  const double t1 = std::sqrt(2 * y0 / g), dt = 1 / (g * t1), ddt = -1 / (g * g * t1 * t1 * t1), after = T - t1;
  // y = e g t1 after - g after^2/2, by t1: e g (after - t1) + g after; twice: -2 e g - g
  const double by_t1 = e * g * (after - t1) + g * after, by_t1_twice = -2 * e * g - g;
  expectEntries(s.gradient.bodies[0].position.y(), by_t1 * dt, 1e-12, "dy/dy0");
  expectEntries(s.gradient_rates[0].materials[0].elasticity, 0.0, 1e-12, "d2y/de2");
  expectEntries(s.gradient_rates[0].bodies[0].position.y(), g * (after - t1) * dt, 1e-12, "d2y/de dy0");
  expectEntries(s.gradient_rates[1].materials[0].elasticity, g * (after - t1) * dt, 1e-12, "d2y/dy0 de");
  expectEntries(s.gradient_rates[1].bodies[0].position.y(), by_t1_twice * dt * dt + by_t1 * ddt, 1e-12, "d2y/dy0^2");
  expectEntries(s.time_rates[2][0], -g, 1e-12, "d2y/dT2");
  expectEntries(s.time_rates[0][0], g * t1, 1e-12, "d2y/dT de");
  expectEntries(s.gradient_rates[2].materials[0].elasticity, g * t1, 1e-12, "d2y/de dT");
  expectEntries(timeDerivative(m, seeds[0]), e * g * t1 - g * after, 1e-12, "dy/dT");
}

// n impacts of a dropped ball, y(T) = e^n g t1 s - g s^2/2 with s = T - t1 (1 + 2 sum of e^k), k < n.
TEST(SecondOrder, ManyBounces) {
  const double y0 = 50, e = 0.8, g = 9.8, T = 15;
  Scene scene =
      makeScene({0, -g, 0}, e, 0, {makeBall("ball", 0.1, {0, y0 + 0.1, 0}), makePlane("floor", Vec3::UnitY(), 0)});
  const Motion m = play(scene, T);
  const int n = static_cast<int>(m.events.size());
  double t = 1, dt = 0, ddt = 0;
  for (int k = 1; k < n; ++k)
    t += 2 * std::pow(e, k), dt += 2 * k * std::pow(e, k - 1), ddt += 2 * k * (k - 1) * std::pow(e, k - 2);
  const double t1 = std::sqrt(2 * y0 / g), s = T - t1 * t, ds = -t1 * dt, dds = -t1 * ddt;
  const double v = g * t1 * std::pow(e, n), dv = n * v / e, ddv = n * (n - 1) * v / (e * e);
  const std::vector<StateSeed> seeds{seedOf(0, Instant::at(T), 1)};
  ReadingDirection by_e{SceneTangent(scene), {}};
  by_e.scene.materials[0].elasticity = 1;
  DerivativeTape tape(m);
  const SecondOrder found = secondOrder(tape, seeds, {}, std::span(&by_e, 1));
  const double first = dv * s + v * ds - g * s * ds, second = ddv * s + 2 * dv * ds + v * dds - g * (ds * ds + s * dds);
  expectEntries(found.gradient.materials[0].elasticity / first, 1.0, 1e-12, "dy/de");
  expectEntries(found.gradient_rates[0].materials[0].elasticity / second, 1.0, 1e-11, "d2y/de2");
}

}  // namespace
}  // namespace carom
