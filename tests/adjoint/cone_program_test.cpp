// SPDX-License-Identifier: MIT
// Friction of several contacts as a convex problem: the solution meets the conditions that only a solution meets, in
// doubles and in 32 digits, and does not depend on the order of contacts.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "adjoint/base/errors.h"
#include "adjoint/contact/cone_program.hpp"
#include "adjoint/contact/cone_terms.hpp"
#include "adjoint/numeric/so3.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Program = ConeProgramOf<double>;

// Rows of the velocities of contacts between bodies in a row, the first of which may be fixed; corners of faces when flat.
MatrixXd contactRows(int bodies, int contacts, bool flat, Random& random) {
  MatrixXd B = MatrixXd::Zero(3 * contacts, 6 * bodies);
  for (int k = 0; k < contacts; ++k) {
    const int a = k < bodies ? k : random.below(bodies), b = bodies > 1 ? random.below(bodies + 1) - 1 : -1;
    for (int body : {a, b}) {
      if (body < 0 || (body == b && a == b)) continue;
      const double sign = body == a ? 1 : -1;
      const Vec3 r = flat ? Vec3(k % 2 ? 1 : -1, k % 4 < 2 ? 0.5 : -0.5, -0.3) : random.vec(1);
      const double root = std::sqrt(1 / (1.0 + body));
      B.block<3, 3>(3 * k, 6 * body) = sign * root * Mat3::Identity();
      B.block<3, 3>(3 * k, 6 * body + 3) = -sign * root * skew(r) * Vec3(2, 1.5, 1.1).asDiagonal();
    }
  }
  return B;
}

// `equations`: some contacts keep their velocity along the normal; f = 0 is admissible.
Program randomProgram(std::uint64_t seed) {
  Random random(seed);
  const bool flat = seed % 3 == 0;
  const int bodies = flat ? 1 : 1 + random.below(6), contacts = flat ? 4 : 2 + random.below(11);
  const MatrixXd B = contactRows(bodies, contacts, flat, random);
  Program q;
  q.K = B * B.transpose();
  q.b = B * random.vector(B.cols());
  for (int k = 0; k < contacts; ++k) {
    q.normal.push_back(flat ? Vec3(0, 0, 1) : random.unit());
    const double mu = std::pow(10, random.in(-1.5, 0.5));
    q.friction.push_back(random.below(5) == 0 ? 0 : mu);
    q.offset.push_back(random.in(0, 1));
    q.free.push_back(random.below(12) == 0);
    if (seed % 2 == 0 || random.below(4) != 0) continue;
    q.equal.push_back(k);
    q.rise.push_back(0);
  }
  for (int k = 0; seed % 2 == 0 && k < contacts; ++k) q.equal.push_back(k), q.rise.push_back(0);
  return q;
}

// What a solution, and nothing else, meets: f in the cones, V in the dual cones, f + offset across V; the equations.
template <class T>
void expectSolved(const Program& q, const ConePointOf<T>& point, double tolerance) {
  ConeProgramOf<T> wide{q.K.cast<T>(), q.b.cast<T>(), {}, {}, {}, q.free, q.equal, {}};
  for (const Vec3& n : q.normal) wide.normal.push_back(n.cast<T>());
  for (double x : q.friction) wide.friction.push_back(T(x));
  for (double x : q.offset) wide.offset.push_back(T(x));
  for (double x : q.rise) wide.rise.push_back(T(x));
  const ConeTerms<T> t(wide, point);
  const auto number = [](const T& x) { return rounded(x); };
  const VectorXd f = t.f.unaryExpr(number), V = t.V.unaryExpr(number), Kf = t.Kf.unaryExpr(number);
  const double size = 1 + f.cwiseAbs().maxCoeff();
  EXPECT_TRUE(f.allFinite() && V.allFinite());
  for (int k = 0; k < q.contacts(); ++k) {
    const auto kk = static_cast<std::size_t>(k);
    const Vec3 n = q.normal[kk], f_k = f.segment<3>(3 * k), v = V.segment<3>(3 * k);
    const double P = n.dot(f_k) + q.offset[kk], side = (f_k - n.dot(f_k) * n).norm();
    if (q.free[kk]) {
      EXPECT_TRUE(side <= tolerance * size && std::abs(n.dot(v)) <= tolerance * size) << k;
      continue;
    }
    EXPECT_TRUE(P >= -tolerance * size && side <= q.friction[kk] * P + tolerance * size) << k << ": " << side << " of " << P;
    EXPECT_TRUE(n.dot(v) >= q.friction[kk] * (v - n.dot(v) * n).norm() - tolerance * size) << k;
    EXPECT_TRUE(std::abs((f_k + q.offset[kk] * n).dot(v)) <= tolerance * size * size) << k;
  }
  for (std::size_t e = 0; e < q.equal.size(); ++e) {
    const double rise = q.normal[static_cast<std::size_t>(q.equal[e])].dot(Kf.segment<3>(3 * q.equal[e]));
    EXPECT_TRUE(std::abs(rise - q.rise[e]) <= tolerance * size) << "equation " << e << ": " << rise;
  }
}

Program reversed(const Program& q) {
  Program r = q;
  const int n = q.contacts();
  for (int k = 0; k < n; ++k) {
    const int from = n - 1 - k;
    const auto kk = static_cast<std::size_t>(k), ff = static_cast<std::size_t>(from);
    for (int l = 0; l < n; ++l) r.K.block<3, 3>(3 * k, 3 * l) = q.K.block<3, 3>(3 * from, 3 * (n - 1 - l));
    r.b.segment<3>(3 * k) = q.b.segment<3>(3 * from);
    r.normal[kk] = q.normal[ff];
    r.friction[kk] = q.friction[ff];
    r.offset[kk] = q.offset[ff];
    r.free[kk] = q.free[ff];
  }
  const std::size_t equations = q.equal.size();
  for (std::size_t e = 0; e < equations; ++e) {
    r.equal[e] = n - 1 - q.equal[equations - 1 - e];
    r.rise[e] = q.rise[equations - 1 - e];
  }
  return r;
}

TEST(ConeProgram, MeetsTheConditionsInAnyOrder) {
  int solved = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 5000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Program q = randomProgram(seed), r = reversed(q);
    try {
      const auto there = solveConeProgram(q), back = solveConeProgram(r);
      expectSolved<double>(q, there, 1e-12);
      const VectorXd one = ConeTerms<double>(q, there).Kf, other = ConeTerms<double>(r, back).Kf;
      const double size = 1 + ConeTerms<double>(q, there).f.cwiseAbs().maxCoeff();  // large where contacts are wedged
      for (int k = 0; k < q.contacts(); ++k)
        expectEntries(other.segment<3>(3 * (q.contacts() - 1 - k)), one.segment<3>(3 * k), 1e-12, "K f", size);
      ++solved;
    } catch (const NotComputable& error) {
      std::printf("seed %d: %s\n", static_cast<int>(seed), error.what());
      ++refused;
    }
  }
  std::printf("%d programs solved, %d refused\n", solved, refused);
  EXPECT_EQ(refused, 0);
}

}  // namespace
}  // namespace carom
