// SPDX-License-Identifier: MIT
// Impacts of several contacts (equation 4.4) in 50 digits: normal impulses by trying every set of contacts, friction by
// Newton's method on its conditions, with the active set that the product found, and verified. Derivatives are
// differences, which in 50 digits have 15.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/impact/impact_pass.hpp"
#include "tests/reference/real.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom::reference {

using namespace adjoint_detail;
using test::expectEntries;
using test::Random;

namespace {

using Numbers = std::vector<Real>;
using Eigen::VectorXd;

struct RealProblem {
  std::size_t n = 0;
  std::vector<Numbers> K;  // rows
  Numbers u;
  std::vector<RVec> normal;
  Numbers e, mu, e_t;

  RVec at(const Numbers& all, std::size_t k) const { return {all[3 * k], all[3 * k + 1], all[3 * k + 2]}; }
  Numbers gain(const Numbers& P) const {
    Numbers out(3 * n);
    for (std::size_t i = 0; i < 3 * n; ++i)
      for (std::size_t j = 0; j < 3 * n; ++j) out[i] += K[i][j] * P[j];
    return out;
  }
};

// The problem moved by h along d.
RealProblem moved(const ImpactProblem& p, const ImpactProblemDerivative& d, const Real& h) {
  RealProblem q;
  q.n = p.normal.size();
  const auto size = static_cast<Eigen::Index>(3 * q.n);
  for (Eigen::Index i = 0; i < size; ++i) {
    q.u.push_back(Real(p.u[i]) + h * Real(d.u[i]));
    q.K.emplace_back();
    for (Eigen::Index j = 0; j < size; ++j) q.K.back().push_back(Real(p.K(i, j)) + h * Real(d.K(i, j)));
  }
  for (std::size_t k = 0; k < q.n; ++k) {
    q.normal.push_back(RVec(p.normal[k]) + h * RVec(d.normal[k]));
    q.e.push_back(Real(p.pair[k].elasticity) + h * Real(d.pair[k].elasticity));
    q.mu.push_back(Real(p.pair[k].friction) + h * Real(d.pair[k].friction));
    q.e_t.push_back(Real(p.pair[k].tangential_elasticity) + h * Real(d.pair[k].tangential_elasticity));
  }
  return q;
}

// x with A x = b, by elimination with pivots.
Numbers eliminated(std::vector<Numbers> A, Numbers b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (abs(A[r][c]) > abs(A[pivot][c])) pivot = r;
    std::swap(A[c], A[pivot]), std::swap(b[c], b[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const Real f = A[r][c] / A[c][c];
      for (std::size_t j = c; j < n; ++j) A[r][j] -= f * A[c][j];
      b[r] -= f * b[c];
    }
  }
  for (std::size_t c = 0; c < n; ++c) b[c] /= A[c][c];
  return b;
}

// The set of contacts whose normal impulses push and whose others part: only one does.
struct NormalImpulses {
  std::vector<char> active;
  Numbers P;

  explicit NormalImpulses(const RealProblem& q) {
    for (std::size_t set = 0; set < (std::size_t{1} << q.n); ++set)
      if (solve(q, set)) return;
    throw std::runtime_error("no set of contacts has normal impulses");
  }

 private:
  bool solve(const RealProblem& q, std::size_t set) {
    std::vector<std::size_t> list;
    active.assign(q.n, 0);
    for (std::size_t k = 0; k < q.n; ++k)
      if (set >> k & 1) list.push_back(k), active[k] = 1;
    std::vector<Numbers> A(list.size(), Numbers(list.size()));
    Numbers b(list.size());
    for (std::size_t j = 0; j < list.size(); ++j) {
      P.assign(3 * q.n, 0);
      for (std::size_t i = 0; i < 3; ++i) P[3 * list[j] + i] = q.normal[list[j]][static_cast<int>(i)];
      const Numbers gain = q.gain(P);
      for (std::size_t i = 0; i < list.size(); ++i) A[i][j] = dot(q.normal[list[i]], q.at(gain, list[i]));
      b[j] = -(1 + q.e[list[j]]) * dot(q.normal[list[j]], q.at(q.u, list[j]));
    }
    const Numbers y = eliminated(A, b);
    P.assign(3 * q.n, 0);
    for (std::size_t j = 0; j < list.size(); ++j) {
      if (!(y[j] > 0)) return false;
      for (std::size_t i = 0; i < 3; ++i) P[3 * list[j] + i] = y[j] * q.normal[list[j]][static_cast<int>(i)];
    }
    const Numbers gain = q.gain(P);
    for (std::size_t k = 0; k < q.n; ++k)
      if (!active[k] && !(dot(q.normal[k], (1 + q.e[k]) * q.at(q.u, k) + q.at(gain, k)) >= 0)) return false;
    return true;
  }
};

/// What each contact does: nothing, not even with an impulse that it had; slides; sticks; or takes no part.
enum class Part { out, apex, slides, sticks };

// X and what goes with it: of a contact that slides s >= 0 with V = -s (t - mu n) and |P_t| = mu P_n; of one that sticks
// V = 0; at the apex P = 0. V = kappa b + K (X - sum lambda n).
class Friction {
 public:
  Friction(const RealProblem& q, const NormalImpulses& normal, std::vector<Part> states, const Numbers& start)
      : q_(q), normal_(normal), states_(std::move(states)) {
    const Numbers gain = q_.gain(normal_.P);
    for (std::size_t i = 0; i < 3 * q_.n; ++i) b_.push_back(q_.u[i] + gain[i]);
    kappa_ = 2;
    bool joins = false;
    for (std::size_t k = 0; k < q_.n; ++k) {
      if (normal_.active[k] && q_.mu[k] > 0) kappa_ = std::min(kappa_, 1 + q_.e_t[k]);
      joins = joins || (!normal_.active[k] && states_[k] != Part::out);
    }
    if (joins) kappa_ = std::min(kappa_, Real(1));
    unknowns_ = start;  // X, then lambda and s of every contact
    unknowns_.resize(5 * q_.n);
    for (std::size_t k = 0; k < q_.n; ++k) unknowns_[4 * q_.n + k] = norm(q_.at(q_.u, k));
    for (int step = 0; step < 40; ++step) newton();
  }

