// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/random/checks.h"
#include "tests/random/scenes.h"

// The checks see what they are there to see: collision detection with a fault put in makes them fail.

namespace carom::brute {
namespace {

// OdeContacts with one thing changed in what it predicts.
class Mutant final : public ContactSource {
 public:
  using Change = std::optional<PredictedImpact> (*)(const PredictedImpact&, int count);

  Mutant(const Scene& scene, Change change) : contacts_(scene), change_(change) {}
  void begin(const Scene& scene) override { contacts_.begin(scene); }
  void setPath(int body, const Arc& arc, double from, double until) override {
    contacts_.setPath(body, arc, from, until);
  }
  void neighbours(int body, std::vector<int>& out) override { contacts_.neighbours(body, out); }
  std::shared_ptr<const ContactGeometry> geometry() const override { return contacts_.geometry(); }
  std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override {
    const auto impact = contacts_.firstImpact(a, b, arc_a, arc_b, from, until);
    if (!impact) return impact;
    return change_(*impact, ++count_);
  }

 private:
  OdeContacts contacts_;
  Change change_;
  int count_ = 0;
};

int failuresWith(Mutant::Change change) {
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomScene random = randomScene(seed);
    Mutant contacts(random.scene, change);
    SimulateOptions options;
    options.impact_limit = 30;
    options.lowest_bounce = 0;
    const Motion motion = simulate(random.scene, contacts, random.duration, options);
    Findings findings;
    checkSequence(motion, findings);
    failed += !findings.failures.empty();
  }
  return failed;
}

TEST(Mutants, unchangedPasses) {
  EXPECT_EQ(failuresWith([](const PredictedImpact& p, int) { return std::optional(p); }), 0);
}
// A lost prediction does not always matter: another impact may come before it.
TEST(Mutants, lostImpactIsFound) {
  EXPECT_GE(failuresWith(
                [](const PredictedImpact& p, int count) { return count % 5 == 0 ? std::nullopt : std::optional(p); }),
            5);
}
TEST(Mutants, lateImpactIsFound) {
  EXPECT_GE(failuresWith([](const PredictedImpact& p, int) {
              return std::optional(PredictedImpact{p.time + 2e-9, p.features});
            }),
            8);
}
TEST(Mutants, earlyImpactIsFound) {
  EXPECT_GE(failuresWith([](const PredictedImpact& p, int) {
              return std::optional(PredictedImpact{p.time - 2e-9, p.features});
            }),
            8);
}

// The law of another material than the scene's.
TEST(Mutants, wrongElasticityIsFound) {
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomScene random = randomScene(seed);
    Scene changed = random.scene;
    for (Material& m : changed.materials) m.elasticity -= 1e-8;
    OdeContacts contacts(changed);
    Motion motion = simulate(changed, contacts, random.duration);
    motion.scene = std::make_shared<Scene>(random.scene);
    Findings findings;
    checkSequence(motion, findings);
    failed += !findings.failures.empty();
  }
  EXPECT_GE(failed, 8);
}

}  // namespace
}  // namespace carom::brute
