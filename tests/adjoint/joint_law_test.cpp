// SPDX-License-Identifier: MIT
// Equation 4.4 on its own: random impacts of up to six bodies, in any order; landings whose answer is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "adjoint/base/errors.h"
#include "adjoint/impact/impact_pass.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/scaled.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Contacts u = B w of bodies whose energy is |w|^2/2, so that K = B B^T and w+ = w + B^T P.
struct Impact {
  MatrixXd B;
  VectorXd w;
  ImpactProblem p;

  void solveFor() { p.K = B * B.transpose(), p.u = B * w; }
  VectorXd after(const VectorXd& P) const { return w + B.transpose() * P; }
};

// Contacts between bodies, or of a body with the ground; the four corners of a face where `flat`.
Impact randomImpact(std::uint64_t seed) {
  Random random(seed);
  const bool flat = seed % 4 == 0;
  const int bodies = flat ? 1 : 1 + random.below(6), n = flat ? 4 : 2 + random.below(11);
  Impact i;
  i.B = MatrixXd::Zero(3 * n, 6 * bodies);
  for (int k = 0; k < n; ++k) {
    const int a = k % bodies, other = bodies > 1 ? random.below(bodies + 1) : bodies, b = other == a ? bodies : other;
    for (int body : {a, b}) {
      if (body == bodies) continue;
      const Vec3 r = flat ? Vec3(k % 2 ? 0.2 : -0.2, k < 2 ? 0.15 : -0.15, -0.1) : random.vec(1);
      const double root = (body == a ? 1 : -1) / std::sqrt(1.0 + body);
      i.B.block<3, 3>(3 * k, 6 * body) = root * Mat3::Identity();
      i.B.block<3, 3>(3 * k, 6 * body + 3) = -root * skew(r) * Vec3(2, 1.5, 1.1).asDiagonal();
    }
  }
  i.w = random.vector(6 * bodies);
  if (flat) i.w[2] = -1, i.w.tail<3>() *= 0.1;
  i.solveFor();
  for (int k = 0; k < n; ++k) {
    const Vec3 u = i.p.u.segment<3>(3 * k);
    Vec3 normal = flat ? Vec3(0, 0, 1) : random.unit();
    if (random.below(4) == 0 && !flat) normal = normal.cross(u).normalized();  // touches
    if (normal.dot(u) > 0) normal = -normal;
    i.p.normal.push_back(normal);
    const double mu = random.below(5) == 0 ? 0 : std::pow(10, random.in(-1.5, 0.3));
    i.p.pair.push_back({random.below(3) == 0 ? 0 : random.in(0, 1), mu, random.below(2) ? 0 : random.in(-1, 1)});
  }
  return i;
}

// The same with bodies and contacts in another order: contact k of it is contact order[k] of `i`.
Impact permuted(const Impact& i, const std::vector<int>& order, const std::vector<int>& bodies) {
  Impact r = i;
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      r.B.block<3, 6>(3 * static_cast<Index>(k), 6 * static_cast<Index>(b)) = i.B.block<3, 6>(3 * order[k], 6 * bodies[b]);
    r.p.normal[k] = i.p.normal[static_cast<std::size_t>(order[k])];
    r.p.pair[k] = i.p.pair[static_cast<std::size_t>(order[k])];
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    r.w.segment<6>(6 * static_cast<Index>(b)) = i.w.segment<6>(6 * bodies[b]);
  r.solveFor();
  return r;
}
std::vector<int> shuffled(Index n, Random& random) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = order.size(); k > 1; --k)
    std::swap(order[k - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(k)))]);
  return order;
}

void expectLawful(const Impact& i, const ImpactSolution& s) {
  const VectorXd w = i.after(s.P), u = i.p.u + i.p.K * s.P;
  EXPECT_TRUE(w.squaredNorm() <= i.w.squaredNorm() * (1 + 1e-12)) << w.squaredNorm() / i.w.squaredNorm() - 1;
  const double size = 1 + s.P.cwiseAbs().maxCoeff();
  for (int k = 0; k < i.p.contacts(); ++k) {
    const auto kk = static_cast<std::size_t>(k);
    const Vec3 n = i.p.normal[kk], P = s.P.segment<3>(3 * k);
    const double P_n = n.dot(P), P_t = (P - P_n * n).norm();
    const double was = n.dot(i.p.u.segment<3>(3 * k)), is = n.dot(u.segment<3>(3 * k));
    EXPECT_TRUE(P_n >= -1e-12 * size && P_t <= i.p.pair[kk].friction * P_n + 1e-12 * size)
        << k << ": " << P_t << " of " << P_n;
    EXPECT_TRUE(is >= -i.p.pair[kk].elasticity * was - 1e-12 * size) << k << ": " << was << " -> " << is;
    EXPECT_TRUE(!s.closed[kk] || std::abs(is) <= 1e-12 * size) << k << " parts at " << is;
    EXPECT_TRUE(s.outcome[kk] != ContactOutcome::off || P.norm() <= 1e-12 * size) << k;
  }
}

