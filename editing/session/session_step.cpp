// SPDX-License-Identifier: MIT
#include "editing/session/session_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "adjoint/numeric/decompositions.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/solve/projection.hpp"
#include "editing/solve/step_bounds.hpp"

namespace carom::editing_detail {
namespace {

/// Pivots below this fraction of the largest count as zero, of hard rows brought to unit length.
constexpr double kRank = 1e-10;
/// Singular values of the soft rows below this fraction of the largest move nothing.
constexpr double kSoftRank = 1e-9;
/// Bounds and rows that a step would cross are added one round after the other, so often at most.
constexpr int kActiveSetRounds = 12;
/// A row within is crossed when it ends this far below 0.
constexpr double kCrossed = 1e-12;

void shorten(Eigen::VectorXd& v, double longest) {
  const double length = v.norm();
  if (length > longest) v *= longest / length;
}

/// z of least |C z + c|^2 with |z| <= longest, C = U S V^T: z = -V S/(S^2 + mu) U^T c with the least mu >= 0.
Eigen::VectorXd nearestWithin(const adjoint_detail::ThinSvd& svd, Eigen::Index rank, const Eigen::VectorXd& c,
                              double longest) {
  const Eigen::VectorXd s = svd.s.head(rank);
  const Eigen::VectorXd a = svd.U.leftCols(rank).transpose() * c;
  const auto at = [&](double mu) -> Eigen::VectorXd {
    return -(s.array() * a.array() / (s.array().square() + mu)).matrix();
  };
  Eigen::VectorXd z = at(0);
  if (z.norm() > longest) {
    // |z| falls with mu, and is at most |s a| / mu
    double low = 0, high = s.cwiseProduct(a).norm() / longest;
    for (int k = 0; k < 60 && high - low > 1e-6 * high; ++k) {
      const double mu = 0.5 * (low + high);
      (at(mu).norm() > longest ? low : high) = mu;
    }
    z = at(high);
  }
  return svd.V.leftCols(rank) * z;
}

/// The step of the free unknowns while the others have taken `fixed`.
struct Solver {
  const StepProblem& problem;
  Eigen::VectorXd stretch;  // of the unknowns

  Step solve(const Indices& free, const Eigen::VectorXd& fixed, const Indices& active) const {
    const Eigen::Index n = static_cast<Eigen::Index>(free.size());
    Eigen::VectorXd d0 = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd Z = Eigen::MatrixXd::Identity(n, n);
    const LinearRows hard = hardRows(free, fixed, active);
    if (hard.size() > 0 && n > 0) {
      d0 = -adjoint_detail::CompleteOrthogonal(hard.J, kRank).solve(hard.r);
      shorten(d0, problem.longest);
      Z = nullSpace(hard.J, kRank);
    }
    Step step;
    Eigen::VectorXd d = d0, towards = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd moved;  // orthonormal directions of z that move the soft rows
    const Eigen::MatrixXd soft = columns(problem.soft.J, free);
    const Eigen::VectorXd left = problem.soft.r + problem.soft.J * fixed;
    step.free_for_soft = false;
    if (problem.soft.size() > 0 && Z.cols() > 0) {
      const Eigen::MatrixXd C = soft * Z;
      const adjoint_detail::ThinSvd svd(C);
      const Eigen::VectorXd& s = svd.s;
      const double least = kSoftRank * std::max(s[0], soft.norm());
      Eigen::Index rank = 0;
      while (rank < s.size() && s[rank] > least) ++rank;
      step.free_for_soft = rank > 0;
      if (rank > 0) d += Z * nearestWithin(svd, rank, left + soft * d0, problem.longest);
      moved = svd.V.leftCols(rank);
    }
    if (Z.cols() > 0) {
      Eigen::VectorXd w = -(Z.transpose() * pull(free, d));
      if (problem.terms.size() > 0) w = withTerms(w, Z, columns(problem.terms.J, free), problem.terms.J * fixed, d);
      if (moved.cols() > 0) w -= moved * (moved.transpose() * w);
      shorten(w, problem.longest);
      towards = Z * w;
      d += problem.ease * towards;
    }
    step.d = fixed;
    step.towards_zero = Eigen::VectorXd::Zero(fixed.size());
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Index j = free[static_cast<std::size_t>(k)];
      step.d[j] = stretch[j] * d[k];
      step.towards_zero[j] = stretch[j] * towards[k];
    }
    step.soft_after = problem.soft.size() > 0 ? (problem.soft.r + problem.soft.J * step.d).norm() : 0;
    return step;
  }

