// SPDX-License-Identifier: MIT
// The closed form of free rotation by elliptic functions: the functions against those of the standard library, the
// rotation against the series, and where there is none.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "adjoint/flight/flight_elliptic.hpp"
#include "adjoint/flight/flight_triaxial.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

TEST(EllipticFunctions, IntegralsAreThoseOfTheStandardLibrary) {
  for (const double k : {0.0, 1e-9, 1e-3, 0.3, 0.7, 0.99}) {
    SCOPED_TRACE("k " + std::to_string(k));
    const EllipticModulus modulus((1 - k) * (1 + k));
    expectEntries(modulus.completeK(), std::comp_ellint_1(k), 1e-14, "K", modulus.completeK());
    for (double phi = -3.1; phi <= 3.1; phi += 0.31)
      expectEntries(modulus.incompleteF(std::cos(phi), std::sin(phi)), std::ellint_1(k, phi), 1e-14, "F",
                    modulus.completeK());
  }
}

// K = log(4/k') and F = atanh(sin phi) there, with errors of order m1 log(m1) and m1/cos(phi)^2.
TEST(EllipticFunctions, KeepTheirDigitsNearModulusOne) {
  for (const double m1 : {1e-40, 1e-60, 1e-100}) {
    SCOPED_TRACE("m1 " + std::to_string(std::log10(m1)));
    const EllipticModulus modulus(m1);
    const double K = std::log(4 / std::sqrt(m1));
    expectEntries(modulus.completeK(), K, 1e-15, "K", K);
    for (const double x : {1e-2, 1e-5, 3e-7}) {
      const double F = std::asinh(std::sqrt(1 - x * x) / x);
      expectEntries(modulus.incompleteF(x, std::sqrt(1 - x * x)), F, 1e-14, "F", F);
      const EllipticModulus::Functions f = modulus.at(F);
      expectEntries(f.cn, x, 1e-14, "cn");
      expectEntries(f.dn, x, 1e-14, "dn");
    }
  }
}

TEST(EllipticFunctions, ObeyTheirIdentities) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const double m1 = std::pow(10, random.in(-30, 0)), m = 1 - m1;
    const EllipticModulus modulus(m1);
    const double phi = random.in(-1.5, 1.5);
    const EllipticModulus::Functions f = modulus.at(modulus.incompleteF(std::cos(phi), std::sin(phi)));
    SCOPED_TRACE("seed 5, m1 " + std::to_string(m1) + ", phi " + std::to_string(phi));
    expectEntries(f.sn, std::sin(phi), 2e-14, "sn");
    expectEntries(f.cn, std::cos(phi), 2e-14, "cn");
    expectEntries(f.sn * f.sn + f.cn * f.cn, 1, 1e-14, "sn^2 + cn^2");
    expectEntries(f.dn * f.dn + m * f.sn * f.sn, 1, 1e-14, "dn^2 + m sn^2");
  }
}

struct Top {
  Vec3 I;
  Quat q;
  Vec3 L;
};

// Every order of the moments and every direction of the spin: all sides of the separatrix.
Top randomTop(std::uint64_t seed) {
  Random random(seed);
  Vec3 I(1, random.in(1.05, 1.6), 0);
  I[2] = random.in(I[1] + 0.05, I[0] + I[1]);
  std::rotate(I.data(), I.data() + seed % 3, I.data() + 3);
  if (seed % 2 == 1) std::swap(I[0], I[1]);
  return {I, random.rotation(), random.vec(3)};
}

TEST(EllipticRotation, AgreesWithTheSeriesWhileThatLasts) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Top top = randomTop(seed);
    const Vec3 D = top.I.cwiseInverse();
    const auto closed = EllipticRotation::of(D, top.q, top.L);
    ASSERT_TRUE(closed);
    TriaxialRotation series;
    series.begin(D, top.q, top.L);
    for (double t = 0; t * top.L.norm() * D.maxCoeff() < 1; t += 0.1) {
      series.extendTo(t);
      expectEntries(closed->orientationAt(t).toRotationMatrix(), series.orientationAt(t).toRotationMatrix(), 1e-14,
                    "orientation");
    }
  }
}

// A long flight is as many flights, each from the end of the one before, all of them so short that their orientations
// and their derivatives are by series.
TEST(EllipticRotation, LongFlightsAreThoseOfManyShortOnes) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Top top = randomTop(seed);
    const Vec3 D = top.I.cwiseInverse();
    const double step = 0.25 / (top.L.norm() * D.maxCoeff());
    TriaxialRotation whole;
    whole.begin(D, top.q, top.L);
    whole.extendTo(240 * step);
    RotationSensitivity chain;
    Quat q = top.q;
    for (int i = 0; i < 240; ++i) {
      TriaxialRotation part;
      part.begin(D, q, top.L);
      part.extendTo(step);
      chain = chained(chain, part.sensitivityAt(step, true));
      q = part.orientationAt(step);
    }
    const Quat found = whole.orientationAt(240 * step);
    const RotationSensitivity S = whole.sensitivityAt(240 * step, true);
    const double size = chain.dtheta_dtheta.norm();
    expectEntries(found.toRotationMatrix(), q.toRotationMatrix(), 1e-14 * size, "orientation");
    expectEntries(S.dtheta_dtheta, chain.dtheta_dtheta, 1e-12, "dtheta/dtheta", size * size);
    expectEntries(S.dtheta_dL, chain.dtheta_dL, 1e-12, "dtheta/dL", size * (1 + chain.dtheta_dL.norm()));
    expectEntries(S.dtheta_dI, chain.dtheta_dI, 1e-12, "dtheta/dI", size * (1 + chain.dtheta_dI.norm()));
    expectEntries(S.dtheta_dproducts, chain.dtheta_dproducts, 1e-12, "dtheta/dproducts",
                  size * (1 + chain.dtheta_dproducts.norm()));
    worst = std::max(worst, size);
  }
  EXPECT_GT(worst, 20) << "flights that go over several periods";
}

