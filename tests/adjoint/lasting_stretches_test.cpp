// SPDX-License-Identifier: MIT
// Motion told by what lasts: who rests, slides and rolls on what, and from when to when; and what is an impact to
// people.

#include <gtest/gtest.h>

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/motion/lasting_contact.h"
#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::lasting_stretches {
namespace {

using namespace test;

const Vec3 kDown(0, 0, -9.81);

TEST(LastingStretches, CoverEveryPathOnce) {
  for (const DotProductScene& row : lastingScenes()) {
    SCOPED_TRACE(row.name);
    const Motion m = playLasting(row.scene(), row.duration, row.asked);
    const std::vector<LastingContact> all = lastingContacts(m);
    EXPECT_TRUE(std::ranges::is_sorted(all, {}, &LastingContact::from));
    std::vector<double> told(m.world_lines.size(), 0), taken(m.world_lines.size(), 0);
    for (const LastingContact& c : all) {
      const auto body = static_cast<std::size_t>(c.body);
      EXPECT_LT(c.from, c.to);
      EXPECT_LE(c.to, m.end);
      EXPECT_FALSE(c.features.empty());
      EXPECT_TRUE(m.scene->bodies[static_cast<std::size_t>(c.with)].fixed);
      const int middle = m.arcAt(c.body, 0.5 * (c.from + c.to));
      EXPECT_EQ(m.world_lines[body].arcs[static_cast<std::size_t>(middle)].kind(), c.kind);
      told[body] += c.to - c.from;
    }
    for (std::size_t b = 0; b < taken.size(); ++b) {
      const auto& arcs = m.world_lines[b].arcs;
      for (std::size_t k = 0; k < arcs.size(); ++k)
        if (arcs[k].kind() != ArcKind::flight)
          taken[b] += (k + 1 < arcs.size() ? arcs[k + 1].start() : m.end) - arcs[k].start();
      expectEntries(told[b], taken[b], 1e-14, "seconds in contact", 1);
    }
  }
}

TEST(LastingStretches, AHitThatChangesNothingGoesOn) {
  Scene scene = makeScene(kDown, 0, 0.5,
                          {makeBox("block", {0.4, 0.4, 0.2}, {0, 0, 0.1}), makeBall("ball", 0.05, {0.02, 0.01, 0.6}),
                           makePlane("floor", Vec3::UnitZ(), 0)});
  scene.materials.push_back(makeMaterial("rubber", 1, 0.5));
  scene.bodies[1].material = "rubber";
  const Motion m = playLasting(scene, 0.5);
  ASSERT_GE(m.world_lines[0].events.size(), 2u);  // placed, and hit
  const std::vector<LastingContact> all = lastingContacts(m);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].body, 0);
  EXPECT_EQ(all[0].with, 2);
  EXPECT_EQ(all[0].kind, ArcKind::rest);
  EXPECT_EQ(all[0].features.size(), 4u);
  EXPECT_EQ(all[0].from, 0);
  EXPECT_EQ(all[0].to, m.end);
}

TEST(LastingStretches, EndWhereABodyLeaves) {
  const Body ball = makeBall("ball", 0.1, {0.3, 0.1, 0.1}, {2, 0.2, 0});
  const Body table = fixedBody(makeBox("table", {2, 2, 0.5}, {0, 0, -0.25}));
  const Scene scene = makeScene(kDown, 0, 0.2, {ball, table, makePlane("floor", Vec3::UnitZ(), -0.5)});
  const Motion m = playLasting(scene, 0.75);
  const std::vector<LastingContact> all = lastingContacts(m);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].kind, ArcKind::slide);
  EXPECT_EQ(all[1].kind, ArcKind::roll);
  EXPECT_EQ(all[0].to, all[1].from);
  const Event& left = m.events.back();
  EXPECT_EQ(left.cause, TransitionCause::leaves);
  EXPECT_EQ(all[1].to, left.time);
  const int last = static_cast<int>(m.events.size()) - 1;
  EXPECT_EQ(describeChanges(m, 0), "ball slides");
  EXPECT_EQ(describeChanges(m, 1), "ball rolls");
  EXPECT_EQ(describeChanges(m, last), "ball leaves");
  EXPECT_NE(m.describeEvent(last).find(": ball leaves"), std::string::npos) << m.describeEvent(last);
  EXPECT_THROW(describeChanges(m, last + 1), InputError);
  EXPECT_THROW(describeChanges(m, -1), InputError);
}

TEST(LastingStretches, NeedEvents) {
  const Scene scene =
      makeScene(kDown, 0, 0.2, {makeBall("ball", 0.1, {0, 0, 0.1}), makePlane("floor", Vec3::UnitZ(), 0)});
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.record_events = false;
  EXPECT_THROW(lastingContacts(simulate(scene, contacts, 1, options)), InputError);
}

TEST(LastingStretches, BouncesToRestAreCountedAsPeopleDo) {
  const Scene scene =
      makeScene(kDown, 0.5, 0.3, {makeBall("ball", 0.1, {0, 0, 1.1}), makePlane("floor", Vec3::UnitZ(), 0)});
  const Motion m = playLasting(scene, 5);
  EXPECT_EQ(m.event_count, m.events.size());
  EXPECT_EQ(m.impacts, static_cast<std::size_t>(std::ranges::count_if(m.events, &Event::counts)));
  // A bounce of height h e^(2n) counts as long as it comes from at least a millionth of the radius.
  std::size_t expected = 0;
  for (double height = 1; height >= 1e-6 * 0.1; height *= 0.25) ++expected;
  EXPECT_EQ(m.impacts, expected);
  EXPECT_LT(m.impacts, m.event_count);
  OdeContacts contacts(scene);
  SimulateOptions few;
  few.record_events = false;
  const Motion paths = simulate(scene, contacts, 5, few);
  EXPECT_EQ(paths.impacts, m.impacts);
  few.impact_limit = 15;
  const Motion stopped = simulate(scene, contacts, 5, few);
  EXPECT_EQ(stopped.status, MotionStatus::impact_limit);
  EXPECT_EQ(stopped.event_count, 15u);
  EXPECT_EQ(stopped.message,
            "stopped after 15 events, " + std::to_string(expected) + " of them impacts, the limit");
}

}  // namespace
}  // namespace carom::lasting_stretches
