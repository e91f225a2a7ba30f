// SPDX-License-Identifier: MIT
// Derivatives along a path in contact are marked where a little change would make an event of a near miss.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

// A box that is released on one of its edges, its diagonal tilted by an angle from the vertical, and does not slip: the
// energy gives omega^2 = 3 g/(2 r) (cos tilt - cos theta), and the floor pushes with
//   N = m g/4 (1 + 9 cos^2 theta - 6 cos theta cos tilt),
// least at cos theta = cos(tilt)/3: m g/4 sin^2 tilt, half of it at each end of the edge.
Motion boxFallsOverItsEdge(double tilt) {
  const double width = 0.1, height = 0.3, r = 0.5 * std::hypot(width, height);
  Body box = makeBox("box", {width, 0.2, height}, {0, 0, r * std::cos(tilt)});
  box.orientation = Quat(Eigen::AngleAxisd(std::atan2(width, height) + tilt, Vec3::UnitY()));
  return play(makeScene({0, 0, -9.81}, 0, 1e9, {box, makePlane("floor", Vec3::UnitZ(), 0)}), 3);
}

Reliability reliabilityOf(const Motion& motion) {
  const std::vector<Arc>& arcs = motion.world_lines[0].arcs;
  EXPECT_GE(arcs.size(), 3u) << motion.message;  // in contact from the start, until it lies on its side
  std::vector<StateSeed> seeds(1);
  seeds[0].body = 0, seeds[0].at = Instant::at(0.999 * arcs[2].start()), seeds[0].position = {1, 0, 0};
  Reliability reliability;
  const SceneGradient gradient = adjoint(motion, seeds, &reliability);
  EXPECT_TRUE(gradient.bodies[0].position.allFinite());
  return reliability;
}

TEST(ConstrainedReliability, ABoxWhoseEdgeNearlyLiftsIsMarked) {
  for (const double tilt : {1e-3, 0.01, 0.2}) {
    SCOPED_TRACE(tilt);
    const double least = 0.125 * std::sin(tilt) * std::sin(tilt);
    const Reliability found = reliabilityOf(boxFallsOverItsEdge(tilt));
    EXPECT_TRUE(std::abs(found.smallest_margin - least) <= 1e-6 * least + 1e-11) << found.smallest_margin << " for " << least;
    EXPECT_EQ(found.reliable, least >= kReliableMargin) << found.message;
    if (found.reliable) continue;
    EXPECT_NE(found.message.find("the contact of 'box' with 'floor' nearly lifts (margin "), std::string::npos) << found.message;
  }
}

}  // namespace
}  // namespace carom
