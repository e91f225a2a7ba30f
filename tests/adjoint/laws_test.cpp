// SPDX-License-Identifier: MIT
// Impact laws on their own, on random problems: energy, tangent against central differences, pullback against tangent;
// and the tilt of the normal. A new law adds a row.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/impact/tilt.hpp"
#include "adjoint/impact/tilt_frame.hpp"
#include "adjoint/second_order/dual_state.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A problem with its rates along one direction, in the first lane.
template <class Rate>
ImpactProblemOf<Rate> withRates(const ImpactProblem& p, const ImpactProblemDerivative& d) {
  const auto along = [](double value, double rate) {
    Rate both(value);
    both.rate[0] = rate;
    return both;
  };
  ImpactProblemOf<Rate> both{p.K.cast<Rate>(), p.u.cast<Rate>(), {}, {}, p.driven, p.held};
  setRates(both.K, d.K, 0);
  setRates(both.u, d.u, 0);
  for (std::size_t k = 0; k < p.normal.size(); ++k) {
    both.normal.push_back(p.normal[k].cast<Rate>());
    setRates(both.normal[k], d.normal[k], 0);
    both.pair.push_back({along(p.pair[k].elasticity, d.pair[k].elasticity),
                         along(p.pair[k].friction, d.pair[k].friction),
                         along(p.pair[k].tangential_elasticity, d.pair[k].tangential_elasticity)});
  }
  return both;
}

/// The law in dual numbers.
VectorXd tangentOf(const ImpactProblem& p, const ImpactProblemDerivative& d) {
  return ratesOf(solveLaw(withRates<Dual<1>>(p, d)).P, 0);
}

/// Rates of the pullback along `d`.
ImpactProblemDerivative secondOf(const ImpactProblem& p, const VectorXd& P_bar, const ImpactProblemDerivative& d) {
  const ImpactProblemDerivativeOf<Num> bar = lawPullback(withRates<Num>(p, d), VectorOf<Num>(P_bar.cast<Num>()));
  ImpactProblemDerivative rates(p.contacts());
  rates.K = ratesOf(bar.K, 0);
  rates.u = ratesOf(bar.u, 0);
  for (std::size_t k = 0; k < p.normal.size(); ++k) {
    rates.normal[k] = ratesOf(bar.normal[k], 0);
    const auto& c = bar.pair[k];
    rates.pair[k] = {c.elasticity.rate[0], c.friction.rate[0], c.tangential_elasticity.rate[0]};
  }
  return rates;
}

/// Problems that fall under one law.
struct LawRow {
  const char* name;
  int fewest, most;  // contacts
  bool friction;
  bool held = false;  // some of them
};
const LawRow kLaws[] = {{"frictionless", 1, 1, false},
                        {"friction", 1, 1, true},
                        {"joint", 2, 5, true},
                        {"joint, frictionless", 2, 5, false},
                        {"joint, held", 2, 5, true, true}};

/// K = B B^T and u = B w for bodies of unit mass with velocities w: the kinetic energy is |w|^2/2.
struct RandomProblem {
  ImpactProblem p;
  double energy = 0;

  RandomProblem(const LawRow& row, Random& random) {
    const int n = row.fewest + random.below(row.most - row.fewest + 1);
    const MatrixXd B = random.vector(9 * n * (n + 1)).reshaped(3 * n, 3 * n + 3);
    const VectorXd w = 2 * random.vector(3 * n + 3);
    p.K = B * B.transpose();
    p.u = B * w;
    energy = 0.5 * w.squaredNorm();
    const bool some_slippery = random.in(0, 1) < 0.3;
    for (int k = 0; k < n; ++k) {
      Vec3 normal = random.unit();
      if (normal.dot(p.u.segment<3>(3 * k)) > 0) normal = -normal;
      if (row.held) {
        p.held.push_back(k > 0 && random.below(2) == 0);
        if (p.held.back()) normal = normal.cross(p.u.segment<3>(3 * k)).normalized();
      }
      p.normal.push_back(normal);
      const double mu = row.friction ? std::pow(10, random.in(-1.5, 0.5)) : 0;
      p.pair.push_back({random.in(0, 1), some_slippery && k == 1 ? 0 : mu, random.in(-1, 1)});
    }
  }
};

double energyChange(const ImpactProblem& p, const VectorXd& P) { return P.dot(p.u) + 0.5 * P.dot(p.K * P); }

