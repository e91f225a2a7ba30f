// SPDX-License-Identifier: MIT
// Paths of boxes that floors hold at their corners, between the ends of the steps of the collocation, against Taylor
// series in 50 digits of the same equations of motion.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/reference/constrained_along.h"
#include "tests/reference/constrained_boxes.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::reference::held {
namespace {

using adjoint_detail::PersistentContact;
using adjoint_detail::ContactMode;
using adjoint_detail::ConstrainedPath;
using test::playLasting;
using test::Random;

constexpr int kOrder = 34;
const Real kTolerance("1e-32");

// `count` times in the steps of a path, none at their ends, against the series.
double worstOf(const ConstrainedPath& path, double end, const Vec3& size, int count, Random& random) {
  const double l = path.scene().length, c = path.scene().speed;
  std::vector<double> times;
  while (static_cast<int>(times.size()) < count)
    for (const auto& step : path.allSteps())
      if (step.start < end && step.length > 0) times.push_back(step.start + random.in(0, std::min(step.length, end - step.start)));
  std::sort(times.begin(), times.end());
  const BodyModel& model = *path.scene().model;
  ConstrainedAlong exact(bodyOf(path), cornersOf(path, size), stateOf(model, path.stateAt(path.start())), path.start(), kOrder, kTolerance);
  double worst = 0;
  for (const double t : times) {
    const State found = path.stateAt(t);
    const ConstrainedState s = exact.at(t);
    const ConstrainedState f = stateOf(model, found);
    const double errors[] = {(f.x - s.x).rounded().norm() / l, (rounded(f.R) - rounded(s.R)).norm(),
                             (f.v - s.v).rounded().norm() / c, (f.spin - s.spin).rounded().norm() / (c / l)};
    for (const double error : errors)
      if (!(error <= worst)) worst = error;
  }
  return worst;
}

// What the paths of a box do.
struct Seen {
  int paths = 0, begin = 0, stop = 0, stick = 0, many = 0, unknown = 0;
  double worst = 0;
};

Seen expectPaths(const Scene& scene, double duration, std::uint64_t seed) {
  const Motion m = playLasting(scene, duration);
  const Vec3 size = std::get<Box>(scene.bodies[0].shape).size;
  Random random(seed);
  Seen seen;
  for (const ConstrainedSpan& span : constrainedPathsOf(m)) {
    double worst = 0;
    try {
      worst = worstOf(*span.path, span.until, size, 100, random);
    } catch (const SlipsTogether&) {
      ++seen.unknown;
      continue;
    }
    EXPECT_TRUE(worst <= 1e-12) << "seed " << seed << ", path " << span.arc << " from " << span.path->start() << " to " << span.until << ": " << worst;
    test::recordShare(worst / 1e-12);
    seen.worst = std::max(seen.worst, worst);
    ++seen.paths;
    seen.begin += span.any([](const PersistentContact& c) { return c.begins; });
    seen.stick += span.any([](const PersistentContact& c) { return c.mode == ContactMode::sticks; });
    seen.stop += span.path->contactThatStops().has_value();
    seen.many += span.path->contacts().size() > 1;
  }
  return seen;
}

TEST(ConstrainedSeries, ACornerSticks) {
  const Seen seen = expectPaths(onCorner(kLeaning, 0.9, Vec3::Zero(), Vec3::Zero()), 0.15, 1);
  EXPECT_GE(seen.stick, 1);
}
TEST(ConstrainedSeries, ACornerSlidesToAStop) {
  const Seen seen = expectPaths(onCorner(kLeaning, 0.9, {0.05, 0.1, 0}, {0.2, 0.1, 1}), 0.15, 2);
  EXPECT_GE(seen.stop, 1);
}
TEST(ConstrainedSeries, ACornerStartsToSlideFromRest) {
  const Seen seen = expectPaths(onCorner(kLeaning, 0.1, Vec3::Zero(), Vec3::Zero()), 0.15, 3);
  EXPECT_GE(seen.begin, 1);
}
TEST(ConstrainedSeries, AnEdgeSticks) {
  const Seen seen = expectPaths(onCorner(Quat(Eigen::AngleAxisd(0.7, Vec3::UnitX())), 0.4, Vec3::Zero(), Vec3::Zero()), 0.3, 4);
  EXPECT_TRUE(seen.stick >= 1 && seen.many >= 1);
}
TEST(ConstrainedSeries, AFaceSlidesAndTurns) {
  const Seen seen = expectPaths(onCorner(Quat::Identity(), 0.4, {1, 0.3, 0}, {0, 0, 5}), 0.9, 5);
  EXPECT_TRUE(seen.stop >= 1 && seen.many >= 1);
}

// Whatever comes of boxes that are dropped.
TEST(ConstrainedSeries, RandomBoxes) {
  Seen all;
  for (int i = 1; i <= test::scaled(4); ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Seen seen = expectPaths(droppedBox(seed), 1.5, seed);
    all.paths += seen.paths, all.begin += seen.begin, all.stop += seen.stop, all.stick += seen.stick;
    all.many += seen.many, all.unknown += seen.unknown, all.worst = std::max(all.worst, seen.worst);
  }
  std::printf("%d paths: %d begin to slip, %d stop, %d stick, %d on several corners; %d unknown; worst %g\n", all.paths,
              all.begin, all.stop, all.stick, all.many, all.unknown, all.worst);
  EXPECT_TRUE(all.begin > 0 && all.stop > 0 && all.stick > 0 && all.many > 0 && 20 * all.unknown < all.paths);
}

}  // namespace
}  // namespace carom::reference::held
