// SPDX-License-Identifier: MIT
// A limit of work, a request to stop, and reports on the way.

#include <gtest/gtest.h>

#include <stop_token>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

constexpr double kDuration = 2;

Scene bouncing() {
  Scene s = makeScene({0, 0, -9.81}, 0.95, 0.3, {makePlane("floor", Vec3::UnitZ(), 0)});
  for (int i = 0; i < 6; ++i) {
    s.bodies.push_back(makeBox("box " + std::to_string(i), {0.3, 0.2, 0.1}, {0.4 * i, 0.1 * i, 1 + 0.3 * i}));
    s.bodies.back().angular_velocity = {1.0 + i, 2, -3};
  }
  return s;
}

Motion played(const Scene& scene, const SimulateOptions& options) {
  OdeContacts contacts(scene);
  return simulate(scene, contacts, kDuration, options);
}

// What a motion knows is the beginning of the whole one, bit by bit.
void expectBeginning(const Motion& part, const Motion& whole) {
  ASSERT_LE(part.events.size(), whole.events.size());
  for (std::size_t e = 0; e < part.events.size(); ++e) EXPECT_EQ(part.events[e].time, whole.events[e].time);
  const double t = 0.999999 * part.end;  // it may end in an impact, which only the whole motion has solved
  for (int b = 0; b < static_cast<int>(part.world_lines.size()); ++b) {
    const BodyState a = part.stateAt(b, t), w = whole.stateAt(b, t);
    EXPECT_EQ(a.position, w.position);
    EXPECT_EQ(a.orientation.coeffs(), w.orientation.coeffs());
    EXPECT_EQ(a.velocity, w.velocity);
  }
}

TEST(StepLimit, EndsWithWhatIsKnown) {
  const Scene scene = bouncing();
  const Motion whole = played(scene, {});
  ASSERT_GT(whole.steps, 100u);
  double before = -1;
  for (const std::size_t limit : {whole.steps / 20, whole.steps / 3, whole.steps - 20}) {
    SimulateOptions options;
    options.step_limit = limit;
    const Motion part = played(scene, options), again = played(scene, options);
    EXPECT_EQ(part.status, MotionStatus::step_limit);
    EXPECT_STREQ(nameOf(part.status), "step_limit");
    EXPECT_NE(part.message.find(std::to_string(limit) + " steps"), std::string::npos) << part.message;
    EXPECT_TRUE(part.end >= before && part.end < kDuration) << part.end;
    EXPECT_EQ(part.end, again.end);
    EXPECT_EQ(part.events.size(), again.events.size());
    expectBeginning(part, whole);
    before = part.end;
  }
  SimulateOptions enough;
  enough.step_limit = whole.steps;
  EXPECT_EQ(played(scene, enough).status, whole.status);
}

TEST(StepLimit, OfNothingIsAMotionOfNoTime) {
  SimulateOptions options;
  options.step_limit = 0;
  const Motion m = played(bouncing(), options);
  EXPECT_EQ(m.status, MotionStatus::step_limit);
  EXPECT_EQ(m.end, 0);
  EXPECT_EQ(m.stateAt(1, 0).position, Vec3(0, 0, 1));
}

TEST(StepLimit, CountsPairsThatOverlapAtTheStart) {
  Scene s = makeScene(Vec3::Zero(), 1, 0, {});
  for (int i = 0; i < 40; ++i) s.bodies.push_back(makeBall("ball " + std::to_string(i), 1, {0.01 * i, 0, 0}));
  WorkCount work(100, {}, nullptr);
  EXPECT_THROW(OdeContacts(s, &work), WorkEnded);
  SimulateOptions options;
  options.step_limit = 100;
  const Motion m = played(s, options);
  EXPECT_EQ(m.status, MotionStatus::step_limit);
  EXPECT_EQ(m.end, 0);
  EXPECT_TRUE(m.stateAt(0, 0).position.allFinite());
}

TEST(Stop, BeforeAndOnTheWay) {
  const Scene scene = bouncing();
  std::stop_source source;
  SimulateOptions options;
  options.stop = source.get_token();
  const Motion whole = played(scene, options);
  EXPECT_NE(whole.status, MotionStatus::stopped);
  source.request_stop();
  const Motion none = played(scene, options);
  EXPECT_EQ(none.status, MotionStatus::stopped);
  EXPECT_STREQ(nameOf(none.status), "stopped");
  expectBeginning(none, whole);

  std::stop_source later;
  options.stop = later.get_token();
  std::size_t reports = 0;
  SimulateProgress last;
  options.progress = [&](const SimulateProgress& at) {
    EXPECT_GE(at.time, last.time);
    EXPECT_GE(at.impacts, last.impacts);
    EXPECT_GT(at.steps, last.steps);
    last = at;
    if (++reports == 1) later.request_stop();
  };
  const Motion part = played(scene, options);
  if (whole.steps > 6000) {
    EXPECT_EQ(part.status, MotionStatus::stopped);
    EXPECT_LT(part.steps, 6000u);
  }
  expectBeginning(part, whole);
}

TEST(Stop, ReportsChangeNothing) {
  const Scene scene = bouncing();
  SimulateOptions options;
  options.progress = [](const SimulateProgress&) {};
  const Motion reported = played(scene, options), plain = played(scene, {});
  EXPECT_EQ(reported.steps, plain.steps);
  EXPECT_EQ(reported.events.size(), plain.events.size());
  expectBeginning(reported, plain);
}

TEST(Overlaps, OfMoreThanAHundredThousandPairsAreRefused) {
  Scene s = makeScene(Vec3::Zero(), 1, 0, {});
  for (int i = 0; i < 460; ++i) s.bodies.push_back(makeBall("ball " + std::to_string(i), 1, {0.001 * i, 0, 0}));
  try {
    OdeContacts contacts(s);
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("100000 pairs"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace carom