TEST(Laws, EnergyNeverGrowsAndContactsPart) {
  for (const LawRow& row : kLaws)
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
      SCOPED_TRACE(std::string(row.name) + ", seed " + std::to_string(seed));
      Random random(seed);
      const RandomProblem r(row, random);
      const ImpactSolution s = solveLaw(r.p);
      EXPECT_TRUE(energyChange(r.p, s.P) <= 1e-12 * r.energy) << energyChange(r.p, s.P) / r.energy;
      const VectorXd after = r.p.u + r.p.K * s.P;
      for (int k = 0; k < r.p.contacts(); ++k) {
        const Vec3& n = r.p.normal[static_cast<std::size_t>(k)];
        const Vec3 P = s.P.segment<3>(3 * k);
        const double e = r.p.pair[static_cast<std::size_t>(k)].elasticity,
                     mu = r.p.pair[static_cast<std::size_t>(k)].friction;
        const bool held = !r.p.held.empty() && r.p.held[static_cast<std::size_t>(k)];
        EXPECT_TRUE(held || n.dot(P) >= -1e-12) << "contact " << k << " pulls";
        EXPECT_TRUE((P - n.dot(P) * n).norm() <= mu * std::max(n.dot(P), 0.0) + 1e-11 * (1 + P.norm())) << "contact " << k;
        const double parting = n.dot(after.segment<3>(3 * k)), least = -e * n.dot(r.p.u.segment<3>(3 * k));
        EXPECT_TRUE(parting >= least - 1e-11) << "contact " << k << " comes off at " << parting << ", least " << least;
        EXPECT_TRUE(!held || std::abs(parting) <= 1e-11) << "contact " << k << " is let go at " << parting;
        if (r.p.contacts() > 1) continue;
        expectEntries(parting, least, 1e-12, "restitution");
      }
    }
}

// Several contacts without friction: every one leaves at least as fast as its own elasticity says, and pushes only if
// it leaves just so.
TEST(Laws, JointNormalImpulsesAreComplementary) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const RandomProblem r({"joint", 2, 6, false}, random);
    const VectorXd P = solveLaw(r.p).P, after = r.p.u + r.p.K * P;
    for (int k = 0; k < r.p.contacts(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec3& n = r.p.normal[i];
      const double excess = n.dot(after.segment<3>(3 * k)) + r.p.pair[i].elasticity * n.dot(r.p.u.segment<3>(3 * k));
      EXPECT_TRUE(excess >= -1e-11) << "contact " << k;
      EXPECT_TRUE(std::abs(excess * n.dot(P.segment<3>(3 * k))) <= 1e-10) << "contact " << k;
    }
  }
}

ImpactProblemDerivative randomDirection(const ImpactProblem& p, Random& random) {
  const int n = p.contacts();
  ImpactProblemDerivative d(n);
  const MatrixXd S = random.vector(9 * n * n).reshaped(3 * n, 3 * n);
  d.K = 0.5 * (S + S.transpose());
  d.u = random.vector(3 * n);
  for (int k = 0; k < n; ++k) {
    const Vec3 &normal = p.normal[static_cast<std::size_t>(k)], v = random.vec(1);
    d.normal[static_cast<std::size_t>(k)] = v - normal.dot(v) * normal;
    d.pair[static_cast<std::size_t>(k)] = {random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
  }
  return d;
}

ImpactProblem moved(ImpactProblem p, const ImpactProblemDerivative& d, double h) {
  p.K += h * d.K;
  p.u += h * d.u;
  for (std::size_t k = 0; k < p.normal.size(); ++k) {
    p.normal[k] = (p.normal[k] + h * d.normal[k]).normalized();
    p.pair[k].elasticity += h * d.pair[k].elasticity;
    if (p.pair[k].friction > 0) p.pair[k].friction += h * d.pair[k].friction;
    p.pair[k].tangential_elasticity += h * d.pair[k].tangential_elasticity;
  }
  return p;
}

// Contacts without friction stay without: their coefficient is no direction of the law's branch.
void keepSlippery(const ImpactProblem& p, ImpactProblemDerivative& d) {
  for (std::size_t k = 0; k < p.pair.size(); ++k)
    if (p.pair[k].friction == 0) d.pair[k].friction = 0;
}

TEST(Laws, TangentIsTheLimitOfDifferences) {
  for (const LawRow& row : kLaws)
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      SCOPED_TRACE(std::string(row.name) + ", seed " + std::to_string(seed));
      Random random(seed);
      const RandomProblem r(row, random);
      ImpactProblemDerivative d = randomDirection(r.p, random);
      keepSlippery(r.p, d);
      if (solveLaw(r.p).stick_slip_margin < 1e-3) continue;
      const double h = 1e-6;
      const VectorXd P = solveLaw(r.p).P;
      const VectorXd difference = (solveLaw(moved(r.p, d, h)).P - solveLaw(moved(r.p, d, -h)).P) / (2 * h);
      expectEntries(tangentOf(r.p, d), difference, 1e-6, "dP", 1 + difference.norm() + P.norm());
    }
}