TEST(JointLaw, IsLawfulAndKnowsNoOrder) {
  int refused = 0;
  double worst = 0;
  const int impacts = scaled(6000);
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(impacts); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Impact i = randomImpact(seed);
    Random random(seed + 1);
    const auto order = shuffled(i.p.contacts(), random), bodies = shuffled(i.w.size() / 6, random);
    const Impact other = permuted(i, order, bodies);
    try {
      const ImpactSolution s = solveLaw(i.p), t = solveLaw(other.p);
      expectLawful(i, s);
      const VectorXd there = i.after(s.P), here = other.after(t.P);
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        const VectorXd one = here.segment<6>(6 * static_cast<Index>(b)), two = there.segment<6>(6 * bodies[b]);
        // velocities are differences of what the impulses give, which are large where a body is wedged
        const double size = 1 + s.P.cwiseAbs().maxCoeff();
        worst = std::max(worst, (one - two).cwiseAbs().maxCoeff() / size);
        expectEntries(one, two, 1e-12, "velocities", size);
      }
    } catch (const NotComputable& error) {
      std::printf("seed %d: %s\n", static_cast<int>(seed), error.what());
      ++refused;
    }
  }
  std::printf("%d impacts, %d refused; order counts for %.1e\n", impacts, refused, worst);
  EXPECT_EQ(refused, 0);
}

// A slab of mass 1, 0.4 x 0.3 x 0.2, flat on its four corners.
Impact slab(const Vec3& velocity, double e, std::vector<double> friction) {
  Impact i;
  i.B = MatrixXd::Zero(12, 6);
  const Vec3 root = Vec3((0.09 + 0.04) / 12, (0.16 + 0.04) / 12, (0.16 + 0.09) / 12).cwiseInverse().cwiseSqrt();
  for (int k = 0; k < 4; ++k) {
    const Vec3 r(k % 2 ? 0.2 : -0.2, k < 2 ? -0.15 : 0.15, -0.1);
    i.B.block<3, 3>(3 * k, 0).setIdentity();
    i.B.block<3, 3>(3 * k, 3) = -skew(r) * root.asDiagonal();
    i.p.normal.push_back(Vec3::UnitZ());
    i.p.pair.push_back({e, friction[static_cast<std::size_t>(k)], 0});
  }
  i.w = VectorXd::Zero(6);
  i.w.head<3>() = velocity;
  i.solveFor();
  return i;
}

// Three corners and what they carry can hold a speed of 0.2: with a the load of the fourth one and s the speed, those of
// the others are 1/2 + s/4 - a, 1/2 - a and a - s/4, so the friction can be 0.3 (1 - a) with any a > s/4, and act at the
// middle. The first corner at its cone would have let all of them go.
TEST(JointLaw, SlabWithACornerOnIceStopsAsCoulombSays) {
  for (const Vec3& v : {Vec3(0.2, 0, -1), Vec3(-0.2, 0, -1), Vec3(0, 0.2, -1), Vec3(0.12, -0.12, -1)}) {
    const Impact i = slab(v, 0, {0.3, 0.3, 0.3, 0});
    expectEntries(i.after(solveLaw(i.p).P), VectorXd::Zero(6).eval(), 1e-12, "velocities");
  }
  const Impact fast = slab({1, 0, -1}, 0, {0.3, 0.3, 0.3, 0});  // no more than 0.3 of what they carry
  const VectorXd P = solveLaw(fast.p).P, after = fast.after(P);
  EXPECT_GT(after[0], 0.7 - 1e-12);
  EXPECT_LT(after[0], 0.85);
}

TEST(JointLaw, SlabLosesWhatCoulombSays) {
  const Impact i = slab({1, 0.5, -2}, 0.6, {0.3, 0.3, 0.3, 0.3});
  const ImpactSolution s = solveLaw(i.p);
  const double speed = std::sqrt(1.25), left = (speed - 0.3 * 1.6 * 2) / speed;
  VectorXd expected = VectorXd::Zero(6);
  expected.head<3>() = Vec3(left, 0.5 * left, 1.2);
  expectEntries(i.after(s.P), expected, 1e-12, "velocities");
  expectEntries(expected.head<2>(), Vec2(0.14134990, 0.07067495), 1e-8, "as found elsewhere");
  for (int k = 0; k < 4; ++k) EXPECT_EQ(s.outcome[static_cast<std::size_t>(k)], ContactOutcome::slides);
}

// A contact that stays at n.u = 0 may pull, and does not rub then.
TEST(JointLaw, ConstrainedContactsPullWithoutFriction) {
  Impact i = slab({0.3, 0, 0}, 0.5, {0.4, 0.4, 0.4, 0.4});
  i.w[4] = 0.2;  // corners on one side come down, the others lift
  i.solveFor();
  for (int k = 0; k < 4; ++k) i.p.held.push_back(1);
  const ImpactSolution s = solveLaw(i.p);
  const VectorXd u = i.p.u + i.p.K * s.P;
  double least = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 P = s.P.segment<3>(3 * k);
    EXPECT_TRUE(std::abs(u[3 * k + 2]) <= 1e-13) << k << " parts at " << u[3 * k + 2];
    EXPECT_TRUE(s.closed[static_cast<std::size_t>(k)]);
    EXPECT_TRUE(P.head<2>().norm() <= 0.4 * std::max(P.z(), 0.0) + 1e-13) << P.transpose();
    least = std::min(least, P.z());
  }
  EXPECT_LT(least, -1e-3);
  EXPECT_LE(i.after(s.P).squaredNorm(), i.w.squaredNorm());
}

}  // namespace
}  // namespace carom
