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
#include "tests/support/scaled.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Program = ConeProgramOf<double>;

// Rows of the velocities of contacts between bodies in a row, the first of which may be fixed; corners of faces when flat.
template <class T>
MatrixOf<T> contactRows(int bodies, int contacts, bool flat, Random& random) {
  MatrixOf<T> B = MatrixOf<T>::Zero(3 * contacts, 6 * bodies);
  const V3<T> moments(T(2), T(1.5), T(1.1));
  for (int k = 0; k < contacts; ++k) {
    const int a = k < bodies ? k : random.below(bodies), b = bodies > 1 ? random.below(bodies + 1) - 1 : -1;
    for (int body : {a, b}) {
      if (body < 0 || (body == b && a == b)) continue;
      const Vec3 r = flat ? Vec3(k % 2 ? 1 : -1, k % 4 < 2 ? 0.5 : -0.5, -0.3) : random.vec(1);
      const T root = T((body == a ? 1 : -1) * std::sqrt(1 / (1.0 + body)));
      const Mat3 one = Mat3::Identity(), arm = skew(r);
      B.template block<3, 3>(3 * k, 6 * body) = root * one.template cast<T>();
      B.template block<3, 3>(3 * k, 6 * body + 3) = -root * (arm.template cast<T>() * moments.asDiagonal());
    }
  }
  return B;
}

// Some contacts, or all, keep their velocity along the normal; f = 0 is admissible.
template <class T = double>
ConeProgramOf<T> randomProgram(std::uint64_t seed) {
  Random random(seed);
  const bool flat = seed % 3 == 0;
  const int bodies = flat ? 1 : 1 + random.below(6), contacts = flat ? 4 : 2 + random.below(11);
  const MatrixOf<T> B = contactRows<T>(bodies, contacts, flat, random);
  ConeProgramOf<T> q;
  q.K = B * B.transpose();
  q.b = B * random.vector(B.cols()).template cast<T>();
  for (int k = 0; k < contacts; ++k) {
    q.normal.push_back((flat ? Vec3(0, 0, 1) : random.unit()).template cast<T>());
    const double mu = std::pow(10, random.in(-1.5, 0.5));
    q.friction.push_back(T(random.below(5) == 0 ? 0 : mu));
    q.offset.push_back(T(random.in(0, 1)));
    q.free.push_back(random.below(12) == 0);
    if (seed % 2 == 0 || random.below(4) != 0) continue;
    q.equal.push_back(k);
    q.rise.push_back(T(0));
  }
  for (int k = 0; seed % 2 == 0 && k < contacts; ++k) q.equal.push_back(k), q.rise.push_back(T(0));
  return q;
}

// What a solution, and nothing else, meets: f in the cones, V in the dual cones, f + offset across V; the equations.
template <class T>
void expectSolved(const Program& q, const ConeProgramOf<T>& program, const ConePointOf<T>& point, double tolerance) {
  const ConeTerms<T> t(program, point);
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
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(3000)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Program q = randomProgram(seed), r = reversed(q);
    try {
      const auto there = solveConeProgram(q), back = solveConeProgram(r);
      expectSolved<double>(q, q, there, 1e-12);
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

TEST(ConeProgram, IsSolvedIn32Digits) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Program q = randomProgram(seed);
    const ConeProgramOf<DoubleDouble> wide = randomProgram<DoubleDouble>(seed);
    const ConePointOf<DoubleDouble> point = solveConeProgram(wide);
    expectSolved<DoubleDouble>(q, wide, point, 1e-15);
    const ConeTerms<DoubleDouble> t(wide, point);
    double worst = 0, size = 1;
    for (Index i = 0; i < t.residual.size(); ++i) worst = std::max(worst, std::abs(rounded(t.residual[i])));
    for (Index i = 0; i < t.f.size(); ++i) size = std::max(size, std::abs(rounded(t.f[i])));
    EXPECT_TRUE(worst <= 1e-26 * size) << worst << " of " << size;
    const VectorXd there = ConeTerms<double>(q, solveConeProgram(q)).Kf;
    expectEntries(t.Kf.unaryExpr([](const DoubleDouble& x) { return rounded(x); }), there, 1e-12, "K f", size);
  }
}

// Two contacts of which either could carry the load share it.
TEST(ConeProgram, RedundantContactsShareTheLoad) {
  Program q;
  q.K.resize(6, 6);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) q.K(i, j) = i % 3 == j % 3;
  q.b.resize(6);
  q.b << 0.1, 0, -1, 0.1, 0, -1;
  q.normal.assign(2, Vec3::UnitZ());
  q.friction = {0.5, 0.5};
  q.offset = {0, 0};
  q.free = {0, 0};
  const auto point = solveConeProgram(q);
  const VectorXd f = ConeTerms<double>(q, point).f;
  for (int k = 0; k < 2; ++k) expectEntries(f.segment<3>(3 * k), Vec3(-0.05, 0, 0.5), 1e-14, "f");
}

TEST(ConeProgram, SaysWhereItHasNoAnswer) {
  Program q = randomProgram(3);
  q.b[1] = std::nan("");
  EXPECT_THROW(solveConeProgram(q), NotComputable);
  q = randomProgram(4);
  q.K *= INFINITY;
  EXPECT_THROW(solveConeProgram(q), NotComputable);
}

}  // namespace
}  // namespace carom
