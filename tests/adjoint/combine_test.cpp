// SPDX-License-Identifier: MIT
// Combine rules of two materials, all pairs, in both orders: "If either uses "average" : The two values should be
// averaged. Else if either uses "minimum" : The smallest …, "maximum" : The largest …, "multiply" : … multiplied with each
// other." (KHR_physics_rigid_bodies, Physics Materials.)

#include <gtest/gtest.h>

#include "adjoint/motion/pair_rules.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

constexpr Combine kRules[] = {Combine::average, Combine::minimum, Combine::maximum, Combine::multiply};

double asTheTextSays(Combine p, Combine q, double x, double y) {
  const auto either = [&](Combine rule) { return p == rule || q == rule; };
  if (either(Combine::average)) return 0.5 * (x + y);
  if (either(Combine::minimum)) return std::min(x, y);
  if (either(Combine::maximum)) return std::max(x, y);
  return x * y;
}

TEST(CombineRules, AreThoseOfTheText) {
  for (const Combine p : kRules)
    for (const Combine q : kRules)
      for (const Combine r : kRules)
        for (const Combine s : kRules) {
          Material a, b;
          a.elasticity = 0.9, a.friction = 0.3, a.combine_elasticity = p, a.combine_friction = r;
          b.elasticity = 0.5, b.friction = 0.7, b.combine_elasticity = q, b.combine_friction = s;
          for (const PairCoefficients& pair : {combine(a, b), combine(b, a)}) {
            EXPECT_EQ(pair.elasticity, asTheTextSays(p, q, 0.9, 0.5));
            EXPECT_EQ(pair.friction, asTheTextSays(r, s, 0.3, 0.7));
          }
        }
}

// The pair's rate is that of the rule that holds.
TEST(CombineRules, HaveTheDerivativesOfTheRuleThatHolds) {
  for (const Combine p : kRules)
    for (const Combine q : kRules) {
      Material a, b;
      a.friction = 0.3, a.combine_friction = p;
      b.friction = 0.7, b.combine_friction = q;
      const double h = 0x1p-20;
      const auto by = [&](double da, double db) {
        return (asTheTextSays(p, q, 0.3 + h * da, 0.7 + h * db) - asTheTextSays(p, q, 0.3 - h * da, 0.7 - h * db)) / (2 * h);
      };
      const PairRules<double> rules = rulesOf(a, b);
      EXPECT_NEAR(rules.tangent({0, 1, 0}, {}).friction, by(1, 0), 1e-9);
      EXPECT_NEAR(rules.tangent({}, {0, 1, 0}).friction, by(0, 1), 1e-9);
      MaterialDerivative a_bar, b_bar;
      rules.pullback({0, 1, 0}, a_bar, b_bar);
      EXPECT_NEAR(a_bar.friction, by(1, 0), 1e-9);
      EXPECT_NEAR(b_bar.friction, by(0, 1), 1e-9);
    }
}

}  // namespace
}  // namespace carom
