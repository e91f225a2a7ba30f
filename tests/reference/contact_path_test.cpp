// SPDX-License-Identifier: MIT
// Closed forms of lasting contact against the equations of motion in 50 digits: states, and every column of the
// derivative against differences.

#include <gtest/gtest.h>

#include <random>

#include "adjoint/contact/path_sensitivity.hpp"
#include "tests/reference/contact_path.h"
#include "tests/reference/differences.h"
#include "tests/reference/worst.h"
#include "tests/support/compare.h"

namespace carom::reference::contact_path {
namespace {

using namespace adjoint_detail;
using test::expectEntries;

struct Case {
  std::string name;
  PathForm form;
  PathInputs<double> in;
  double t;
};

// On a slope that goes down along x; r = 0.1 m, a uniform ball unless k says otherwise.
PathInputs<double> onSlope(double angle, double friction, const Vec3& v, const Vec3& spin = Vec3::Zero(),
                           double k = 0.4) {
  PathInputs<double> in;
  in.gravity = {9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)};
  in.friction = friction;
  in.mass = 1.7;
  in.reach = 0.1;
  in.J *= k * in.mass * in.reach * in.reach;
  in.v = v;
  in.L = in.J * spin;
  in.R = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  return in;
}

Mat3 turnedFrame(const Vec3& by) { return Eigen::AngleAxisd(by.norm(), by.normalized()).toRotationMatrix(); }
PathInputs<double> turned(PathInputs<double> in, const Vec3& by) {
  const Mat3 Q = turnedFrame(by);
  in.gravity = Q * in.gravity, in.normal = Q * in.normal, in.v = Q * in.v, in.L = Q * in.L;
  return in;
}

std::vector<Case> cases() {
  const double deg = std::acos(-1.0) / 180;
  const PathForm ball = PathForm::glide_ball, block = PathForm::glide_block, roll = PathForm::roll_ball;
  const Vec3 spin(7, -20, 11), across(0, 2, 0);
  std::vector<Case> all = {
      {"block on a level floor", block, onSlope(0, 0.3, {1, 2, 0}), 0.4},
      {"block thrown across a slope", block, onSlope(20 * deg, 0.5, across), 0.7},
      {"block that never stops", block, onSlope(20 * deg, 0.2, across), 1.5},
      {"block, nu is 1 but for 1e-9", block, onSlope(20 * deg, std::tan(20 * deg) * (1 + 1e-9), across), 1.2},
      {"block, nu is 1/2", block, onSlope(20 * deg, 0.5 * std::tan(20 * deg), across), 0.9},
      {"block up a slope", block, onSlope(20 * deg, 0.2, {-2, 0, 0}), 0.3},
      {"block nearly straight up", block, onSlope(20 * deg, 0.2, {-2, 1e-3, 0}), 0.9},
      {"block without friction", block, onSlope(20 * deg, 0, across), 0.8},
      {"ball on a level floor", ball, onSlope(0, 0.3, {3, 0, 0}), 0.2},
      {"ball with spin on a level floor", ball, onSlope(0, 0.3, {3, 1, 0}, spin), 0.3},
      {"hollow ball with back-spin", ball, onSlope(0, 0.3, {2, 0, 0}, {0, -80, 3}, 2.0 / 3), 0.7},
      {"ball across a slope", ball, onSlope(10 * deg, 0.1, across), 0.5},
      {"ball across a slope with spin", ball, onSlope(10 * deg, 0.1, across, spin), 0.6},
      {"ball down a slope too steep to roll", ball, onSlope(50 * deg, 0.1, across, spin), 1},
      {"ball without friction", ball, onSlope(10 * deg, 0, across, spin), 1},
      {"ball without weight", ball, onSlope(0, 0.3, {1, 2, 0}, spin), 1},
      {"ball on a slope of 1e-9", ball, onSlope(1e-9, 0.2, across, spin), 0.4},
      {"ball rolls", roll, onSlope(10 * deg, 0.3, across, spin), 2},
      {"ball rolls on a level floor", roll, onSlope(0, 0.3, across, spin), 3},
  };
  all[15].in.gravity.setZero();
  for (std::size_t k = 0; k < all.size(); k += 2) all[k].in = turned(all[k].in, Vec3(0.4, -0.9, 0.3));
  return all;
}

void nudge(ContactPath& path, int input, const Real& by, const PathInputs<double>& in) {
  const int i = input % 3;
  Real* const numbers[] = {&path.friction, &path.mass, &path.inertia, &path.reach};
  RVec* const vectors[] = {&path.x, nullptr, &path.v, &path.momentum, &path.gravity};
  if (input >= 18) {
    *numbers[input - 18] += by;
  } else if (input >= 15) {
    path.normal = path.normal + by * cross(axisVector(i), RVec(in.normal));
  } else if (input / 3 == 1) {
    path.R = rotationBy(axisVector(i, by)) * path.R;
  } else {
    (*vectors[input / 3])[i] += by;
  }
}

// Columns of turns of the normal in place of those of the normal, one for the inertia, one for the radius.
Eigen::MatrixXd variations(const Eigen::Matrix<double, 12, 27>& J, const Vec3& normal) {
  Eigen::MatrixXd varied(12, 22);
  varied.leftCols(20) = J.leftCols(20);
  varied.middleCols(15, 3) = J.middleCols(15, 3) * -skew(normal);
  varied.col(20) = J.middleCols(20, 3).rowwise().sum();
  varied.col(21) = J.col(26);
  return varied;
}

Eigen::VectorXd between(const ContactPath& a, const ContactPath& b, const Real& over) {
  const Real scale = 1 / over;
  Eigen::VectorXd d(12);
  d << (scale * (b.x - a.x)).rounded(), (scale * rotationBetween(a.R, b.R)).rounded(), (scale * (b.v - a.v)).rounded(),
      (scale * (b.momentum - a.momentum)).rounded();
  return d;
}

void checkColumns(const Case& c, const ContactPath& start, const ContactPath& end, double t, int first = 0) {
  const Eigen::MatrixXd J = variations(pathSensitivity(c.form, c.in, c.t).J, c.in.normal);
  for (int input = first; input < 22; ++input) {
    if (c.in.friction == 0 && input == 18) continue;  // only one side is there
    ContactPath path = start;
    nudge(path, input, kNudge, c.in);
    path.advance(Real(t));
    const Eigen::VectorXd expected = between(end, path, kNudge);
    expectEntries(J.col(input), expected, kGradientTolerance, c.name + ", column " + std::to_string(input),
                  std::max(expected.norm(), kSmallestScale));
  }
}

void checkState(const Case& c, const ContactPath& end, double tolerance = kStateTolerance) {
  const PathState<double> state = pathStateAt(c.form, c.in, c.t);
  expectEntries(state.x, end.x.rounded(), tolerance, c.name + ", x");
  expectEntries(state.v, end.v.rounded(), tolerance, c.name + ", v");
  expectEntries(state.L, end.momentum.rounded(), tolerance, c.name + ", L");
  expectEntries(state.R, rounded(end.R), tolerance, c.name + ", R");
}

TEST(ContactPath, EqualsTheEquationsOfMotion) {
  for (const Case& c : cases()) {
    const ContactPath start(c.form, c.in);
    ContactPath end = start;
    end.advance(Real(c.t));
    checkState(c, end);
    checkColumns(c, start, end, c.t);
  }
}

// Close before the end of slip, where the 50 digits see no end yet; the derivative there is that at the end but for the
// time that is left and its logarithm.
TEST(ContactPath, EndsAsTheEquationsOfMotionDo) {
  const double deg = std::acos(-1.0) / 180, left = 1e-13;
  std::vector<Case> ends = {
      {"end on a level floor", PathForm::glide_ball, onSlope(0, 0.3, {3, 1, 0}, {7, -20, 11}), 0},
      {"end across a slope", PathForm::glide_ball, onSlope(10 * deg, 0.1, {0, 2, 0}, {7, -20, 11}), 0},
      {"block that stops on a slope", PathForm::glide_block, onSlope(20 * deg, 0.6, {1, 2, 0}), 0}};
  for (Case& c : ends) {
    c.t = *slipEnd(c.form, c.in);
    const ContactPath start(c.form, c.in);
    ContactPath end = start;
    end.advance(Real(c.t - left));
    checkState(c, end, 1e-12 + 20 * left);
    checkColumns(c, start, end, c.t - left, 6);
  }
}

// Where the slip has all but turned down the slope, and neither grows nor dies.
TEST(ContactPath, SlidesOnAlongALine) {
  const double angle = 0.5, friction = 2.0 / 7 * std::tan(angle) * (1 + 1e-8);
  const Case c{"long slide", PathForm::glide_ball, onSlope(angle, friction, {0.01, 0.2, 0}, {1, 2, 3}), 2};
  const ContactPath start(c.form, c.in);
  ContactPath end = start;
  end.advance(Real(c.t));
  checkState(c, end);
  checkColumns(c, start, end, c.t, 18);
}

TEST(ContactPath, RollsOverAThousandRadians) {
  const double deg = std::acos(-1.0) / 180;
  const Case c{"long roll", PathForm::roll_ball, onSlope(1 * deg, 0.3, {3, 4, 0}, {0, 0, 60}), 13};
  ContactPath end(c.form, c.in);
  end.advance(Real(c.t));
  checkState(c, end);
}

TEST(ContactPath, RandomOnesEqualTheEquationsOfMotion) {
  const unsigned seed = 20261123;
  std::printf("seed %u\n", seed);
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) {
    Vec3 v;
    for (double& entry : v) entry = size * unit(generator);
    return v;
  };
  for (int k = 0; k < 60; ++k) {
    Vec3 v = vector(2);
    v.z() = 0;
    const double angle = 0.4 * (1 + unit(generator)), friction = 0.5 * (1 + unit(generator));
    Case c{"random " + std::to_string(k), k % 3 == 0 ? PathForm::glide_block : PathForm::glide_ball,
           turned(onSlope(angle, friction, v, vector(30), 0.5 + 0.2 * unit(generator)), vector(3)), 0};
    if (k % 7 == 6) c.form = PathForm::roll_ball;
    const std::optional<double> end_of_slip = slipEnd(c.form, c.in);
    c.t = (end_of_slip ? *end_of_slip : 1) * (0.5 + 0.49 * unit(generator));
    const ContactPath start(c.form, c.in);
    ContactPath end = start;
    end.advance(Real(c.t));
    checkState(c, end);
    if (k < 12) checkColumns(c, start, end, c.t);
  }
}

}  // namespace
}  // namespace carom::reference::contact_path
