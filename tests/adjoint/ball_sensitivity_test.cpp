// SPDX-License-Identifier: MIT
// Closed forms of how a ball that rolls or slides on a level face varies, beside the formulae of any path, which dual
// numbers differentiate. tests/reference holds both to the equations of motion in 50 digits.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/contact/ball_sensitivity.hpp"
#include "adjoint/contact/level_glide_turn.hpp"
#include "adjoint/contact/path_sensitivity.hpp"
#include "tests/support/compare.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using test::expectEntries;

PathInputs<double> onLevelFloor(test::Random& random, double spin) {
  PathInputs<double> in;
  in.x = random.vec(1);
  in.v = {random.in(-3, 3), random.in(-3, 3), 0};
  in.gravity = {0, 0, -9.81};
  in.friction = random.in(0.05, 0.8);
  in.mass = random.in(0.3, 3);
  in.reach = random.in(0.03, 0.3);
  in.J *= random.in(0.3, 0.66) * in.mass * in.reach * in.reach;
  in.L = in.J * random.vec(spin);
  in.R = random.rotation().toRotationMatrix();
  return in;
}

// The general formulae, in dual numbers without rates.
Eigen::Matrix<double, 12, 27> general(PathForm form, const PathInputs<double>& in, double t, bool orientation) {
  using D = Dual<4>;
  const PathInputs<D> duals{in.x.cast<D>(),       in.v.cast<D>(),      in.L.cast<D>(), in.R.cast<D>(),
                            in.gravity.cast<D>(), in.normal.cast<D>(), in.friction,    in.mass,
                            in.J.cast<D>(),       in.reach,            in.axis.cast<D>()};
  return valuesOf(pathSensitivity<D>(form, duals, D(t), orientation).J);
}

void check(PathForm form, const PathInputs<double>& in, double t, const std::string& name) {
  for (const bool orientation : {false, true}) {
    const auto closed = ballSensitivity(form, in, t, orientation);
    ASSERT_TRUE(closed.has_value()) << name;
    Eigen::Matrix<double, 12, 27> expected = general(form, in, t, orientation), found = *closed;
    for (auto* J : {&found, &expected})  // a normal turns, and keeps its length
      J->middleCols<3>(15) = (J->middleCols<3>(15) * skew(in.normal)).eval();
    for (int column = 0; column < 27; ++column)
      expectEntries(found.col(column), expected.col(column), 1e-11,
                    name + ", column " + std::to_string(column), 1 + expected.col(column).norm());
  }
}

TEST(BallSensitivity, SlidingEqualsTheGeneralFormulae) {
  test::Random random(7);
  for (int k = 0; k < test::scaled(60); ++k) {
    const PathInputs<double> in = onLevelFloor(random, k % 4 == 0 ? 0 : k % 4 == 3 ? 100 : 20);
    const double end = *slipEnd(PathForm::glide_ball, in);
    const double shares[] = {1e-4, 0.01, 0.3, 0.5, 0.9, 0.999, 1};
    const double share = shares[k % 7];
    check(PathForm::glide_ball, in, share == 1 ? end : share * end, "case " + std::to_string(k));
  }
}

TEST(BallSensitivity, RollingEqualsTheGeneralFormulae) {
  test::Random random(8);
  for (int k = 0; k < test::scaled(40); ++k) {
    PathInputs<double> in = onLevelFloor(random, 20);
    if (k % 2 == 0) in.gravity += Vec3(random.in(-2, 2), random.in(-2, 2), 0);
    check(PathForm::roll_ball, in, random.in(0, 2), "case " + std::to_string(k));
  }
}

TEST(BallSensitivity, LeavesOtherPathsToTheGeneralFormulae) {
  test::Random random(9);
  PathInputs<double> in = onLevelFloor(random, 20);
  EXPECT_TRUE(ballSensitivity(PathForm::glide_ball, in, 0.01, true));
  EXPECT_FALSE(ballSensitivity(PathForm::glide_block, in, 0.01, true));
  EXPECT_FALSE(ballSensitivity(PathForm::roll_axle, in, 0.01, true));
  PathInputs<double> slope = in, smooth = in;
  slope.gravity.x() = 1e-9;
  EXPECT_FALSE(ballSensitivity(PathForm::glide_ball, slope, 0.01, true));
  smooth.friction = 0;
  EXPECT_FALSE(ballSensitivity(PathForm::glide_ball, smooth, 0.01, true));
}

// Gauss's rule with five points on many pieces.
template <class F>
auto integral(const F& f, double from, double until, int pieces) {
  constexpr double kAt[] = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr double kWeight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double half = 0.5 * (until - from) / pieces;
  auto sum = decltype(f(from))(0 * f(from));
  for (int i = 0; i < pieces; ++i) {
    const double middle = from + (2 * i + 1) * half;
    sum += half * kWeight[0] * f(middle);
    for (int k = 1; k < 3; ++k) sum += half * kWeight[k] * (f(middle - half * kAt[k]) + f(middle + half * kAt[k]));
  }
  return sum;
}

TEST(LevelGlide, SharesOfTheSlip) {
  for (const double x : {1e-8, 1e-3, 0.049999, 0.05, 0.3, 0.9, 1.0}) {
    const double y = 1 - x, exact = x < 1 ? x + y * std::log1p(-x) : 1;
    expectEntries(bentSlip(x), exact, x < 1e-2 ? 1e-9 : 1e-14, "bent slip");
    if (x == 1) continue;  // which ends in a logarithm
    expectEntries(bentSlipIntegral(x), integral([](double z) { return bentSlip(z); }, 0, x, 400), 1e-12, "integral");
  }
  expectEntries(bentSlipIntegral(1), 0.25, 1e-15, "integral to the end");
  expectEntries(bentSlip(1e-8) / 1e-16, 0.5 + 1e-8 / 6, 1e-15, "small");
  expectEntries(bentSlipIntegral(1e-8) / 1e-24, 1.0 / 6 + 1e-8 / 24, 1e-15, "small, integral");
}

TEST(LevelGlide, IntegralsOfTheTurn) {
  const Vec3 a(1, -2, 4), b(-3, 30, 0), d(1, 0, 0);
  const double T = 0.7;
  for (const double t : {0.02, 0.35, 0.69, 0.7}) {
    const LevelGlideTurn turn(a, b, d, t, T);
    const auto E = [&](double at) { return LevelGlideTurn(a, b, d, at, T).E; };
    const std::string name = "until " + std::to_string(t);
    expectEntries(turn.M0, integral([&](double z) -> Mat3 { return E(z).transpose(); }, 0, t, 100), 1e-13, name);
    expectEntries(turn.M1, integral([&](double z) -> Mat3 { return E(z).transpose() * z; }, 0, t, 100), 1e-13, name);
    const auto bend = [&](double z) -> Vec3 { return E(z).transpose() * d * bentSlip(z / T); };
    expectEntries(turn.bend, integral(bend, 0, t, 200), 1e-8, name);
  }
}

}  // namespace
}  // namespace carom