  Numbers impulses() const {
    Numbers P = normal_.P;
    for (std::size_t i = 0; i < P.size(); ++i) P[i] += unknowns_[i];
    return P;
  }
  // 0 for a solution of the convex problem.
  Real violation() const {
    Real worst = 0;
    for (const Real& r : residual(unknowns_)) worst = std::max<Real>(worst, abs(r));
    for (std::size_t k = 0; k < q_.n; ++k) {
      const RVec P = q_.at(impulses(), k), V = q_.at(velocities(unknowns_), k), n = q_.normal[k];
      if (states_[k] == Part::slides && q_.mu[k] > 0) worst = std::max<Real>(worst, -unknowns_[4 * q_.n + k]);
      if (states_[k] == Part::sticks) worst = std::max<Real>(worst, norm(P - dot(n, P) * n) - q_.mu[k] * dot(n, P));
      if (states_[k] == Part::apex)
        worst = std::max<Real>(worst, q_.mu[k] * norm(V - dot(n, V) * n) - dot(n, V));
    }
    return worst;
  }

 private:
  Numbers velocities(const Numbers& x) const {
    Numbers f(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(3 * q_.n));
    for (std::size_t k = 0; k < q_.n; ++k)
      for (std::size_t i = 0; i < 3; ++i) f[3 * k + i] -= x[3 * q_.n + k] * q_.normal[k][static_cast<int>(i)];
    Numbers V = q_.gain(f);
    for (std::size_t i = 0; i < V.size(); ++i) V[i] += kappa_ * b_[i];
    return V;
  }
  Numbers residual(const Numbers& x) const {
    const Numbers V = velocities(x), gain = q_.gain(Numbers(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(3 * q_.n)));
    Numbers r(5 * q_.n);
    for (std::size_t k = 0; k < q_.n; ++k) {
      const RVec n = q_.normal[k], X = q_.at(x, k), P = X + q_.at(normal_.P, k), v = q_.at(V, k);
      const RVec P_t = P - dot(n, P) * n;
      const Real s = x[4 * q_.n + k], lambda = x[3 * q_.n + k];
      RVec three = X;
      if (states_[k] == Part::apex) three = P;
      if (states_[k] == Part::sticks) three = v;
      if (states_[k] == Part::slides && q_.mu[k] > 0) three = q_.mu[k] * dot(n, P) * v + s * (P_t - q_.mu[k] * q_.mu[k] * dot(n, P) * n);
      if (states_[k] == Part::slides && !(q_.mu[k] > 0)) three = P_t + dot(n, v) * n;
      for (std::size_t i = 0; i < 3; ++i) r[3 * k + i] = three[static_cast<int>(i)];
      const Real rise = normal_.active[k] ? Real(0) : Real(-q_.e[k] * dot(n, q_.at(q_.u, k)) - dot(n, q_.at(b_, k)));
      r[3 * q_.n + k] = states_[k] == Part::out ? lambda : Real(dot(n, q_.at(gain, k)) - rise);
      const bool rubs = states_[k] == Part::slides && q_.mu[k] > 0;
      const Real P_n = dot(n, P);
      r[4 * q_.n + k] = rubs ? Real(dot(P_t, P_t) - q_.mu[k] * q_.mu[k] * P_n * P_n) : s;
    }
    return r;
  }
  // With differences of 1e-25 for the matrix: 25 digits of it, so that steps gain 20 digits each.
  void newton() {
    const Numbers now = residual(unknowns_);
    const std::size_t n = unknowns_.size();
    std::vector<Numbers> A(n, Numbers(n));
    const Real h("1e-25");
    for (std::size_t j = 0; j < n; ++j) {
      Numbers x = unknowns_;
      x[j] += h;
      const Numbers r = residual(x);
      for (std::size_t i = 0; i < n; ++i) A[i][j] = (r[i] - now[i]) / h;
    }
    const Numbers step = eliminated(A, now);
    for (std::size_t j = 0; j < n; ++j) unknowns_[j] -= step[j];
  }