TEST(EllipticRotation, APeriodTurnsAboutTheMomentum) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Top top = randomTop(seed);
    const auto closed = EllipticRotation::of(top.I.cwiseInverse(), top.q, top.L);
    ASSERT_TRUE(closed);
    const double angle = closed->period() * top.L.norm() / top.I.minCoeff();
    expectEntries(closed->orientationAt(closed->period()).conjugate() * top.L, top.q.conjugate() * top.L, 1e-14,
                  "R^T L", 1 + angle);
  }
}

// Where a number under a root or a modulus is singular there is none, and the series carry the flight.
TEST(EllipticRotation, ThereIsNoneWhereItIsSingular) {
  struct Case {
    const char* what;
    Vec3 I, M;
  };
  for (const Case& c :
       {Case{"at rest", {1, 2, 2.5}, {0, 0, 0}}, Case{"about the middle axis", {1, 2, 2.5}, {0, 3, 0}},
        Case{"about the least axis", {1, 2, 2.5}, {3, 0, 0}}, Case{"about the greatest axis", {1, 2, 2.5}, {0, 0, 3}},
        Case{"two equal moments", {1, 1, 1.5}, {1, 2, 3}}, Case{"three equal moments", {1, 1, 1}, {1, 2, 3}},
        Case{"on the separatrix", {1, 2, 3}, {std::sqrt(3.0), 1, 3}}}) {
    SCOPED_TRACE(c.what);
    const Vec3 L = c.M;  // R = 1: M is exact
    const auto closed = EllipticRotation::of(c.I.cwiseInverse(), Quat::Identity(), L);
    TriaxialRotation r;
    r.begin(c.I.cwiseInverse(), Quat::Identity(), L);
    r.extendTo(20);
    const Quat found = r.orientationAt(20);
    EXPECT_TRUE(found.coeffs().allFinite());
    const double energy = L.cwiseAbs2().dot(c.I.cwiseInverse());
    expectEntries((found.conjugate() * L).cwiseAbs2().dot(c.I.cwiseInverse()), energy, 1e-13, "energy", 1 + energy);
    if (std::string(c.what) != "on the separatrix") {
      EXPECT_FALSE(closed.has_value());
    }
  }
}

// As near to a principal axis as numbers go, a long flight has the derivatives of the flight about the axis itself.
TEST(EllipticRotation, DerivativesAtTheEdgeOfAPrincipalAxis) {
  const Vec3 I(1, 2, 2.5), D = I.cwiseInverse();
  for (const double off : {1e-12, 1e-17, 1e-25, 1e-60, 1e-140}) {
    SCOPED_TRACE("off the axis by " + std::to_string(std::log10(off)));
    RotationSensitivity S[2];
    for (const bool exact : {false, true}) {
      TriaxialRotation r;
      r.begin(D, Quat::Identity(), exact ? Vec3(3, 0, 0) : Vec3(3, 3 * off, 3 * off));
      r.extendTo(40);
      S[exact] = r.sensitivityAt(40, true);
    }
    expectEntries(S[0].dtheta_dtheta, S[1].dtheta_dtheta, 1e-10, "dtheta/dtheta");
    expectEntries(S[0].dtheta_dL, S[1].dtheta_dL, 1e-10, "dtheta/dL", 40);
    expectEntries(S[0].dtheta_dI, S[1].dtheta_dI, 1e-10, "dtheta/dI", 40);
    expectEntries(S[0].dtheta_dproducts, S[1].dtheta_dproducts, 1e-10, "dtheta/dproducts", 40);
  }
}

// The times that were asked for before do not matter, to the bit.
TEST(EllipticRotation, ReadingLateChangesNothingEarly) {
  const Top top = randomTop(7);
  TriaxialRotation early, late;
  early.begin(top.I.cwiseInverse(), top.q, top.L);
  late.begin(top.I.cwiseInverse(), top.q, top.L);
  late.extendTo(500);
  for (const double t : {0.01, 0.3, 0.9, 2.0, 7.0, 30.0}) {
    early.extendTo(t);
    EXPECT_EQ(early.orientationAt(t).coeffs(), late.orientationAt(t).coeffs()) << t;
  }
}

}  // namespace
}  // namespace carom
