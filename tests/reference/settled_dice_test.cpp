// SPDX-License-Identifier: MIT
// Dice that are thrown, bounce, are captured corner by corner and come to rest: the place of rest and its gradient by
// every number, against a replay of the same events in 50 digits.

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/reference/die_replay.h"
#include "tests/reference/differences.h"
#include "tests/reference/worst.h"
#include "tests/support/compare.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::reference::dice {
namespace {

using test::expectEntries;
using test::makeBox;
using test::makePlane;
using test::makeScene;
using test::Random;

constexpr double kColumn = 1e-8;
const Real kChange("1e-20");  // 1e-17 is too much to be linear, and the law of several contacts has 32 digits
constexpr double kEdge = 0.016, kSpeed = 0.4;  // m; m/s, of a fall from so high

Scene thrown(std::uint64_t seed) {
  constexpr double size = kEdge;
  Random random(seed);
  const Vec3 velocity = random.vec(1);
  Body die = makeBox("die", Vec3::Constant(size), {0, 0, size * random.in(2, 8)}, velocity);
  die.orientation = random.rotation(), die.angular_velocity = random.vec(0.5) / size;
  const double elasticities[] = {0.2, 0.5, 0.3}, frictions[] = {0.1, 0.4, 1};
  const double e = elasticities[random.below(3)], mu = frictions[random.below(3)];
  return makeScene({0.1, -0.2, -9.81}, e, mu, {die, makePlane("floor", Vec3::UnitZ(), 0)});
}

struct Number {
  std::string name;
  std::function<void(DieNumbers&, const Real&)> nudge;
  std::function<double(const SceneGradient&)> entry;
};

std::vector<Number> numbers() {
  std::vector<Number> all;
  for (int c = 0; c < 3; ++c) {
    const std::string at = "." + std::string(1, "xyz"[c]);
    all.push_back({"gravity" + at, [=](DieNumbers& n, const Real& h) { n.gravity[c] += h; }, [=](const auto& g) { return g.gravity[c]; }});
    all.push_back({"position" + at, [=](DieNumbers& n, const Real& h) { n.x[c] += h; }, [=](const auto& g) { return g.bodies[0].position[c]; }});
    all.push_back({"velocity" + at, [=](DieNumbers& n, const Real& h) { n.v[c] += h; }, [=](const auto& g) { return g.bodies[0].velocity[c]; }});
    all.push_back({"spin" + at, [=](DieNumbers& n, const Real& h) { n.spin[c] += h; }, [=](const auto& g) { return g.bodies[0].angular_velocity[c]; }});
    all.push_back({"orientation" + at, [=](DieNumbers& n, const Real& h) { n.R = rotationBy(axisVector(c, h)) * n.R; },
                   [=](const auto& g) { return g.bodies[0].orientation[c]; }});
    all.push_back({"size" + at, [=](DieNumbers& n, const Real& h) { n.size[c] += h; }, [=](const auto& g) { return g.bodies[0].size[c]; }});
    all.push_back({"floor's position" + at, [=](DieNumbers& n, const Real& h) { n.floor[c] += h; }, [=](const auto& g) { return g.bodies[1].position[c]; }});
    all.push_back({"floor's orientation" + at, [=](DieNumbers& n, const Real& h) { n.floor_R = rotationBy(axisVector(c, h)) * n.floor_R; },
                   [=](const auto& g) { return g.bodies[1].orientation[c]; }});
  }
  all.push_back({"elasticity", [](DieNumbers& n, const Real& h) { n.elasticity += h; }, [](const auto& g) { return g.materials[0].elasticity; }});
  all.push_back({"friction", [](DieNumbers& n, const Real& h) { n.friction += h; }, [](const auto& g) { return g.materials[0].friction; }});
  all.push_back({"mass", [](DieNumbers& n, const Real& h) { n.mass += h; }, [](const auto& g) { return g.bodies[0].mass; }});
  return all;
}

// The worst errors of a die: of its arcs, of the gradient of its place as a share of its own column, and of the whole one,
// in which the states before all events stand, too.
struct Errors {
  double place = 0, velocity = 0, own = 0, gradient = 0;
};

// In units of the die's edge and of the speed that it gets by falling as far.
Eigen::Matrix<double, 12, 1> rate(const ConstrainedState& from, const ConstrainedState& to) {
  Eigen::Matrix<double, 12, 1> d;
  const Real over = 1 / kChange;
  d << (over / kEdge * (to.x - from.x)).rounded(), (over * rotationBetween(from.R, to.R)).rounded(),
      (over / kSpeed * (to.v - from.v)).rounded(), (over * kEdge / kSpeed * (to.spin - from.spin)).rounded();
  return d;
}

struct Unsettled : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws that the replay does not know are left out; of the first ones, which it follows, none may come to be among them, nor
// may that in which a corner lifts as another turns round at 1e-7 of the unit of speed.
constexpr int kKnownThrows = 3, kTurnsRound = 5;

Errors compared(std::uint64_t seed, std::size_t stride) {
  const Scene scene = thrown(seed);
  OdeContacts contacts(scene);
  // of 1e-12 S, as is taken where nothing is said, this die has two bounces more, at 1e-6 m/s, where what is left of slips is
  // stopped at the start of a path and the law does not know (docs/progress.md)
  SimulateOptions options;
  if (seed == kTurnsRound) options.lowest_bounce = 1e-12;
  const Motion m = simulate(scene, contacts, 10, options);
  if (m.status != MotionStatus::complete) throw Unsettled(m.message);
  const DieNumbers known(scene);
  const DieReplay replay(known, m);
  Errors worst;
  worst.place = static_cast<double>(replay.worst_position), worst.velocity = static_cast<double>(replay.worst_velocity);
  DerivativeTape tape(m);
  std::vector<SceneGradient> rows;
  for (int i = 0; i < 6; ++i) {
    const StateSeed seed_i = test::seedOf(0, Instant::at(m.end), i);
    rows.push_back(adjoint(tape, std::span(&seed_i, 1)));
  }
  const std::vector<Number> all = numbers();
  for (std::size_t k = seed % stride; k < all.size(); k += stride) {
    DieNumbers nudged = known;
    all[k].nudge(nudged, kChange);
    const DieReplay there(nudged, m, &replay);
    const Eigen::Matrix<double, 6, 1> expected = rate(replay.end, there.end).head<6>();
    Eigen::Matrix<double, 6, 1> found;
    for (int i = 0; i < 6; ++i) found[i] = all[k].entry(rows[static_cast<std::size_t>(i)]) / (i < 3 ? kEdge : 1);
    double whole = expected.norm();
    for (std::size_t e = 0; e < replay.when.size(); ++e) {
      whole = std::max(whole, rate(replay.before[e], there.before[e]).norm());
      whole = std::max(whole, kSpeed / kEdge * std::abs(static_cast<double>((there.when[e] - replay.when[e]) / kChange)));
    }
    const double error = (found - expected).cwiseAbs().maxCoeff();
    keepWorst(worst.own, error / std::max(1.0, expected.norm()));
    keepWorst(worst.gradient, error / std::max(1.0, whole));
    if (!(error <= kColumn * std::max(1.0, whole)))
      std::printf("seed %llu, %s: error %.2g, column %.3g, %.3g along the way\n", static_cast<unsigned long long>(seed), all[k].name.c_str(), error, expected.norm(), whole);
  }
  return worst;
}

void notCompared(int seed, const char* why) {
  if (seed <= kKnownThrows || seed == kTurnsRound) FAIL() << why;
  GTEST_SKIP() << why;
}

class SettledDice : public ::testing::TestWithParam<int> {};

TEST_P(SettledDice, GradientsOfTheirPlaces) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  SCOPED_TRACE("seed " + std::to_string(seed));
  try {
    const Errors errors = compared(seed, test::testScale() < 1.5 ? 5 : 1);
    std::printf("seed %d: arcs %.2g m, %.2g m/s; gradient %.2g of its own column, %.2g of the whole\n", GetParam(), errors.place, errors.velocity, errors.own, errors.gradient);
    EXPECT_TRUE(errors.place <= 1e-14 && errors.velocity <= 1e-12);
    EXPECT_TRUE(errors.own <= kColumn);
  } catch (const UnknownTransition& error) {
    notCompared(GetParam(), error.what());
  } catch (const Unsettled& error) {
    notCompared(GetParam(), error.what());
  } catch (const SlipsTogether& error) {
    notCompared(GetParam(), error.what());
  }
}

INSTANTIATE_TEST_SUITE_P(SlowTurn, SettledDice, ::testing::Values(kTurnsRound));
INSTANTIATE_TEST_SUITE_P(Seeds, SettledDice, ::testing::Range(1, 1 + test::scaled(kKnownThrows)));

}  // namespace
}  // namespace carom::reference::dice
