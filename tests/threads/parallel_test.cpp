// SPDX-License-Identifier: MIT
// Simulations in parallel are, to the last bit, what they are alone, whatever ran before in the process. Run under
// ThreadSanitizer by the preset `thread`.

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/threads/scenes.h"

namespace carom {
namespace {

using namespace threads;

// All numbers of a motion, bit by bit.
std::vector<std::uint64_t> bitsOf(const Motion& motion) {
  Bits bits;
  bits.add(motion.end);
  bits.add(static_cast<double>(motion.status));
  for (const Event& e : motion.events) {
    bits.add(e.time);
    for (const Contact& c : e.contacts) {
      for (int i : {c.a, c.b, static_cast<int>(c.features.kind), c.features.a, c.features.b})
        bits.add(static_cast<double>(i));
      bits.add(c.at.point), bits.add(c.at.normal), bits.add(c.impulse);
    }
  }
  for (const WorldLine& line : motion.world_lines)
    for (const Arc& arc : line.arcs) {
      const State& s = arc.startState();
      bits.add(arc.start());
      bits.add(s.x), bits.add(s.v), bits.add(s.L), bits.add(s.q.coeffs());
    }
  for (std::size_t body = 0; body < motion.world_lines.size(); ++body)
    bits.add(motion.stateAt(static_cast<int>(body), motion.end).orientation.coeffs());
  return bits.values;
}

std::vector<std::uint64_t> play(const Case& c) {
  OdeContacts contacts(c.scene);
  SimulateOptions options;
  options.impact_limit = c.impacts;
  return bitsOf(simulate(c.scene, contacts, c.duration, options));
}

class Parallel : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (const Case& c : allCases()) alone().push_back(play(c));
  }
  static std::vector<std::vector<std::uint64_t>>& alone() {
    static std::vector<std::vector<std::uint64_t>> results;
    return results;
  }
};

TEST_F(Parallel, ScenesHaveImpacts) {
  for (std::size_t i = 0; i < allCases().size(); ++i) {
    const Case& c = allCases()[i];
    OdeContacts contacts(c.scene);
    SimulateOptions options;
    options.impact_limit = c.impacts;
    EXPECT_GE(simulate(c.scene, contacts, c.duration, options).events.size(), 3u) << c.name;
  }
}

// Every thread plays all scenes, each thread in an order of its own.
TEST_F(Parallel, AnyOrderOnAnyThreadGivesTheSameBits) {
  const std::size_t cases = allCases().size();
  std::atomic<int> different{0};
  std::vector<std::thread> pool;
  for (std::size_t k = 0; k < kThreads; ++k)
    pool.emplace_back([&, k] {
      for (int round = 0; round < kRounds; ++round)
        for (std::size_t i = 0; i < cases; ++i) {
          const std::size_t j = (k % 2 ? cases - 1 - i : i + k) % cases;
          if (play(allCases()[j]) != alone()[j]) ++different;
        }
    });
  for (std::thread& t : pool) t.join();
  EXPECT_EQ(different, 0);
}

// The same scene on all threads at once.
TEST_F(Parallel, OneSceneOnAllThreads) {
  for (std::size_t i = 0; i < allCases().size(); ++i) {
    std::atomic<int> different{0};
    std::vector<std::thread> pool;
    for (std::size_t k = 0; k < kThreads; ++k)
      pool.emplace_back([&] {
        if (play(allCases()[i]) != alone()[i]) ++different;
      });
    for (std::thread& t : pool) t.join();
    EXPECT_EQ(different, 0) << allCases()[i].name;
  }
}

// An object that detected collisions for other scenes before gives the bits of a fresh one.
TEST_F(Parallel, ContactsThatAreUsedAgain) {
  OdeContacts contacts(allCases().back().scene);
  for (int round = 0; round < 2; ++round)
    for (std::size_t i = 0; i < allCases().size(); ++i) {
      const Case& c = allCases()[i];
      SimulateOptions options;
      options.impact_limit = c.impacts;
      EXPECT_TRUE(bitsOf(simulate(c.scene, contacts, c.duration, options)) == alone()[i]) << c.name;
    }
}

// One motion, read from several threads.
TEST_F(Parallel, AMotionCanBeReadFromSeveralThreads) {
  const Case& c = allCases().front();
  OdeContacts contacts(c.scene);
  SimulateOptions options;
  options.impact_limit = c.impacts;
  const Motion motion = simulate(c.scene, contacts, c.duration, options);
  const auto read = [&] {
    Bits bits;
    for (int step = 0; step <= 50; ++step)
      for (std::size_t body = 0; body < motion.world_lines.size(); ++body) {
        const BodyState s = motion.stateAt(static_cast<int>(body), motion.end * step / 50);
        bits.add(s.position), bits.add(s.orientation.coeffs());
      }
    return bits.values;
  };
  const std::vector<std::uint64_t> expected = read();
  std::atomic<int> different{0};
  std::vector<std::thread> pool;
  for (std::size_t k = 0; k < kThreads; ++k)
    pool.emplace_back([&] {
      if (read() != expected) ++different;
    });
  for (std::thread& t : pool) t.join();
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace carom
