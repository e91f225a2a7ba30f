// SPDX-License-Identifier: MIT
// Motions of so many bodies that neighbours are listed in windows: the same impacts as when everyone is everyone's
// neighbour; and paths without events.

#include <gtest/gtest.h>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/neighbours.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using namespace test;

// Collision detection that searches all pairs over the whole duration.
class EveryoneNear final : public ContactSource {
 public:
  explicit EveryoneNear(const Scene& scene) : contacts_(scene), bodies_(static_cast<int>(scene.bodies.size())) {}
  void begin(const Scene& scene) override { contacts_.begin(scene); }
  void setPath(int body, const Arc& arc, double from, double until) override {
    contacts_.setPath(body, arc, from, until);
  }
  void neighbours(int body, std::vector<int>& out) override {
    out.clear();
    for (int i = 0; i < bodies_; ++i)
      if (i != body) out.push_back(i);
  }
  std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override {
    return contacts_.firstImpact(a, b, arc_a, arc_b, from, until);
  }
  std::vector<FeaturePair> touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t, double reach) override {
    return contacts_.touching(a, b, arc_a, arc_b, t, reach);
  }
  std::shared_ptr<const ContactGeometry> geometry() const override { return contacts_.geometry(); }

 private:
  OdeContacts contacts_;
  int bodies_;
};

// side^3 balls, every fourth one a box if so asked, in a pen with an open top.
Scene pen(int side, bool boxes, std::uint64_t seed) {
  Random random(seed);
  std::vector<Body> bodies;
  const double size = 0.3 * side;
  for (int k = 0; k < 3; ++k) bodies.push_back(makePlane("low " + std::to_string(k), Vec3::Unit(k), 0));
  for (int k = 0; k < 2; ++k) bodies.push_back(makePlane("high " + std::to_string(k), -Vec3::Unit(k), -size));
  for (int i = 0; i < side * side * side; ++i) {
    const Vec3 at = 0.3 * Vec3(i % side + 0.5, i / side % side + 0.5, i / (side * side) + 0.5) + random.vec(0.02);
    const std::string name = std::to_string(i);
    Body body = boxes && i % 4 == 0 ? makeBox(name, {0.1, 0.14, 0.08}, at) : makeBall(name, 0.1, at);
    body.velocity = random.vec(3);
    body.angular_velocity = random.vec(5);
    bodies.push_back(body);
  }
  return makeScene({0, 0, -9.81}, 0.95, 0.2, bodies);
}

TEST(Windows, SameImpactsAsWithoutThem) {
  for (bool boxes : {false, true})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (boxes ? ", boxes" : ""));
      const Scene scene = pen(4, boxes, seed);
      ASSERT_GT(scene.bodies.size(), Neighbours::kFew);
      SimulateOptions options;
      options.impact_limit = boxes ? 120 : 300;
      OdeContacts contacts(scene);
      EveryoneNear everyone(scene);
      const Motion m = simulate(scene, contacts, 0.6, options), all = simulate(scene, everyone, 0.6, options);
      ASSERT_EQ(m.events.size(), all.events.size());
      ASSERT_GT(m.events.size(), 50u);
      EXPECT_EQ(m.signature(), all.signature());
      // rounding grows by the curvature of the balls at every impact of a chain
      for (std::size_t i = 0; i < m.events.size(); ++i)
        EXPECT_TRUE(std::abs(m.events[i].time - all.events[i].time) <= 1e-7) << i;
    }
}

TEST(Windows, PathsWithoutEvents) {
  const Scene scene = pen(4, false, 3);
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = 400;
  const Motion whole = simulate(scene, contacts, 1, options);
  options.record_events = false;
  const Motion paths = simulate(scene, contacts, 1, options);
  EXPECT_TRUE(paths.events.empty());
  EXPECT_EQ(paths.event_count, whole.events.size());
  EXPECT_EQ(whole.event_count, whole.events.size());
  EXPECT_EQ(paths.impacts, whole.impacts);
  EXPECT_EQ(paths.end, whole.end);
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body)
    for (double share : {0.1, 0.5, 1.0})
      EXPECT_TRUE(flatten(paths.stateAt(body, share * paths.end)) == flatten(whole.stateAt(body, share * whole.end)));
  StateSeed seed;
  seed.body = 10;
  seed.at = Instant::at(0.1);
  seed.position = Vec3::UnitX();
  EXPECT_NO_THROW(adjoint(whole, std::span(&seed, 1)));
  EXPECT_THROW(adjoint(paths, std::span(&seed, 1)), InputError);
  EXPECT_THROW(paths.findImpact(10, 1), InputError);
}

// Balls of one layer that land at the same moment are many impacts, not a cascade.
TEST(Windows, ManyLandAtOnce) {
  std::vector<Body> bodies{makePlane("floor", Vec3::UnitZ(), 0)};
  for (int i = 0; i < 400; ++i)
    bodies.push_back(makeBall(std::to_string(i), 0.1, {0.3 * (i % 20), 0.3 * (i / 20), 1.1}));
  const Scene scene = makeScene({0, 0, -9.81}, 1, 0, bodies);
  OdeContacts contacts(scene);
  const Motion m = simulate(scene, contacts, 1);
  EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_EQ(m.events.size(), 400u);
}

}  // namespace
}  // namespace carom
