// SPDX-License-Identifier: MIT
// A chunk of worlds is a function of the scene and of its place alone.
#include "explore/worlds/exploration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "explore/explore.h"
#include "explore/numbers/fnv.hpp"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/explore/throws.h"
#include "tests/support/scaled.h"

namespace carom {
namespace {

using namespace explore_test;

TEST(Exploration, AnySplitGivesTheSameBits) {
  const auto count = static_cast<std::uint64_t>(test::scaled(1600));
  for (const Throw& t : {bouncingBall(), tumblingBox()}) {
    for (const Points points : {Points::random, Points::sobol}) {
      const ExploreOptions options{.points = points, .seed = 3, .gradients = true};
      const WorldTable whole = exploring(t, options).chunk(0, count);
      ASSERT_EQ(whole.size(), count);
      for (const std::uint64_t size : {std::uint64_t{7}, std::uint64_t{777}, count}) {
        WorldTable split = exploring(t, options).chunk(0, 0);
        for (std::uint64_t first = 0; first < count; first += size)
          split.append(exploring(t, options).chunk(first, std::min(size, count - first)));
        EXPECT_TRUE(split == whole) << size;
      }
      const Exploration one = exploring(t, options);
      WorldTable single = one.chunk(0, 0);
      for (std::uint64_t world = 0; world < 100; ++world) single.append(one.chunk(world, 1));
      EXPECT_TRUE(single == one.chunk(0, 100));
      for (const int threads : {1, 2, 5})
        EXPECT_TRUE(explore(one, count, {.threads = threads, .chunk = 64}) == whole) << threads;
    }
  }
}

TEST(Exploration, SeedsAndPointsGiveOtherWorlds) {
  const Throw t = bouncingBall();
  std::vector<std::vector<double>> seen;
  for (const Points points : {Points::random, Points::sobol})
    for (const std::uint64_t seed : {0, 1, 2})
      seen.push_back(exploring(t, {.points = points, .seed = seed}).chunk(0, 3).drawn);
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(seen[i], seen[j]);
}

// The scene of a world, written out and read back, has the row.
TEST(Exploration, ARowIsThatOfTheWrittenScene) {
  for (const Throw& t : {bouncingBall(), tumblingBox(), droppedDie()}) {
    const Exploration exploration = exploring(t);
    const WorldTable table = exploration.chunk(0, 40);
    for (std::size_t k = 0; k < table.size(); ++k) {
      Document document;
      document.scene = exploration.sceneAt(k), document.duration = t.duration;
      document = parseDocument(writeDocument(document), "written");
      OdeContacts contacts(document.scene);
      const Motion motion = simulate(document.scene, contacts, t.duration);
      EXPECT_EQ(table.signature[k], explore_detail::fnv(motion.signature())) << k;
      EXPECT_EQ(table.status[k] & world_status::kMotion, static_cast<int>(motion.status));
      EXPECT_EQ(table.impacts[k], motion.impacts);
      EXPECT_EQ(table.end[k], motion.end);
      if (table.rows == 3) {  // the ball
        EXPECT_EQ(table.values[3 * k], motion.stateAt("ball", 1.2).position.x());
        EXPECT_EQ(table.values[3 * k + 1], motion.stateAt("ball", 1.2).velocity.x());
        if (const std::optional<int> second = motion.findImpact(1, 2); second)
          EXPECT_EQ(table.values[3 * k + 2], motion.events[static_cast<std::size_t>(*second)].time);
        else
          EXPECT_TRUE(std::isnan(table.values[3 * k + 2]) && (table.status[k] & world_status::kMissingRow));
      }
    }
  }
}

TEST(Exploration, BodiesInReverseOrderGiveTheSameRows) {
  for (const Throw& t : {bouncingBall(), tumblingBox()}) {
    Throw reversed = t;
    std::reverse(reversed.scene.bodies.begin(), reversed.scene.bodies.end());
    const WorldTable a = exploring(t).chunk(0, 200), b = exploring(reversed).chunk(0, 200);
    EXPECT_EQ(a.drawn, b.drawn);
    for (std::size_t i = 0; i < a.values.size(); ++i)
      EXPECT_TRUE(std::abs(a.values[i] - b.values[i]) <= 1e-9 * (1 + std::abs(a.values[i])) ||
                  (std::isnan(a.values[i]) && std::isnan(b.values[i])))
          << i << " " << a.values[i] << " " << b.values[i];
    EXPECT_EQ(a.impacts, b.impacts);
    EXPECT_EQ(a.face, b.face);
  }
}

TEST(Exploration, GradientsAreThoseOfTheEdit) {
  Throw t = bouncingBall();
  const Exploration exploration = exploring(t, {.gradients = true});
  const WorldTable table = exploration.chunk(0, 30);
  t.controls.pop_back();  // the mass, which is not drawn
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (table.status[k] != 0) continue;
    OdeContacts contacts(t.scene);
    Edit edit(t.scene, contacts, t.duration, t.controls, t.constraints);
    const NlpEvaluator evaluator = edit.evaluator();
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(table.drawn.data() + k * table.numbers,
                                                                static_cast<Eigen::Index>(table.numbers));
    const Eigen::MatrixXd J = evaluator.at(x).jacobian().entries;
    ASSERT_EQ(J.rows(), 3);
    for (int i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < J.cols(); ++j) {
        const double found =
            table.jacobian[(k * 3 + static_cast<std::size_t>(i)) * table.numbers + static_cast<std::size_t>(j)];
        EXPECT_TRUE(std::abs(found - J(i, j)) <= 1e-12 * (1 + std::abs(J(i, j)))) << k << " " << i << " " << j;
      }
  }
  EXPECT_EQ(exploration.numbers()[7].name, "friction of 'm'");
  ASSERT_EQ(exploration.numbers().size(), 8u);
}

// A row that is read when it suits best has no derivative here, and says so.
TEST(Exploration, RowsAtFreeTimesHaveNoDerivative) {
  Throw t = bouncingBall();
  t.constraints = {{"ball", between(0.2, 0.4), {{"position", {0.5, any, any}}}},
                   {"ball", 0.3, {{"position", {any, any, 1.0}}}}};
  const WorldTable table = exploring(t, {.gradients = true}).chunk(0, 20);
  for (std::size_t k = 0; k < table.size(); ++k) {
    EXPECT_TRUE(table.status[k] & world_status::kNoDerivative);
    for (std::size_t j = 0; j < table.numbers; ++j) {
      EXPECT_TRUE(std::isnan(table.jacobian[2 * k * table.numbers + j]));
      EXPECT_TRUE(std::isfinite(table.jacobian[(2 * k + 1) * table.numbers + j]));
    }
  }
}

// Moments of inertia that no body has; and every world fails.
TEST(Exploration, AFailedWorldIsARow) {
  Throw t = tumblingBox();
  t.scene.bodies[1].mass = 1, t.scene.bodies[1].inertia = Inertia::fromMoments({0.01, 0.01, 0.01});
  t.controls = {drawn(inertia("box"), LogNormalDistribution{{}, {1}})};
  const WorldTable some = exploring(t, {.gradients = true}).chunk(0, 200);
  int failed = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    const double* I = some.drawn.data() + 3 * k;
    const bool valid = I[0] <= I[1] + I[2] && I[1] <= I[2] + I[0] && I[2] <= I[0] + I[1];
    EXPECT_EQ(some.status[k] == world_status::kInvalidScene, !valid) << k;
    EXPECT_EQ(std::isnan(some.values[2 * k]), !valid);
    EXPECT_EQ(some.signature[k] == 0, !valid);
    failed += !valid;
  }
  EXPECT_TRUE(failed > 20 && failed < 190);
  t.controls = {drawn(inertia("box"), UniformDistribution{{0.01, 0.01, 10}, {0.02, 0.02, 20}})};
  const WorldTable all = explore(exploring(t), 50);
  for (const std::uint8_t status : all.status) EXPECT_EQ(status, world_status::kInvalidScene);
  EXPECT_STREQ(nameOfWorldStatus(all.status[0]), "invalid_scene");
  EXPECT_THROW(exploring(t).sceneAt(0), InputError);
}

TEST(Exploration, RefusesWorldsThatThereAreNot) {
  const Exploration random = exploring(bouncingBall()), sobol = exploring(bouncingBall(), {.points = Points::sobol});
  EXPECT_EQ(sobol.chunk((std::uint64_t{1} << 32) - 2, 1).size(), 1u);
  EXPECT_THROW(sobol.chunk((std::uint64_t{1} << 32) - 2, 2), InputError);
  EXPECT_THROW(random.chunk(std::uint64_t{1} << 63, 1), InputError);
  EXPECT_THROW(random.chunk(2, ~std::uint64_t{0}), InputError);
  EXPECT_THROW(explore(random, 0), InputError);
  EXPECT_THROW(explore(random, 1, {.threads = -1}), InputError);
}

}  // namespace
}  // namespace carom