// bar.d, and the size of its terms.
struct Product {
  double sum = 0, size = 0;

  Product(const ImpactProblemDerivative& bar, const ImpactProblemDerivative& d) {
    add(bar.K.cwiseProduct(d.K));
    add(bar.u.cwiseProduct(d.u));
    for (std::size_t k = 0; k < d.normal.size(); ++k) {
      add(bar.normal[k].cwiseProduct(d.normal[k]));
      add(Vec3(bar.pair[k].elasticity * d.pair[k].elasticity, bar.pair[k].friction * d.pair[k].friction,
               bar.pair[k].tangential_elasticity * d.pair[k].tangential_elasticity));
    }
  }

 private:
  void add(const MatrixXd& products) { sum += products.sum(), size += products.cwiseAbs().sum(); }
};

TEST(Laws, PullbackIsTheTransposeOfTangent) {
  double worst = 0;
  for (const LawRow& row : kLaws)
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      SCOPED_TRACE(std::string(row.name) + ", seed " + std::to_string(seed));
      Random random(seed);
      const RandomProblem r(row, random);
      ImpactProblemDerivative d = randomDirection(r.p, random);
      keepSlippery(r.p, d);
      const VectorXd P_bar = random.vector(r.p.u.size()), dP = tangentOf(r.p, d);
      const Product product(lawPullback(r.p, P_bar), d);
      const double size = product.size + P_bar.cwiseProduct(dP).cwiseAbs().sum();
      worst = std::max(worst, std::abs(P_bar.dot(dP) - product.sum) / size);
      expectEntries(P_bar.dot(dP) / size, product.sum / size, 1e-13, "dot product");
    }
  std::printf("dot products to %.1e\n", worst);
}

TEST(Laws, SecondDerivativesAreSymmetric) {
  double worst = 0;
  for (const LawRow& row : kLaws)
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      SCOPED_TRACE(std::string(row.name) + ", seed " + std::to_string(seed));
      Random random(seed);
      const RandomProblem r(row, random);
      const ImpactProblemDerivative one = randomDirection(r.p, random), two = randomDirection(r.p, random);
      const VectorXd P_bar = random.vector(r.p.u.size());
      const Product there(secondOf(r.p, P_bar, one), two), back(secondOf(r.p, P_bar, two), one);
      const double size = there.size + back.size;
      worst = std::max(worst, std::abs(there.sum - back.sum) / size);
      expectEntries(there.sum / size, back.sum / size, 1e-12, "second derivatives");
    }
  std::printf("second derivatives to %.1e\n", worst);
}

// One contact: the joint law is 4.1; it is 4.2 where the contact sticks, and where it slides in the plane or what pushes
// along the normal pushes nowhere else.
enum class Kind { any, planar, uncoupled };

void makeOneContact(Kind kind, ImpactProblem& p) {
  if (kind == Kind::any) return;
  const Vec3 n = p.normal[0], z = n.unitOrthogonal();
  if (kind == Kind::planar) {  // nothing happens along z
    const Mat3 across = Mat3::Identity() - z * z.transpose();
    p.K = across * p.K * across + z * z.transpose();
    p.u = across * p.u;
  } else {
    const Mat3 along = n * n.transpose(), across = Mat3::Identity() - along;
    p.K = (along * p.K * along + (1 + p.K(0, 0)) * across).eval();
  }
}

/// A contact and its like between two other bodies, or how both change.
template <class Problem>
Problem twice(const Problem& one, Problem both) {
  both.K = MatrixXd::Zero(6, 6);
  both.u.resize(6);
  both.normal.clear(), both.pair.clear();
  for (int k : {0, 3}) {
    both.K.template block<3, 3>(k, k) = one.K;
    both.u.template segment<3>(k) = one.u;
    both.normal.push_back(one.normal[0]);
    both.pair.push_back(one.pair[0]);
  }
  return both;
}

