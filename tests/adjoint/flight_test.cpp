// SPDX-License-Identifier: MIT
// Free rotation: the tiers against each other and against Jacobi's closed form, and the choice of the tier.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/flight/flight_triaxial.hpp"
#include "adjoint/numeric/so3.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

TriaxialRotation triaxial(const Vec3& I, const Quat& q, const Vec3& L, double t) {
  TriaxialRotation r;
  r.begin(I.cwiseInverse(), q, L);
  r.extendTo(t);
  return r;
}

struct Spin {
  Vec3 I;
  Quat q;
  Vec3 L;
  double t;
};

Spin randomSpin(std::uint64_t seed) {
  Random random(seed);
  const Vec3 I = Vec3(1, 1.4, 1.9) + random.vec(0.3);
  return {I, random.rotation(), random.vec(8), random.in(0.1, 3)};
}

// Rounding of an orientation grows with the angle that was turned through.
double turnedAngle(const Spin& s) { return s.L.norm() * s.t / s.I.minCoeff(); }

// The same rotation, whichever sign the quaternion has.
void expectRotation(const Quat& found, const Quat& expected, double tolerance, const std::string& what) {
  expectEntries(found.toRotationMatrix(), expected.toRotationMatrix(), tolerance, what);
}

TEST(Flight, TriaxialGivesTheSphericalClosedForm) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Spin s = randomSpin(seed);
    const double I = s.I[0];
    const TriaxialRotation r = triaxial(Vec3::Constant(I), s.q, s.L, s.t);
    expectRotation(r.orientationAt(s.t), sphericalOrientation(I, s.q, s.L, s.t), 1e-13, "orientation");
    const RotationSensitivity S = r.sensitivityAt(s.t), E = sphericalSensitivity(I, s.L, s.t);
    const double size = 1 + turnedAngle(s);
    expectEntries(S.dtheta_dtheta, E.dtheta_dtheta, 1e-13, "dtheta/dtheta", size);
    expectEntries(S.dtheta_dL, E.dtheta_dL, 1e-13, "dtheta/dL", size);
    const Vec3 together = E.dtheta_dI * Vec3::Ones();
    expectEntries(S.dtheta_dI * Vec3::Ones(), together, 1e-13, "dtheta/dI of all three", size);
  }
}

TEST(Flight, TriaxialGivesTheSymmetricClosedForm) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Spin s = randomSpin(seed);
    const int axis = static_cast<int>(seed % 3);
    s.I[(axis + 1) % 3] = s.I[(axis + 2) % 3];
    const TriaxialRotation r = triaxial(s.I, s.q, s.L, s.t);
    expectRotation(r.orientationAt(s.t), symmetricOrientation(s.I, axis, s.q, s.L, s.t), 1e-13, "orientation");
    const RotationSensitivity S = r.sensitivityAt(s.t), E = symmetricSensitivity(s.I, axis, s.q, s.L, s.t);
    const double size = 1 + turnedAngle(s);
    expectEntries(S.dtheta_dtheta, E.dtheta_dtheta, 1e-13, "dtheta/dtheta", size);
    expectEntries(S.dtheta_dL, E.dtheta_dL, 1e-13, "dtheta/dL", size);
    Eigen::Matrix<double, 3, 2> keeping;  // changes that keep the symmetry
    keeping << Vec3::Unit(axis), Vec3::Ones() - Vec3::Unit(axis);
    const Eigen::Matrix<double, 3, 2> expected = E.dtheta_dI * keeping;
    expectEntries(S.dtheta_dI * keeping, expected, 1e-13, "dtheta/dI", size);
  }
}

