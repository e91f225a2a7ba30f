// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/random/checks.h"
#include "tests/random/scenes.h"
#include "tests/support/scaled.h"

// Random scenes against an independent brute-force search for impacts. CAROM_TEST_SCALE multiplies their number;
// CAROM_TEST_SEED runs the scene of one seed, which every failure names.

namespace carom::brute {
namespace {

constexpr int kScenes = 300, kBlocks = 4, kSamplesOfScenes = 200;
constexpr std::uint64_t kFirstSeed = 20250;

class Tally {
 public:
  void run(std::uint64_t seed) {
    for (bool lasts : {false, true}) run(seed, lasts);
  }

  void run(std::uint64_t seed, bool lasts) {
    const RandomScene random = randomScene(seed);
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    OdeContacts contacts(random.scene);
    SimulateOptions options;
    options.impact_limit = 2000;
    if (!lasts) options.lowest_bounce = 0;
    const Motion motion = simulate(random.scene, contacts, random.duration, options);
    const double simulated = seconds();
    Findings findings;
    checkStates(motion, kSamplesOfScenes, findings);
    checkEnergy(motion, findings);
    checkSequence(motion, findings);
    ++statuses_[nameOf(motion.status)];
    if (simulated > 1 || seconds() > 5 || motion.status == MotionStatus::impact_limit)
      std::printf("seed %llu: simulated in %.2f s, checked in %.2f s, %zu events, %s\n",
                  static_cast<unsigned long long>(seed), simulated, seconds() - simulated, motion.events.size(),
                  motion.message.c_str());
    std::string what;
    for (std::size_t i = 0; i < std::min<std::size_t>(findings.failures.size(), 5); ++i)
      what += "  " + findings.failures[i] + "\n";
    EXPECT_TRUE(findings.failures.empty()) << "seed " << seed << " (CAROM_TEST_SEED=" << seed << "):\n"
                                           << what << describe(random);
    all_.add(findings);
  }

  void report() const {
    std::printf("%s\n", all_.summary().c_str());
    for (const auto& [status, count] : statuses_) std::printf("%d motions: %s\n", count, status.c_str());
    EXPECT_LE(100 * all_.undecided, all_.events) << "more than one event in a hundred could not be decided";
  }
  const Findings& all() const { return all_; }

 private:
  Findings all_;
  std::map<std::string, int> statuses_;
};

class RandomScenes : public testing::TestWithParam<int> {};

TEST_P(RandomScenes, agreeWithBruteForce) {
  Tally tally;
  if (const char* seed = std::getenv("CAROM_TEST_SEED")) {
    if (GetParam() == 0) tally.run(std::strtoull(seed, nullptr, 10)), tally.report();
    return;
  }
  const int scenes = test::scaled(kScenes / kBlocks);
  for (int i = 0; i < scenes; ++i) tally.run(kFirstSeed + static_cast<std::uint64_t>(GetParam() + kBlocks * i));
  tally.report();
  if (test::testScale() >= 1) {
    EXPECT_GT(tally.all().events, 5 * scenes);
  }
}
INSTANTIATE_TEST_SUITE_P(Blocks, RandomScenes, testing::Range(0, kBlocks));

}  // namespace
}  // namespace carom::brute