  const RealProblem& q_;
  const NormalImpulses& normal_;
  std::vector<Part> states_;
  Numbers b_, unknowns_;
  Real kappa_;
};

struct Solved {
  Numbers P;
  Real violation;
};

// With the active set of the product's solution, and its X to start from.
Solved solved(const RealProblem& q, const ImpactSolution& s) {
  const NormalImpulses normal(q);
  std::vector<Part> states;
  Numbers X;
  for (std::size_t k = 0; k < q.n; ++k) {
    const bool off = s.outcome[k] == ContactOutcome::off;
    states.push_back(off ? (normal.active[k] ? Part::apex : Part::out)
                         : s.outcome[k] == ContactOutcome::sticks ? Part::sticks : Part::slides);
  }
  for (std::size_t i = 0; i < 3 * q.n; ++i) X.push_back(Real(s.P[static_cast<Eigen::Index>(i)]) - normal.P[i]);
  const Friction friction(q, normal, states, X);
  return {friction.impulses(), friction.violation()};
}

VectorXd rounded(const Numbers& numbers) {
  VectorXd out(static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) out[static_cast<Eigen::Index>(i)] = static_cast<double>(numbers[i]);
  return out;
}

ImpactProblem randomProblem(Random& random) {
  ImpactProblem p;
  const int n = 2 + random.below(3);
  const Eigen::MatrixXd B = random.vector(9 * n * (n + 1)).reshaped(3 * n, 3 * n + 3);
  p.K = B * B.transpose();
  p.u = B * random.vector(3 * n + 3);
  const bool slippery = random.below(4) == 0;
  for (int k = 0; k < n; ++k) {
    Vec3 normal = random.unit();
    if (normal.dot(p.u.segment<3>(3 * k)) > 0) normal = -normal;
    p.normal.push_back(normal);
    p.pair.push_back({random.in(0, 1), k == 1 && slippery ? 0 : random.in(0.05, 1), random.in(-0.8, 0.8)});
  }
  return p;
}

ImpactProblemDerivative randomDirection(const ImpactProblem& p, Random& random) {
  const int n = p.contacts();
  ImpactProblemDerivative d(n);
  const Eigen::MatrixXd S = random.vector(9 * n * n).reshaped(3 * n, 3 * n);
  d.K = 0.5 * (S + S.transpose());
  d.u = random.vector(3 * n);
  for (int k = 0; k < n; ++k) {
    const auto kk = static_cast<std::size_t>(k);
    const Vec3 v = random.vec(1);
    d.normal[kk] = v - p.normal[kk].dot(v) * p.normal[kk];
    d.pair[kk] = {random.in(-1, 1), p.pair[kk].friction > 0 ? random.in(-1, 1) : 0, random.in(-1, 1)};
  }
  return d;
}

double product(const ImpactProblemDerivative& bar, const ImpactProblemDerivative& d) {
  double sum = bar.K.cwiseProduct(d.K).sum() + bar.u.dot(d.u);
  for (std::size_t k = 0; k < d.normal.size(); ++k)
    sum += bar.normal[k].dot(d.normal[k]) + bar.pair[k].elasticity * d.pair[k].elasticity +
           bar.pair[k].friction * d.pair[k].friction +
           bar.pair[k].tangential_elasticity * d.pair[k].tangential_elasticity;
  return sum;
}

TEST(JointLaw, AgreesWithTheReferenceInValuesAndDerivatives) {
  const Real h("1e-17");
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const ImpactProblem p = randomProblem(random);
    const ImpactSolution s = solveLaw(p);
    const ImpactProblemDerivative d = randomDirection(p, random);
    const Solved now = solved(moved(p, d, 0), s);
    EXPECT_TRUE(now.violation <= Real("1e-30")) << now.violation;
    expectEntries(s.P, rounded(now.P), 1e-11, "P", 1 + s.P.norm());
    if (s.stick_slip_margin < 1e-4) continue;
    ++compared;
    const Numbers up = solved(moved(p, d, h), s).P, down = solved(moved(p, d, -h), s).P;
    Numbers rates(up.size());
    for (std::size_t i = 0; i < up.size(); ++i) rates[i] = (up[i] - down[i]) / (2 * h);
    const VectorXd expected = rounded(rates), P_bar = random.vector(s.P.size());
    const double found = product(lawPullback(p, P_bar), d);
    expectEntries(found, P_bar.dot(expected), 1e-9, "adjoint", 1 + expected.norm() * P_bar.norm());
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace carom::reference