// dtheta/dI by a difference of fourth order, for one moment on its own.
Vec3 differenceByMoment(const Spin& s, int k) {
  const double h = 1e-3;
  const auto at = [&](double d) {
    Vec3 I = s.I;
    I[k] += d;
    const Quat q = triaxial(I, s.q, s.L, s.t).orientationAt(s.t), q0 = triaxial(s.I, s.q, s.L, s.t).orientationAt(s.t);
    return logSO3(q * q0.conjugate());
  };
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

// The trap of docs/equations.md section 2: a moment of a symmetric body that varies on its own leaves the symmetric
// family, and the symmetric formula does not know how.
TEST(Flight, SymmetricFormulaIsWrongForOneMomentAlone) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Spin s = randomSpin(seed);
    s.I[1] = s.I[0];
    s.L = s.L.normalized() * 4;
    const RotationSensitivity S = triaxial(s.I, s.q, s.L, s.t).sensitivityAt(s.t);
    const RotationSensitivity wrong = symmetricSensitivity(s.I, 2, s.q, s.L, s.t);
    for (int k = 0; k < 3; ++k)
      expectEntries(S.dtheta_dI.col(k), differenceByMoment(s, k), 1e-7, "dtheta/dI", 1 + S.dtheta_dI.norm());
    worst = std::max(worst, (S.dtheta_dI - wrong.dtheta_dI).norm() / S.dtheta_dI.norm());
  }
  EXPECT_GT(worst, 0.1);
}

TEST(Flight, EnergyAndMomentumAreKept) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Spin s = randomSpin(seed);
    const TriaxialRotation r = triaxial(s.I, s.q, s.L, 20);
    const auto energy = [&](const Quat& q) { return 0.5 * (q.conjugate() * s.L).cwiseAbs2().dot(s.I.cwiseInverse()); };
    for (double t : {0.5, 3.0, 11.0, 20.0}) {
      const Quat q = r.orientationAt(t);
      expectEntries(q.norm(), 1, 1e-15, "norm of the quaternion");
      expectEntries(energy(q) / energy(s.q), 1, 1e-13, "energy");
    }
  }
}

// sn, cn, dn of modulus k by descending Landen transformation.
Vec3 jacobi(double u, double k) {
  double a[12], c[12];
  a[0] = 1, c[0] = k;
  double b = std::sqrt(1 - k * k);
  int n = 0;
  for (; std::abs(c[n]) > 1e-17 && n < 11; ++n) {
    a[n + 1] = 0.5 * (a[n] + b), c[n + 1] = 0.5 * (a[n] - b);
    b = std::sqrt(a[n] * b);
  }
  double phi = std::ldexp(a[n] * u, n), next = phi;
  for (; n > 0; --n) next = phi, phi = 0.5 * (phi + std::asin(c[n] / a[n] * std::sin(phi)));
  return {std::sin(phi), std::cos(phi), std::cos(phi) / std::cos(next - phi)};
}

// Jacobi's solution in body axes for I1 < I2 < I3 and L^2 > 2 E I2, from the moment at which omega_2 = 0 (Landau and
// Lifshitz, Mechanics, section 37).
TEST(Flight, AngularVelocityFollowsJacobisClosedForm) {
  const Vec3 I(1, 1.7, 2.2);
  for (const Vec3& w0 : {Vec3(0.4, 0, 3), Vec3(2, 0, 2.5), Vec3(1.99, 0, 2)}) {
    const Vec3 M0 = I.cwiseProduct(w0);
    const double E2 = M0.dot(w0), L2 = M0.squaredNorm();
    ASSERT_GT(L2, E2 * I[1]);
    const double rate = std::sqrt((I[2] - I[1]) * (L2 - E2 * I[0]) / I.prod());
    const double k = std::sqrt((I[1] - I[0]) * (E2 * I[2] - L2) / ((I[2] - I[1]) * (L2 - E2 * I[0])));
    const Vec3 size(std::sqrt((E2 * I[2] - L2) / (I[0] * (I[2] - I[0]))),
                    std::sqrt((E2 * I[2] - L2) / (I[1] * (I[2] - I[1]))),
                    std::sqrt((L2 - E2 * I[0]) / (I[2] * (I[2] - I[0]))));
    const Quat q0 = Random(3).rotation();
    const Vec3 L = q0 * M0;
    const TriaxialRotation r = triaxial(I, q0, L, 6);
    for (double t = 0.3; t <= 6; t += 0.3) {
      const Vec3 sncndn = jacobi(rate * t, k);
      const Vec3 expected = size.cwiseProduct(Vec3(sncndn[1], sncndn[0], sncndn[2]));
      expectEntries((r.orientationAt(t).conjugate() * L).cwiseQuotient(I), expected, 1e-12, "omega in body axes");
    }
  }
}

