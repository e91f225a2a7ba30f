// SPDX-License-Identifier: MIT
// Closed forms of lasting contact: ground truths, what contact fixes, transposes, second derivatives, bounds and
// descents. tests/reference holds them to the equations of motion.

#include <gtest/gtest.h>

#include <random>

#include "adjoint/contact/path_sensitivity.hpp"
#include "tests/support/compare.h"
#include "tests/support/scaled.h"

namespace carom::contact_paths {

using namespace adjoint_detail;

namespace {

using test::expectEntries;

constexpr double kGravity = 9.81, kDegree = 0.017453292519943295;

// Down the slope is +x; r = 0.1 m and k = I/(m r^2).
PathInputs<double> onSlope(double angle, double friction, const Vec3& v, const Vec3& spin = Vec3::Zero(),
                           double k = 0.4) {
  PathInputs<double> in;
  in.gravity = {kGravity * std::sin(angle), 0, -kGravity * std::cos(angle)};
  in.friction = friction;
  in.reach = 0.1;
  in.J *= k * in.reach * in.reach;
  in.v = v;
  in.L = in.J * spin;
  return in;
}

struct End {
  double t;
  PathState<double> state;
};
End endOf(PathForm form, const PathInputs<double>& in) {
  const std::optional<double> t = slipEnd(form, in);
  return {t.value(), pathStateAtSlipEnd(form, in)};
}

TEST(ContactPaths, BlockStops) {
  const double v = 2, friction = 0.3;
  const End level = endOf(PathForm::glide_block, onSlope(0, friction, {v, 0, 0}));
  expectEntries(level.t, v / (friction * kGravity), 1e-13, "time");
  expectEntries(level.state.x, Vec3(v * v / (2 * friction * kGravity), 0, 0), 1e-13, "place");
  const End slope = endOf(PathForm::glide_block, onSlope(20 * kDegree, 0.5, {0, 2, 0}));
  expectEntries(slope.t, 0.92302283587126, 1e-13, "time on a slope");
  expectEntries(slope.state.x, Vec3(0.33595283780512, 0.50017598242841, 0), 1e-13, "place on a slope");
  EXPECT_TRUE(slope.state.v.isZero(0));
  EXPECT_TRUE(slope.state.L.isZero(0));
}

TEST(ContactPaths, BallRolls) {
  const End solid = endOf(PathForm::glide_ball, onSlope(0, 0.3, {3, 0, 0}));
  expectEntries(solid.t, 0.29124799767002, 1e-13, "time");
  expectEntries(solid.state.v, Vec3(15.0 / 7, 0, 0), 1e-14, "speed");
  expectEntries(solid.state.x, Vec3(0.74892342258004, 0, 0), 1e-13, "place");
  const End hollow = endOf(PathForm::glide_ball, onSlope(0, 0.3, {3, 0, 0}, Vec3::Zero(), 2.0 / 3));
  expectEntries(hollow.t, 0.40774719673802, 1e-13, "time, hollow");
  expectEntries(hollow.state.v, Vec3(9.0 / 5, 0, 0), 1e-14, "speed, hollow");
}

TEST(ContactPaths, BackSpinBringsABallBack) {
  const PathInputs<double> in = onSlope(0, 0.3, {2, 0, 0}, {0, -80, 0});
  const End end = endOf(PathForm::glide_ball, in);
  expectEntries(pathStateAt(PathForm::glide_ball, in, 0.67957866123004).v, Vec3::Zero(), 1e-13, "turns");
  expectEntries(end.t, 0.97082665890005, 1e-13, "rolls");
  expectEntries(end.state.v, Vec3(-6.0 / 7, 0, 0), 1e-14, "speed");
  PathInputs<double> rolls = in;
  rolls.x = end.state.x, rolls.v = end.state.v, rolls.L = end.state.L, rolls.R = end.state.R;
  const PathState<double> back = pathStateAt(PathForm::roll_ball, rolls, 1.61804443150009 - end.t);
  expectEntries(back.x, Vec3::Zero(), 1e-13, "is back");
  expectEntries(back.L, rolls.L, 1e-15, "keeps its spin");
}

TEST(ContactPaths, BallAcrossASlope) {
  const End end = endOf(PathForm::glide_ball, onSlope(10 * kDegree, 0.1, {0, 2, 0}));
  expectEntries(end.t, 0.79266482336523, 1e-13, "time");
  expectEntries(end.state.v, Vec3(0.96449679170406, 10.0 / 7, 0), 1e-13, "speed");
  expectEntries(end.state.x, Vec3(0.43930958238062, 1.31282260702663, 0), 1e-13, "place");
  const PathInputs<double> in = onSlope(10 * kDegree, 0.1, {1, 0, 0});
  const double share = kGravity * std::sin(10 * kDegree);
  expectEntries(pathRateAt(PathForm::roll_ball, in, 1.0).v, Vec3(share * 5 / 7, 0, 0), 1e-15, "rolls down");
  PathInputs<double> axle = in;
  axle.R = Eigen::AngleAxisd(30 * kDegree, Vec3::UnitZ()).toRotationMatrix();
  axle.axis = Vec3::UnitY();
  axle.J = Vec3(0.3, 0.5, 0.3).asDiagonal();
  axle.J *= 0.01;
  const Vec3 across = axle.R * Vec3::UnitX();
  expectEntries(pathRateAt(PathForm::roll_axle, axle, 1.0).v, across * (across.x() * share / 1.5), 1e-15, "cylinder");
  const PathState<double> state = pathStateAt(PathForm::roll_axle, axle, 1.0);
  const double way = across.dot(state.x);
  const Mat3 turn = Eigen::AngleAxisd(way / 0.1, axle.R * axle.axis).toRotationMatrix();
  expectEntries(state.R, turn * axle.R, 1e-13, "cylinder's turn");
  expectEntries(state.L, axle.R * axle.axis * (0.005 * across.dot(state.v) / 0.1), 1e-15, "cylinder's momentum");
}

TEST(ContactPaths, SlidesUpAndTurnsRound) {
  for (const double friction : {0.2, 0.35, std::tan(20 * kDegree), 0.6}) {
    const PathInputs<double> up = onSlope(20 * kDegree, friction, {-2, 0, 0});
    const double brake = kGravity * (std::sin(20 * kDegree) + friction * std::cos(20 * kDegree));
    const End end = endOf(PathForm::glide_block, up);
    expectEntries(end.t, 2 / brake, 1e-14, "time up");
    expectEntries(end.state.x, Vec3(-2 / brake, 0, 0), 1e-14, "way up");
    const PathSensitivity<double> at_end = pathSensitivity(PathForm::glide_block, up, end.t);
    EXPECT_TRUE(at_end.J.allFinite());
    if (friction > 0.36) continue;
    PathInputs<double> down = up;
    down.v.setZero();
    EXPECT_FALSE(slipEnd(PathForm::glide_block, down));
    const double drive = kGravity * (std::sin(20 * kDegree) - friction * std::cos(20 * kDegree));
    expectEntries(pathStateAt(PathForm::glide_block, down, 0.5).x, Vec3(drive / 8, 0, 0), 1e-14, "way down");
    expectEntries(slipDirectionAt(PathForm::glide_block, down, 0.0), Vec3::UnitX(), 1e-15, "direction");
  }
}

TEST(ContactPaths, NeverStopsWhereTheSlopeIsTooSteep) {
  EXPECT_FALSE(slipEnd(PathForm::glide_block, onSlope(20 * kDegree, 0.3, {0, 2, 0})));
  EXPECT_FALSE(slipEnd(PathForm::glide_block, onSlope(20 * kDegree, 0, {-2, 0, 0})) &&
               slipEnd(PathForm::glide_block, onSlope(20 * kDegree, 0, {0, 2, 0})));
  EXPECT_FALSE(slipEnd(PathForm::roll_ball, onSlope(0, 0.3, {1, 0, 0})));
  PathInputs<double> weightless = onSlope(0, 0.3, {1, 2, 0}, {3, 4, 5});
  weightless.gravity.setZero();
  EXPECT_FALSE(slipEnd(PathForm::glide_ball, weightless));
  const PathState<double> state = pathStateAt(PathForm::glide_ball, weightless, 3.0);
  expectEntries(state.x, weightless.v * 3, 1e-15, "weightless");
  expectEntries(state.L, weightless.L, 0, "weightless spin");
  const PathInputs<double> smooth = onSlope(20 * kDegree, 0, {0, 2, 0}, {3, 4, 5});
  const Vec3 slope = alongFace(smooth.normal, smooth.gravity);
  expectEntries(pathStateAt(PathForm::glide_ball, smooth, 3.0).x, smooth.v * 3 + slope * 4.5, 1e-14, "no friction");
}

// The clock of a slip that begins with next to nothing covers many orders of magnitude.
TEST(ContactPaths, SlipGrowsFromNextToNothing) {
  const double angle = 0.67, friction = 0.18, v = 1e-4, t = 1.5;
  const double rate = kGravity * (std::sin(angle) - friction * std::cos(angle) * 3.5);
  const PathInputs<double> in = onSlope(angle, friction, {v, 1e-14, 0});
  expectEntries(slipDirectionAt(PathForm::glide_ball, in, t), Vec3::UnitX(), 1e-9, "direction");
  const Vec3 push = alongFace(in.normal, in.gravity) - Vec3(friction * kGravity * std::cos(angle), 0, 0);
  expectEntries(pathCenterAt(PathForm::glide_ball, in, t).v, Vec3(v, 0, 0) + push * t, 1e-12, "speed");
  EXPECT_GT(rate, 0);
  EXPECT_TRUE(pathSensitivity(PathForm::glide_ball, in, t).J.allFinite());
}

TEST(ContactPaths, ContactFixesExactly) {
  const PathInputs<double> in = onSlope(20 * kDegree, 0.5, {1, 2, 0}, {3, 4, 5});
  Eigen::Matrix<double, 12, 27> expected = Eigen::Matrix<double, 12, 27>::Zero();
  expected.topLeftCorner<6, 6>().setIdentity();
  expectEntries(pathSensitivity(PathForm::rest, in, 3.0).J, expected, 0, "rest");
  const auto block = pathSensitivity(PathForm::glide_block, in, 0.3).J;
  EXPECT_TRUE((block.middleRows<3>(3) == expected.middleRows<3>(3)));
  EXPECT_TRUE(block.bottomRows<3>().isZero(0));
  EXPECT_TRUE((block.leftCols<6>() == expected.leftCols<6>()));
  for (const PathForm form : {PathForm::glide_ball, PathForm::roll_ball, PathForm::roll_axle}) {
    PathInputs<double> ball = in;
    ball.axis = Vec3::UnitX();
    const auto J = pathSensitivity(form, ball, 0.2).J;
    EXPECT_TRUE(J.allFinite());
    EXPECT_TRUE((J.leftCols<3>() == expected.leftCols<3>()));
    if (form == PathForm::roll_axle) continue;
    EXPECT_TRUE(J.middleCols<3>(3).topRows<3>().isZero(0));
    EXPECT_TRUE(J.middleCols<3>(3).bottomRows<6>().isZero(0));
    EXPECT_TRUE(J.middleCols<3>(23).isZero(0));
  }
}

class ContactPathsAtRandom : public ::testing::Test {
 protected:
  ContactPathsAtRandom() { std::printf("seed %u\n", kSeed); }
  double number() { return unit_(generator_); }
  Vec3 vector(double size) {
    Vec3 v;
    for (double& entry : v) entry = size * number();
    return v;
  }
  PathInputs<double> slope(double steepest = 0.8) {
    return onSlope(steepest * std::abs(number()), std::abs(number()), {2 * number(), 2 * number(), 0}, vector(30),
                   0.5 + 0.2 * number());
  }
  template <class S>
  V3<S> vectorOf() {
    V3<S> v;
    for (int i = 0; i < 3; ++i) v[i] = numberOf<S>();
    return v;
  }
  template <class S>
  S numberOf() {
    S s = number();
    if constexpr (kOrderOf<S> > 0)
      for (double& rate : s.rate) rate = number();
    return s;
  }
  template <class S>
  StateDerivativeOf<S> stateDerivative() {
    return {vectorOf<S>(), vectorOf<S>(), vectorOf<S>(), vectorOf<S>()};
  }

