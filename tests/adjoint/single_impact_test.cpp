// SPDX-License-Identifier: MIT
// Impacts of one contact have a reverse pass in fixed sizes: it is the transpose of the tangent, which goes the common way,
// and equals the common reverse pass, whichever way the bodies are ordered.

#include <gtest/gtest.h>

#include <algorithm>

#include "adjoint/derivative/event_linearization.hpp"
#include "adjoint/derivative/single_impact.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

constexpr int kScenes = 40;

double largest(const std::vector<Eigen::VectorXd>& all) {
  double most = 1;
  for (const Eigen::VectorXd& v : all)
    if (v.size() > 0) most = std::max(most, v.cwiseAbs().maxCoeff());
  return most;
}

// What a reverse pass gives, as one list of numbers.
std::vector<Eigen::VectorXd> numbersOf(const SceneGradient& scene, const std::vector<BodyModelDerivative>& models,
                                       const StateDerivative* before, std::size_t count) {
  std::vector<Eigen::VectorXd> all = {flatten(scene)};
  for (const BodyModelDerivative& m : models) {
    Eigen::VectorXd v(10);
    v << m.mass, m.inertia, m.products, m.center;
    all.push_back(v);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::VectorXd v(12);
    v << before[i].x, before[i].theta, before[i].v, before[i].L;
    all.push_back(v);
  }
  return all;
}

// How many impacts of one contact there were.
int checkImpacts(const Scene& s, std::uint64_t seed) {
  const Motion m = play(s, 1, 12);
  DerivativeTape tape(m);
  Random random(seed);
  int found = 0;
  for (int e = 0; e < static_cast<int>(m.events.size()); ++e) {
    const SingleImpact* single = tape.singleImpact(e);
    if (!single) continue;
    ++found;
    const std::size_t n = m.events[static_cast<std::size_t>(e)].participants.size();
    std::vector<StateDerivative> after(n), read(n);
    for (auto* all : {&after, &read})
      for (StateDerivative& a : *all) a = {random.vec(1), random.vec(1), random.vec(1), random.vec(1)};
    const double time = random.in(-1, 1);
    SceneGradient scene(s), expected_scene(s);
    std::vector<BodyModelDerivative> model(s.bodies.size()), expected_model(s.bodies.size());
    const auto before = single->pullback(after, read, time, scene, model);
    const auto expected = tape.event(e).pullback(after, read, time, expected_scene, expected_model);
    const auto is = numbersOf(scene, model, before.data(), n);
    const auto should_be = numbersOf(expected_scene, expected_model, expected.data(), n);
    const double scale = largest(should_be) / m.events[static_cast<std::size_t>(e)].margins.grazing;  // which magnifies roundings
    for (std::size_t k = 0; k < is.size(); ++k)
      expectEntries(is[k] / scale, should_be[k] / scale, 1e-13, m.describeEvent(e) + ", part " + std::to_string(k));
  }
  return found;
}

TEST(SingleImpact, EqualsTheCommonReversePass) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomScene options;
    options.friction = seed % 3 != 0;
    options.lowest_elasticity = 0.1;
    Scene s = randomScene(seed, options);
    if (seed % 5 == 0) s.bodies.back().kinematic = !s.bodies.back().fixed;
    found += checkImpacts(s, seed);
    std::ranges::reverse(s.bodies);
    found += checkImpacts(s, seed);
  }
  EXPECT_GT(found, 200);
}

TEST(SingleImpact, OthersGoTheCommonWay) {
  Scene s = makeScene({0, 0, -9.81}, 0.5, 0.3,
                      {makePlane("floor", Vec3::UnitZ(), 0), makeBall("ball", 0.1, {0, 0, 1}, {1, 0, 0})});
  s.tilts = {{"ball", 1, {0.02, -0.01}}};
  const Motion m = play(s, 1.2, 2);
  ASSERT_GE(m.events.size(), 2u);
  DerivativeTape tape(m);
  EXPECT_EQ(tape.singleImpact(0), nullptr);  // tilted
  EXPECT_NE(tape.singleImpact(1), nullptr);
}

// The same bits again, and a motion that differentiating has not changed.
TEST(SingleImpact, ChangesNothing) {
  const Scene s = randomScene(3);
  const Motion m = play(s, 1, 12);
  const std::string before = m.signature();
  const Eigen::VectorXd first = flatten(gradientOf(m, 1, m.end, 0)), second = flatten(gradientOf(m, 1, m.end, 0));
  EXPECT_TRUE(first == second);
  EXPECT_EQ(m.signature(), before);
  EXPECT_TRUE(flatten(m.stateAt(1, m.end)) == flatten(play(s, 1, 12).stateAt(1, m.end)));
}

}  // namespace
}  // namespace carom