// A body thrown about its middle axis turns over, again and again.
TEST(Flight, MiddleAxisFlips) {
  const Vec3 I(1, 2, 3), L = Vec3(1e-3, 2 * 5, 1e-3);
  const TriaxialRotation r = triaxial(I, Quat::Identity(), L, 40);
  int flips = 0;
  double side = 1;
  for (double t = 0; t <= 40; t += 0.05) {
    const double along = (r.orientationAt(t).conjugate() * L).normalized().y();
    if (std::abs(along) > 0.9 && along * side < 0) side = -side, ++flips;
  }
  EXPECT_GE(flips, 4);
  EXPECT_LE(flips, 12);
}

struct TierRow {
  const char* name;
  Body body;
  Asked asked;
  Tier tier, derivative_tier;
};

std::vector<TierRow> tierRows() {
  const auto box = [](const Vec3& size) { return makeBox("b", size, Vec3::Zero()); };
  const auto moments = [&](Body b, const Vec3& I) {
    b.inertia = Inertia::fromMoments(I);
    return b;
  };
  const Body ball = makeBall("b", 0.1, Vec3::Zero());
  const Asked all, motion{true, false}, place{false, false}, moments_only{false, true};
  using T = Tier;
  return {
      {"fixed", fixedBody(box({1, 1, 1})), all, T::none, T::none},
      {"ball, all", ball, all, T::spherical, T::spherical},
      {"ball, place only", ball, place, T::none, T::none},
      {"ball, derived moments vary together", ball, moments_only, T::none, T::none},
      {"ball, written moments vary alone", moments(ball, {1, 1, 1}), all, T::spherical, T::triaxial},
      {"ball, written moments, motion", moments(ball, {1, 1, 1}), motion, T::spherical, T::spherical},
      {"ball, unequal moments, place only", moments(ball, {1, 1.1, 1.2}), place, T::triaxial, T::triaxial},
      {"cube, motion", box({1, 1, 1}), motion, T::spherical, T::spherical},
      {"cube, place only: it turns all the same", box({1, 1, 1}), place, T::spherical, T::spherical},
      {"cube, its sizes vary alone", box({1, 1, 1}), all, T::spherical, T::triaxial},
      {"square rod, motion", box({1, 1, 2}), motion, T::symmetric, T::symmetric},
      {"square rod, all", box({1, 1, 2}), all, T::symmetric, T::triaxial},
      {"written symmetric moments, all", moments(box({1, 2, 3}), {1, 2, 2}), all, T::symmetric, T::triaxial},
      {"brick", box({1, 2, 3}), motion, T::triaxial, T::triaxial},
  };
}

TEST(Plan, TierOfWhatIsAsked) {
  for (const TierRow& row : tierRows()) {
    SCOPED_TRACE(row.name);
    const Scene s = makeScene(Vec3::Zero(), 1, 0, {row.body});
    const BodyPlan plan = makePlan(s, {row.asked}).bodies[0];
    EXPECT_STREQ(nameOf(plan.tier), nameOf(row.tier));
    EXPECT_STREQ(nameOf(plan.derivative_tier), nameOf(row.derivative_tier));
    EXPECT_NE(std::string(plan.why), "");
    EXPECT_NE(std::string(plan.derivative_why), "");
  }
}

}  // namespace
}  // namespace carom
