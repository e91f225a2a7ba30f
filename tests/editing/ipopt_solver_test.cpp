// SPDX-License-Identifier: MIT
// The solver adapter alone: small programs with known answers, and everything that can go wrong in one.

#include "adjoint/base/types.h"
#include "editing/solve/ipopt_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/editing/scenes.h"

namespace carom {
using namespace editing_detail;

namespace {

using testing_scenes::kInfinity;

Eigen::VectorXd vec(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (double value : values) v[i++] = value;
  return v;
}

/// Hock and Schittkowski's problem 71; f* = 17.0140172891520 at (1, 4.74299964, 3.82114998, 1.37940829).
class Hs71 : public NonlinearProgram {
 public:
  bool with_hessian = false;
  std::function<void()> in_evaluation = [] {};
  std::function<bool(const Iteration&)> in_iteration = [](const Iteration&) { return true; };

  int variables() const override { return 4; }
  int constraints() const override { return 2; }
  Bounds bounds() const override {
    return {Eigen::VectorXd::Constant(4, 1), Eigen::VectorXd::Constant(4, 5), vec({25, 40}), vec({kInfinity, 40})};
  }
  Eigen::VectorXd start() const override { return vec({1, 5, 5, 1}); }
  bool objective(const Eigen::VectorXd& x, double& f) override {
    f = x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
    return true;
  }
  bool gradient(const Eigen::VectorXd& x, Eigen::VectorXd& d) override {
    d = vec({x[3] * (2 * x[0] + x[1] + x[2]), x[0] * x[3], x[0] * x[3] + 1, x[0] * (x[0] + x[1] + x[2])});
    return true;
  }
  bool constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) override {
    in_evaluation();
    g = vec({x.prod(), x.squaredNorm()});
    return true;
  }
  bool jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& d) override {
    d.resize(2, 4);
    d << x[1] * x[2] * x[3], x[0] * x[2] * x[3], x[0] * x[1] * x[3], x[0] * x[1] * x[2],  //
        2 * x[0], 2 * x[1], 2 * x[2], 2 * x[3];
    return true;
  }
  bool hasHessian() const override { return with_hessian; }
  bool hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& m, Eigen::MatrixXd& h) override {
    h = 2 * m[1] * Eigen::MatrixXd::Identity(4, 4);
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(4, 4);
    f.row(0) << 2 * x[3], x[3], x[3], 2 * x[0] + x[1] + x[2];
    f(1, 3) = f(2, 3) = x[0];
    f.col(0) = f.row(0).transpose();
    f(3, 1) = f(3, 2) = x[0];
    h += factor * f;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        if (i != j) h(i, j) += m[0] * x.prod() / (x[i] * x[j]);
      }
    }
    return true;
  }
  bool iteration(const Iteration& i) override { return in_iteration(i); }
};

/// Nearest point to the origin on A x = b: the shape of an edit.
class NearestPoint : public NonlinearProgram {
 public:
  NearestPoint(Eigen::MatrixXd A, Eigen::VectorXd b) : A_(std::move(A)), b_(std::move(b)) {}
  int variables() const override { return static_cast<int>(A_.cols()); }
  int constraints() const override { return static_cast<int>(A_.rows()); }
  Bounds bounds() const override {
    return {Eigen::VectorXd::Constant(A_.cols(), -kInfinity), Eigen::VectorXd::Constant(A_.cols(), kInfinity), b_, b_};
  }
  Eigen::VectorXd start() const override { return Eigen::VectorXd::Zero(A_.cols()); }
  bool objective(const Eigen::VectorXd& x, double& f) override { return f = x.squaredNorm() / 2, true; }
  bool gradient(const Eigen::VectorXd& x, Eigen::VectorXd& d) override { return d = x, true; }
  bool constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) override { return g = A_ * x, true; }
  bool jacobian(const Eigen::VectorXd&, Eigen::MatrixXd& d) override { return d = A_, true; }

 private:
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_;
};

void expectHs71(const SolverResult& r) {
  EXPECT_EQ(r.status, SolverStatus::converged) << r.message;
  EXPECT_NEAR(r.objective, 17.0140172891520, 1e-6);
  ASSERT_EQ(r.x.size(), 4);
  const Eigen::VectorXd expected = vec({1, 4.74299964, 3.82114998, 1.37940829});
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(r.x[i], expected[i], 1e-6) << i;
}

TEST(IpoptSolver, SolvesHs71WithoutSecondDerivatives) {
  Hs71 program;
  expectHs71(solveWithIpopt(program));
}

