// SPDX-License-Identifier: MIT
// Derivatives of bodies that contacts hold on corners, edges and faces.

#include <gtest/gtest.h>

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/constrained/constrained_linearization.hpp"
#include "tests/support/compare.h"
#include "tests/support/constrained_scenes.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/offset_scenes.h"
#include "tests/support/transposed.h"

namespace carom::held_derivatives {
namespace {

using namespace test;
using adjoint_detail::ConstrainedPath;

class ConstrainedDerivatives : public ::testing::TestWithParam<ConstrainedCase> {};

TEST_P(ConstrainedDerivatives, TangentAndAdjointAreTransposed) {
  Scene scene = GetParam().scene;
  for (bool reverse : {false, true}) {
    if (reverse) std::reverse(scene.bodies.begin(), scene.bodies.end());
    const Motion m = playLasting(scene, GetParam().duration);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE((reverse ? "reversed, seed " : "seed ") + std::to_string(seed));
      expectTransposed(m, seed, 1e-12);
    }
  }
}

// A die whose impacts leave a slip where another one begins: the start of the path stops it.
Scene dieWithStoppedSlips() {
  Body die = makeBox("die", Vec3::Constant(0.016), {0, 0, 0.036822478825975453},
                     {0.458423601420475, -0.30030392959331698, -0.93205876425219203});
  die.angular_velocity = {-20.679203353411356, 31.041016164709063, -26.666359958886712};
  die.orientation = {0.88515717278034056, -0.022470101480940061, 0.46196360240732626, -0.050808503872840353};
  return makeScene({0.1, -0.2, -9.81}, 0.3, 1, {die, makePlane("floor", Vec3::UnitZ(), 0)});
}

TEST(ConstrainedDerivativesOf, SlipsThatAnImpactLeftAreStoppedAtItsTime) {
  Scene scene = dieWithStoppedSlips();
  for (bool reverse : {false, true}) {
    if (reverse) std::reverse(scene.bodies.begin(), scene.bodies.end());
    const Motion m = playLasting(scene, 1);
    const int body = reverse ? 1 : 0;
    const WorldLine& line = m.world_lines[static_cast<std::size_t>(body)];
    DerivativeTape tape(m);
    Random random(5);
    SceneTangent direction(scene);
    direction.bodies[static_cast<std::size_t>(body)].velocity = random.vec(1);
    direction.bodies[static_cast<std::size_t>(body)].angular_velocity = random.vec(10);
    const MotionTangent found = tangent(tape, direction);
    int stopped = 0;
    for (std::size_t k = 1; k < line.arcs.size(); ++k) {
      const ConstrainedPath* path = line.arcs[k].trajectory().constrained();
      if (!path || !path->stopsSpeeds()) continue;
      ++stopped;
      // of a corner at the time of the event: dv + dw x r + w x (dtheta x r)
      const int event = line.events[k - 1];
      const BodyStateRate d = found.at(body, Instant::after(event));
      const auto now = path->instantAt(path->start());
      for (std::size_t c = 0; c < path->contacts().size(); ++c) {
        if (!path->contacts()[c].stands()) continue;
        const Vec3& r = now.contacts[c].r;
        const Vec3 parts[] = {d.velocity, d.angular_velocity.cross(r), now.body.omega.cross(d.orientation.cross(r))};
        const double scale = parts[0].norm() + parts[1].norm() + parts[2].norm();
        EXPECT_TRUE((parts[0] + parts[1] + parts[2]).norm() <= 1e-12 * scale)
            << "event " << event << ": " << (parts[0] + parts[1] + parts[2]).norm() << " of " << scale;
      }
    }
    EXPECT_GE(stopped, 1);
    expectTransposed(m, 3, 1e-12);
  }
}

// At eight instants, of which those before `from` are left out.
void expectLimits(const ConstrainedCase& row, double from = 0) {
  const Scene& scene = row.scene;
  const Motion m = playLasting(scene, row.duration);
  DerivativeTape tape(m);
  Random random(71);
  std::vector<Instant> when;
  const double until = row.smooth > 0 ? row.smooth : m.end;
  for (int i = 1; i <= 8; ++i)
    if (until * i / 8 >= from) when.push_back(Instant::at(until * i / 8));
  const SceneTangent all = randomDirection(scene, random);
  int compared = 0;
  for (const ControlRow& control : controlRows()) {
    SceneTangent d(scene);
    control.copy(d, all);
    if (std::string(control.name) == "tangential_elasticity") continue;  // they are 0, and must not be less
    if (std::string(control.name) == "elasticity" && scene.materials[0].elasticity == 0) continue;
    if (std::string(control.name) == "friction" && scene.materials[0].friction == 0) continue;
    const MotionTangent found = tangent(tape, d);
    const double h = std::string(control.name) == "density" ? 0.05 : 2e-5;
    std::vector<Motion> there;
    for (int k = 1; k <= 4; ++k)
      for (int sign : {-1, 1}) there.push_back(playLasting(moved(scene, d, sign * k * h), row.duration));
    if (std::ranges::any_of(there, [&](const Motion& n) { return n.signature() != m.signature(); })) continue;
    for (const Instant& at : when) {
      const BodyStateRate r = found.at(0, at);
      Eigen::Matrix<double, 12, 1> rate, difference = Eigen::Matrix<double, 12, 1>::Zero();
      rate << r.position, r.orientation, r.velocity, r.angular_velocity;
      const BodyState here = m.stateAt(0, at.time);
      for (std::size_t i = 0; i < there.size(); ++i) {
        difference += (i % 2 == 0 ? -1 : 1) * kEighthOrder[i / 2] / h * changeOf(here, there[i].stateAt(0, at.time));
      }
      expectEntries(rate, difference, 1e-6, control.name + std::string(" at ") + std::to_string(at.time),
                    std::max(1.0, difference.norm()));
      ++compared;
    }
  }
  EXPECT_GT(compared, 3 * static_cast<int>(when.size()));
}

// A ball that rolls in a V is held by any of many shares of its two contacts, one of which leaves room in both cones.
TEST(ConstrainedDerivativesOf, ABallThatRollsInAVAreThoseOfSticking) {
  for (ConstrainedCase row : constrainedScenes()) {
    if (std::string(row.name) != "ball spins in a V") continue;
    row.duration = 1, row.smooth = 0.9;
    const Motion m = playLasting(row.scene, row.duration);
    EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::roll);
    expectTransposed(m, 1, 1e-12);
    expectLimits(row, m.world_lines[0].arcs.back().start());
  }
}

// Central differences at h to 4h, weighted so that the error is of order h^8; where they go through the same events.
TEST_P(ConstrainedDerivatives, AreLimitsOfDifferences) { expectLimits(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Scenes, ConstrainedDerivatives, ::testing::ValuesIn(constrainedScenes()), [](const auto& row) {
  std::string name = row.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
});

}  // namespace
}  // namespace carom::held_derivatives
