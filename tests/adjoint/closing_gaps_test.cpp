// SPDX-License-Identifier: MIT
// Second derivatives of the step that closes the gaps of several contacts (11.13), against differences of that step.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adjoint/second_order/second_order.h"
#include "adjoint/simulate/motion_builder.hpp"
#include "adjoint/simulate/path_arc.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

/// A way to change the scene, and its derivative.
struct Change {
  const char* name;
  std::function<void(Scene&, double)> by;
  std::function<void(SceneTangent&)> rate;
};

std::vector<Change> changes() {
  const Vec3 turn(0.3, 0.7, -0.2), shift(0.2, -0.1, 0.3);
  return {{"turn",
           [=](Scene& s, double h) {
             Quat& q = s.bodies[0].orientation;
             q = (Quat(Eigen::AngleAxisd(h * turn.norm(), turn.normalized())) * q).normalized();
           },
           [=](SceneTangent& t) { t.bodies[0].orientation = turn; }},
          {"position", [=](Scene& s, double h) { s.bodies[0].position += h * shift; },
           [=](SceneTangent& t) { t.bodies[0].position = shift; }},
          {"size", [](Scene& s, double h) { std::get<Box>(s.bodies[0].shape).size += h * Vec3(0.1, -0.2, 0.3); },
           [](SceneTangent& t) { t.bodies[0].size = Vec3(0.1, -0.2, 0.3); }},
          {"floor",
           [=](Scene& s, double h) {
             Quat& q = s.bodies[1].orientation;
             q = (Quat(Eigen::AngleAxisd(h * turn.norm(), turn.normalized())) * q).normalized();
           },
           [=](SceneTangent& t) { t.bodies[1].orientation = turn; }}};
}

/// A slab that lies on a floor at the start, and w.x of its centre of mass once its gaps are closed, in any scene.
class ClosingGaps {
 public:
  explicit ClosingGaps(const Scene& scene) : scene_(scene), contacts_(scene), motion_(simulate(scene, contacts_, 1)) {}

  const Motion& motion() const { return motion_; }

  double read(const std::vector<std::pair<const Change*, double>>& by) {
    Scene scene = scene_;
    for (const auto& [change, h] : by) change->by(scene, h);
    Scene lifted = scene;  // a start that overlaps is refused, and where bodies are is no part of the geometry
    lifted.bodies[0].position.z() += 1;
    contacts_.begin(lifted);
    MotionBuilder builder(scene, 1);
    builder.motion.plan = motion_.plan;
    builder.start();
    builder.motion.geometry = contacts_.geometry();
    const auto start = [&](std::size_t b) { return builder.motion.world_lines[b].arcs.back(); };
    std::vector<Contact> closed;
    for (const Contact& c : motion_.events[0].contacts) {
      if (!c.lasts) continue;
      closed.push_back(c);
      builder.place(closed.back(), start(0).kinematicsAt(0), start(1).kinematicsAt(0));
    }
    State state = start(0).startState();
    closeGaps(builder.motion, 0, state, closed);
    return kWeight.dot(state.x);
  }

  double mixed(const Change& a, const Change& b) {
    const auto at = [&](double h) {
      return (read({{&a, h}, {&b, h}}) - read({{&a, h}, {&b, -h}}) - read({{&a, -h}, {&b, h}}) +
              read({{&a, -h}, {&b, -h}})) /
             (4 * h * h);
    };
    constexpr double h = 2e-3;
    return (4 * at(h) - at(2 * h)) / 3;
  }

  inline static const Vec3 kWeight{0.7, 0.4, 1.1};

 private:
  Scene scene_;
  OdeContacts contacts_;
  Motion motion_;
};

TEST(ClosingGaps, SecondDerivatives) {
  Scene scene =  // without friction, as what slides against it has no second derivatives
      makeScene({0.3, 0.1, -9.81}, 0, 0,
                {makeBox("slab", {0.4, 0.3, 0.1}, {0, 0, 0.05}, {4, 0.4, 0}), makePlane("floor", Vec3::UnitZ(), 0)});
  scene.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ()));
  ClosingGaps closing(scene);
  const Motion& m = closing.motion();
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  ASSERT_EQ(m.events[0].kind, EventKind::placed);
  ASSERT_TRUE(hasSecondOrder(m));
  const std::vector<Change> all = changes();
  StateSeed seed;
  seed.body = 0;
  seed.at = Instant::at(0);
  seed.position = ClosingGaps::kWeight;
  std::vector<ReadingDirection> directions;
  for (const Change& c : all) {
    directions.push_back({SceneTangent(scene), {}});
    c.rate(directions.back().scene);
  }
  DerivativeTape tape(m);
  const SecondOrder second = secondOrder(tape, std::span(&seed, 1), {}, directions);
  double largest = 0;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      const double found = second.gradient_rates[a].dot(directions[b].scene), expected = closing.mixed(all[a], all[b]);
      expectEntries(found, expected, 1e-8, std::string(all[a].name) + " and " + all[b].name);
      largest = std::max(largest, std::abs(expected));
    }
  EXPECT_GT(largest, 0.1);
}

}  // namespace
}  // namespace carom