 private:
  Eigen::MatrixXd columns(const Eigen::MatrixXd& J, const Indices& free) const {
    Eigen::MatrixXd out(J.rows(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t k = 0; k < free.size(); ++k)
      out.col(static_cast<Eigen::Index>(k)) = stretch[free[k]] * J.col(free[k]);
    return out;
  }

  /// Brought to unit length: their rank is judged by their directions. Rows that nothing free moves are left out.
  LinearRows hardRows(const Indices& free, const Eigen::VectorXd& fixed, const Indices& active) const {
    const Eigen::Index m = problem.hard.size(), all = m + static_cast<Eigen::Index>(active.size());
    Eigen::MatrixXd J(all, problem.at.size());
    Eigen::VectorXd r(all);
    if (m > 0) J.topRows(m) = problem.hard.J, r.head(m) = problem.hard.r;
    for (std::size_t k = 0; k < active.size(); ++k) {
      const Eigen::Index i = m + static_cast<Eigen::Index>(k);
      J.row(i) = problem.within.J.row(active[k]), r[i] = problem.within.r[active[k]];
    }
    if (all > 0) r += J * fixed;
    const Eigen::MatrixXd part = columns(J, free);
    LinearRows rows;
    rows.J.resize(0, part.cols());
    for (Eigen::Index i = 0; i < all; ++i) {
      const double length = part.row(i).norm();
      if (length > 0) rows.add(part.row(i) / length, r[i] / length);
    }
    return rows;
  }

  /// What makes |z|^2 + |terms|^2 least along Z, where w does it for |z|^2 alone.
  Eigen::VectorXd withTerms(const Eigen::VectorXd& w, const Eigen::MatrixXd& Z, const Eigen::MatrixXd& J,
                            const Eigen::VectorXd& fixed, const Eigen::VectorXd& d) const {
    const Eigen::MatrixXd S = J * Z;
    Eigen::MatrixXd H = S.transpose() * S;
    H.diagonal().array() += 1;
    return adjoint_detail::solveSymmetric(H, w - S.transpose() * (problem.terms.r + fixed + J * d));
  }

  /// Gradient of what is to be small after a step d of the free unknowns.
  Eigen::VectorXd pull(const Indices& free, const Eigen::VectorXd& d) const {
    Eigen::VectorXd g = d;
    const Eigen::Index dear = problem.at.size() - problem.costless;
    for (std::size_t k = 0; k < free.size(); ++k)
      if (free[k] < dear) g[static_cast<Eigen::Index>(k)] += problem.at[free[k]];
    return g;
  }
};

bool activate(const StepProblem& problem, const Eigen::VectorXd& d, Indices& active) {
  const std::size_t before = active.size();
  for (Eigen::Index i = 0; i < problem.within.size(); ++i) {
    const bool known = std::find(active.begin(), active.end(), i) != active.end();
    if (!known && problem.within.r[i] + problem.within.J.row(i).dot(d) < -kCrossed) active.push_back(i);
  }
  return active.size() > before;
}

}  // namespace

void LinearRows::add(const Eigen::RowVectorXd& row, double residual) {
  J.conservativeResize(J.rows() + 1, row.size());
  r.conservativeResize(J.rows());
  J.bottomRows<1>() = row;
  r[r.size() - 1] = residual;
}

Step hierarchicalStep(const StepProblem& problem) {
  const Eigen::Index n = problem.at.size();
  Solver solver{problem, Eigen::VectorXd::Ones(n)};
  solver.stretch.tail(problem.costless).setConstant(kTimeIsCheap);
  const StepBounds bounds{problem.at, problem.lower, problem.upper};
  Indices free = allIndices(n), active;
  Eigen::VectorXd fixed = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < problem.within.size(); ++i)
    if (problem.within.r[i] < 0) active.push_back(i);
  Step step;
  for (int round = 0; round < kActiveSetRounds; ++round) {
    step = solver.solve(free, fixed, active);
    const bool stopped = !bounds.stop(step.d, free, fixed).empty();
    if (!activate(problem, step.d, active) && !stopped) break;
  }
  for (Eigen::Index j = 0; j < n; ++j) step.d[j] = bounds.allowed(j, step.d);
  return step;
}

}  // namespace carom::editing_detail
