// SPDX-License-Identifier: MIT
// An impact that differs is told by its number in the motion whose time is told: one that is gone by the motion before, all
// others by the result, with the number before where that is another.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "adjoint/simulate/simulate.h"
#include "editing/sequence_changes.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using test::Random;

std::vector<int> bodiesOf(const Event& event) {
  std::set<int> bodies;
  for (const Contact& contact : event.contacts) bodies.insert(contact.a), bodies.insert(contact.b);
  return {bodies.begin(), bodies.end()};
}

/// Of an event, among the reported impacts of its bodies.
int numberOf(const Motion& motion, int index) {
  const std::vector<int> bodies = bodiesOf(motion.events[static_cast<std::size_t>(index)]);
  int n = 0;
  for (int e = 0; e <= index; ++e) {
    const Event& event = motion.events[static_cast<std::size_t>(e)];
    n += event.counts() && bodiesOf(event) == bodies;
  }
  return n;
}

std::string startOf(int number) { return "The " + std::to_string(number); }

TEST(ImpactNumbers, AreThoseOfTheMotionWhoseTimeIsTold) {
  int numbered = 0, renumbered = 0;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    Random random(seed);
    Scene scene = thrownBox(), other = scene;
    for (Body& body : other.bodies)
      if (!body.fixed) body.velocity += 0.4 * Vec3(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
    OdeContacts contacts(scene), of_other(other);
    const Motion before = simulate(scene, contacts, 2), after = simulate(other, of_other, 2);
    for (const SequenceChange& change : sequenceChanges(before, before.events.size(), after, after.events.size())) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << change.sentence);
      if (change.kind == SequenceChange::Kind::order || change.kind == SequenceChange::Kind::contact) continue;
      const int was = change.before >= 0 ? numberOf(before, change.before) : 0;
      const int is = change.after >= 0 ? numberOf(after, change.after) : 0;
      EXPECT_TRUE(change.sentence.starts_with(startOf(is > 0 ? is : was)));
      const bool says_before = change.sentence.find(" before), ") != std::string::npos;
      EXPECT_EQ(says_before, was > 0 && is > 0 && was != is);
      ++numbered, renumbered += says_before;
    }
  }
  EXPECT_GE(numbered, 25);
  EXPECT_GE(renumbered, 1);
}

}  // namespace
}  // namespace carom