TEST(Laws, JointLawOfTwoContactsApartIsTheLawOfEach) {
  int stuck = 0;
  for (const LawRow& row : {kLaws[0], kLaws[1]})
    for (const Kind kind : {Kind::any, Kind::planar, Kind::uncoupled})
      for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(std::string(row.name) + ", seed " + std::to_string(seed));
        Random random(seed);
        RandomProblem r(row, random);
        makeOneContact(kind, r.p);
        const ImpactProblem both = twice(r.p, r.p);
        const ImpactSolution one = solveLaw(r.p), joint = solveLaw(both);
        if (kind == Kind::any && one.mode == ImpactMode::slide) continue;
        stuck += one.mode == ImpactMode::stick;
        expectEntries(joint.P, one.P.replicate(2, 1), 1e-10, "P", 1 + one.P.norm());
        EXPECT_EQ(joint.outcome[0] == ContactOutcome::sticks, one.mode == ImpactMode::stick);
        for (const std::size_t k : {0, 1}) {
          EXPECT_EQ(joint.outcome[k], one.outcome[0]);
          EXPECT_EQ(joint.closed[k], one.closed[0]);
        }
        if (kind != Kind::any) continue;
        ImpactProblemDerivative d = randomDirection(r.p, random);
        keepSlippery(r.p, d);
        const VectorXd dP = tangentOf(r.p, d);
        expectEntries(tangentOf(both, twice(d, ImpactProblemDerivative(2))), dP.replicate(2, 1), 1e-9, "dP", 1 + dP.norm());
      }
  EXPECT_GT(stuck, 50);
}

// A contact that is held alone: as of several.
TEST(Laws, OneConstrainedContactStaysAndRubsWhereItPushes) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    RandomProblem r(kLaws[1], random);
    if (seed % 2) r.p.normal[0] = -r.p.normal[0];  // it would leave
    r.p.held = {1};
    const ImpactSolution s = solveLaw(r.p);
    const Vec3 n = r.p.normal[0], u = r.p.u + r.p.K * s.P;
    EXPECT_TRUE(std::abs(n.dot(u)) <= 1e-12 && s.closed[0]) << "it is let go at " << n.dot(u);
    EXPECT_TRUE((s.P - n.dot(s.P) * n).norm() <= r.p.pair[0].friction * std::max(n.dot(s.P), 0.0) + 1e-12);
    const VectorXd P_bar = random.vector(3);
    const ImpactProblemDerivative d = randomDirection(r.p, random);
    const Product product(lawPullback(r.p, P_bar), d);
    const double dot = P_bar.dot(ratesOf(solveLaw(withRates<Dual<1>>(r.p, d)).P, 0));
    EXPECT_TRUE(std::abs(dot - product.sum) <= 1e-13 * (product.size + std::abs(dot))) << dot << " and " << product.sum;
  }
}

TEST(Tilt, JacobianIsTheLimitOfDifferences) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Vec3 n = random.unit(), v = random.vec(1), dn = v - n.dot(v) * n;
    const Vec2 a = random.vec(0.4).head<2>(), b = seed % 2 ? Vec2(0, 0) : Vec2(random.vec(0.4).head<2>());
    const Vec2 da = random.vec(1).head<2>(), db = random.vec(1).head<2>();
    const double h = 1e-6;
    const auto at = [&](double t) { return tiltedNormal((n + t * dn).normalized(), a + t * da, b + t * db); };
    Eigen::Matrix<double, 7, 1> d;
    d << dn, da, db;
    expectEntries(tiltJacobian<double>(n, a, b) * d, (at(h) - at(-h)) / (2 * h), 1e-8, "dn'", 1 + d.norm());
    expectEntries(at(0).norm(), 1, 1e-15, "length");
  }
}

// n = z: t1 = y and t2 = z x y = -x; the other body sees the opposite normal.
TEST(Tilt, DirectionsAreThoseOfTheDefinition) {
  expectEntries(tiltedNormal(Vec3::UnitZ(), {0.3, 0.1}, {0, 0}), Vec3(-0.1, 0.3, 1).normalized(), 1e-15, "a");
  expectEntries(tiltedNormal(-Vec3::UnitZ(), {0, 0}, {0.3, 0.1}), Vec3(0.1, -0.3, -1).normalized(), 1e-15, "b");
  expectEntries(tiltedNormal(Vec3::UnitZ(), {0, 0}, {0, 0}), Vec3(0, 0, 1), 0, "none");
}

}  // namespace
}  // namespace carom