TEST(IpoptSolver, SolvesHs71WithSecondDerivatives) {
  Hs71 program;
  program.with_hessian = true;
  expectHs71(solveWithIpopt(program));
}

TEST(IpoptSolver, FindsTheNearestPoint) {
  Eigen::MatrixXd A(2, 3);
  A << 1, 2, 0, 0, 1, -1;
  NearestPoint program(A, vec({3, 1}));
  const SolverResult r = solveWithIpopt(program);
  EXPECT_EQ(r.status, SolverStatus::converged);
  const Eigen::VectorXd expected = A.transpose() * (A * A.transpose()).inverse() * vec({3, 1});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(r.x[i], expected[i], 1e-8);
}

TEST(IpoptSolver, MoreEquationsThanVariablesIsAStatus) {
  NearestPoint program(Eigen::MatrixXd::Ones(3, 2), vec({1, 1, 1}));
  EXPECT_EQ(solveWithIpopt(program).status, SolverStatus::too_few_variables);
}

TEST(IpoptSolver, NoVariablesIsAStatus) {
  NearestPoint program(Eigen::MatrixXd::Zero(1, 0), vec({1}));
  EXPECT_EQ(solveWithIpopt(program).status, SolverStatus::too_few_variables);
}

TEST(IpoptSolver, ContradictoryRowsEndWithoutConvergence) {
  Eigen::MatrixXd A(2, 3);
  A << 1, 1, 1, 1, 1, 1;
  NearestPoint program(A, vec({1, 2}));
  const SolverResult r = solveWithIpopt(program);
  EXPECT_NE(r.status, SolverStatus::converged);
  EXPECT_EQ(r.x.size(), 3);
  EXPECT_FALSE(r.message.empty());
}

TEST(IpoptSolver, StopsWhenAsked) {
  Hs71 program;
  program.in_iteration = [](const NonlinearProgram::Iteration& i) { return i.number < 2; };
  const SolverResult r = solveWithIpopt(program);
  EXPECT_EQ(r.status, SolverStatus::stopped);
  EXPECT_LE(r.iterations, 2);
}

// As when the time of a search is up: its points are null from then on.
TEST(IpoptSolver, EndsSoonOnceNothingCanBeEvaluated) {
  Hs71 program;
  int evaluations = 0;
  program.in_evaluation = [&] {
    if (++evaluations > 6) throw std::runtime_error("out of time");
  };
  const SolverResult r = solveWithIpopt(program);
  EXPECT_NE(r.status, SolverStatus::converged);
  EXPECT_LE(evaluations, 200);
}

TEST(IpoptSolver, KeepsToTheLimitOfIterations) {
  Hs71 program;
  SolverOptions options;
  options.max_iterations = 2;
  EXPECT_EQ(solveWithIpopt(program, options).status, SolverStatus::iteration_limit);
}

TEST(IpoptSolver, AnExceptionAtOneTrialPointIsARefusedPoint) {
  Hs71 program;
  int evaluations = 0;
  program.in_evaluation = [&] {
    if (++evaluations == 3) throw std::runtime_error("no such point");
  };
  expectHs71(solveWithIpopt(program));
}

TEST(IpoptSolver, AnExceptionAtEveryPointIsAStatus) {
  Hs71 program;
  program.in_evaluation = [] { throw std::runtime_error("no point at all"); };
  const SolverResult r = solveWithIpopt(program);
  EXPECT_EQ(r.status, SolverStatus::cannot_evaluate) << r.message;
}

TEST(IpoptSolver, AnExceptionFromTheCallbackComesThrough) {
  Hs71 program;
  program.in_iteration = [](const NonlinearProgram::Iteration&) -> bool { throw std::logic_error("mine"); };
  EXPECT_THROW(solveWithIpopt(program), std::logic_error);
  program.in_iteration = [](const NonlinearProgram::Iteration&) { return true; };
  expectHs71(solveWithIpopt(program));  // the lock was released
}

TEST(IpoptSolver, TwoThreadsTakeTurns) {
  std::vector<std::thread> threads;
  std::vector<SolverResult> results(2);
  for (int t = 0; t < 2; ++t) {
    threads.emplace_back([&results, t] {
      for (int i = 0; i < 20; ++i) {
        Hs71 program;
        program.with_hessian = t == 1;
        results[static_cast<std::size_t>(t)] = solveWithIpopt(program);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const SolverResult& r : results) expectHs71(r);
}

}  // namespace
}  // namespace carom