 private:
  static constexpr unsigned kSeed = 1515;
  std::mt19937_64 generator_{kSeed};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

constexpr PathForm kForms[] = {PathForm::rest, PathForm::glide_ball, PathForm::glide_block, PathForm::roll_ball,
                               PathForm::roll_axle};

template <class S>
S inputsDot(const PathInputsDerivative<S>& a, const PathInputsDerivative<S>& b) {
  return a.gravity.dot(b.gravity) + a.normal.dot(b.normal) + a.friction * b.friction + a.mass * b.mass +
         a.inertia.dot(b.inertia) + a.products.dot(b.products) + a.reach * b.reach;
}

TEST_F(ContactPathsAtRandom, TangentAndPullbackAreTransposes) {
  for (int k = 0; k < 100; ++k) {
    PathInputs<double> in = slope();
    in.axis = Vec3::UnitX();
    const auto J = pathSensitivity(kForms[k % 5], in, 0.1);
    const auto dstart = stateDerivative<double>(), bar = stateDerivative<double>();
    const PathInputsDerivative<double> d{vector(1), vector(1), number(), number(), vector(1), vector(1), number()};
    PathInputsDerivative<double> inputs_bar;
    const StateDerivative start_bar = pullback(J, bar, inputs_bar);
    const double forward = bar.dot(tangent(J, dstart, d)), backward = start_bar.dot(dstart) + inputsDot(inputs_bar, d);
    expectEntries(forward, backward, 1e-13, "dot product " + std::to_string(k), J.J.norm());
  }
}

// Moves input `input` of PathSensitivity; of turns, the ones about the world's axes.
template <class S>
void move(PathInputs<S>& in, int input, const S& by) {
  const int i = input % 3, j = (input - 22) % 3, k = (input - 21) % 3;
  V3<S>* const vectors[] = {&in.x, nullptr, &in.v, &in.L, &in.gravity, &in.normal};
  if (input >= 3 && input < 6) {
    in.R = turnBy<S>(V3<S>(V3<S>::Unit(i) * by)) * in.R;
  } else if (input < 18) {
    (*vectors[input / 3])[i] += by;
  } else if (input < 20) {
    (input == 18 ? in.friction : in.mass) += by;
  } else if (input < 23) {
    in.J(input - 20, input - 20) += by;
  } else if (input < 26) {
    in.J(j, k) += by;
    in.J(k, j) += by;
  } else {
    in.reach += by;
  }
}

PathInputs<Dual<4>> inDuals(const PathInputs<double>& in) {
  return {in.x.cast<Dual<4>>(),      in.v.cast<Dual<4>>(), in.L.cast<Dual<4>>(), in.R.cast<Dual<4>>(),
          in.gravity.cast<Dual<4>>(), in.normal.cast<Dual<4>>(), in.friction,     in.mass,
          in.J.cast<Dual<4>>(),      in.reach,             in.axis.cast<Dual<4>>()};
}

using Matrix = Eigen::Matrix<double, 12, 27>;

// Rates of the sensitivity along every input, by duals; at the end of slip with the end.
std::vector<Matrix> secondDerivatives(PathForm form, const PathInputs<double>& in, double t, bool at_end) {
  std::vector<Matrix> all(27);
  for (int first = 0; first < 27; first += 4) {
    PathInputs<Dual<4>> duals = inDuals(in);
    for (int lane = 0; lane < 4 && first + lane < 27; ++lane) {
      Dual<4> along = 0;
      along.rate[static_cast<std::size_t>(lane)] = 1;
      move(duals, first + lane, along);
    }
    const Dual<4> time = at_end ? *slipEnd(form, duals) : Dual<4>(t);
    const PathSensitivity<Dual<4>> J = pathSensitivity(form, duals, time);
    for (int lane = 0; lane < 4 && first + lane < 27; ++lane)
      all[static_cast<std::size_t>(first + lane)] = ratesOf(J.J, static_cast<std::size_t>(lane));
  }
  return all;
}

void checkSecond(PathForm form, const PathInputs<double>& in, double t, bool at_end, const std::string& name) {
  const std::vector<Matrix> second = secondDerivatives(form, in, t, at_end);
  const double h = 1e-5;
  for (int input = 0; input < 27; ++input) {
    const double scale = (input >= 9 && input < 12) || (input >= 20 && input < 26) ? 1e-3 : 1;
    const auto at = [&](double by) {
      PathInputs<double> moved = in;
      move(moved, input, by * scale);
      return pathSensitivity(form, moved, at_end ? *slipEnd(form, moved) : t).J;
    };
    const Matrix expected = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h * scale);
    const Matrix& found = second[static_cast<std::size_t>(input)];
    expectEntries(found, expected, 1e-6, name + ", along " + std::to_string(input), 1 + expected.norm());
    if (at_end) continue;
    for (int other = 0; other < 27; ++other) {  // turns do not commute
      if (input / 3 == 1 || other / 3 == 1) continue;
      const Eigen::VectorXd a = found.col(other), b = second[static_cast<std::size_t>(other)].col(input);
      for (const int row : {0, 6, 9})
        expectEntries(a.segment<3>(row), b.segment<3>(row), 1e-10, name + ", symmetry", 1 + found.norm());
    }
  }
}

TEST_F(ContactPathsAtRandom, SecondDerivativesAreRatesOfTheFirst) {
  for (int k = 0; k < 15; ++k) {
    PathInputs<double> in = slope(k % 3 == 0 ? 0.0 : 0.5);
    in.axis = Vec3::UnitX();
    in.friction = 0.3 + std::abs(number());
    in.v += Vec3(2, 0, 0);
    const PathForm form = kForms[k % 5];
    checkSecond(form, in, 0.05, false, "case " + std::to_string(k));
    // On a level floor the direction of the last of the slip jumps as the floor tilts.
    if (form == PathForm::glide_ball && k % 3 != 0 && slipEnd(form, in))
      checkSecond(form, in, 0, true, "end " + std::to_string(k));
  }
}

TEST_F(ContactPathsAtRandom, BoundsHold) {
  for (int k = 0; k < test::scaled(200); ++k) {
    PathInputs<double> in = slope();
    in.axis = Vec3::UnitX();
    const PathForm form = kForms[k % 5];
    const double last = slipEnd(form, in).value_or(2), from = last * 0.2 * (1 + number()), until = from + 0.5 * last;
    const TrajectoryBounds bounds = pathBounds(form, in, from, until);
    for (int i = 0; i <= 20; ++i) {
      const double t = std::min(until, from + (until - from) * i / 20);
      const StateDerivative rate = pathRateAt(form, in, t);
      EXPECT_LE((rate.v - bounds.acceleration).norm(), bounds.variation + 1e-12);
      EXPECT_LE(rate.theta.norm(), bounds.spin * (1 + 1e-12) + 1e-12);
      EXPECT_TRUE(!bounds.straight || bounds.variation == 0);
    }
  }
}

TEST_F(ContactPathsAtRandom, FirstDescentIsWhereASearchFindsIt) {
  int found = 0;
  for (int k = 0; k < test::scaled(1000); ++k) {
    const PathInputs<double> in = slope(0.6);
    const PathForm form = k % 2 ? PathForm::glide_ball : k % 4 ? PathForm::glide_block : PathForm::roll_ball;
    const double end = slipEnd(form, in).value_or(1.5), until = end * (1 - 1e-3 * std::abs(number()));
    const Vec3 weight(number(), number(), 0);
    const double ahead = form == PathForm::glide_block ? 0.1 * number() : 0, value = 0.1 * number();
    const auto height = [&](double t) {
      const Vec3 direction = glides(form) ? slipDirectionAt(form, in, t) : Vec3::Zero().eval();
      return weight.dot(pathCenterAt(form, in, t).x) + ahead * weight.dot(direction) - value;
    };
    double before = 0, after = 0;
    constexpr int kSteps = 2000;
    for (int i = 1; i <= kSteps && after == 0; ++i)
      if (height(until * (i - 1) / kSteps) > 0 && height(until * i / kSteps) <= 0)
        before = until * (i - 1) / kSteps, after = until * i / kSteps;
    const std::optional<double> descent = firstDescent(form, in, weight, ahead, value, until);
    ASSERT_EQ(descent.has_value(), after > 0) << k;
    if (!descent) continue;
    ++found;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (before + after);
      (height(middle) > 0 ? before : after) = middle;
    }
    expectEntries(*descent, after, 1e-12, "descent " + std::to_string(k));
  }
  EXPECT_GT(found, test::scaled(1000) / 10);
}

}  // namespace
}  // namespace carom::contact_paths
