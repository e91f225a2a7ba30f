// SPDX-License-Identifier: MIT
#include "editing/report/fit.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/decompositions.hpp"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/nearest_instants.hpp"
#include "editing/report/constrained_numbers.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/solve/least_squares.hpp"

// With x the unknowns, N a basis of the directions that neither leave the hard constraints nor the bounds that are active,
// and S = d(W r)/dx, the covariance of the fitted x is
//   s^2 N (N^T S^T S N)^-1 N^T,  s^2 = |W r|^2 / (rows - columns of N):
// the Gauss-Newton Hessian of the soft terms alone, without that of the change, which would hide what they leave open.
namespace carom::editing_detail {
namespace {

/// A range within this of its limit is held there, dimensionless.
constexpr double kAtLimit = 1e-8;
/// Singular values below this share of the largest leave a direction open; parameters with more than this of such a direction
/// are not determined.
constexpr double kOpen = 1e-9, kHasPart = 1e-6;
/// The point is a minimum where another step would lower the objective by no more than this share.
constexpr double kStationaryFit = 1e-6;

std::vector<int> rangesAtLimits(const ConstraintSet& set, const RowValues& rows) {
  std::vector<int> at;
  for (const int i : set.ranges()) {
    const Row& row = set.rows()[static_cast<std::size_t>(i)];
    if (std::min(std::abs(rows.values[i] - row.lower), std::abs(rows.values[i] - row.upper)) <= kAtLimit * row.scale)
      at.push_back(i);
  }
  return at;
}

struct FitModel {
  const EditEvaluator& evaluator;
  const EditPoint& point;
  LeastSquaresModel linear;
  std::vector<char> at_bound;  ///< of each unknown
  Eigen::MatrixXd N;

  FitModel(const EditEvaluator& e, EditPoint& p)
      : evaluator(e), point(p), linear(leastSquaresModel(e.problem(), p, rangesAtLimits(e.problem().constraints, p.rows))) {
    const Eigen::Index n = p.changes.size();
    Eigen::MatrixXd held = linear.J;
    for (Eigen::Index j = 0; j < n; ++j) {
      at_bound.push_back(p.changes[j] <= e.lower()[j] || p.changes[j] >= e.upper()[j]);
      if (!at_bound.back()) continue;
      held.conservativeResize(held.rows() + 1, n);
      held.bottomRows<1>() = Eigen::RowVectorXd::Unit(n, j);
    }
    N = nullSpace(held);
  }

  /// Whether the objective is at its least, to second order, along N.
  bool isStationary() const {
    if (N.cols() == 0) return true;
    const Eigen::Index n = evaluator.problem().controls.size();
    Eigen::VectorXd z = point.changes;
    z.tail(z.size() - n).setZero();
    Eigen::MatrixXd H = linear.S.transpose() * linear.S;
    H.diagonal().head(n).array() += 1;
    const Eigen::VectorXd g = N.transpose() * (linear.S.transpose() * linear.r + z);
    const Eigen::VectorXd step = adjoint_detail::solveSymmetric(N.transpose() * H * N, g);
    return 0.5 * g.dot(step) <= kStationaryFit * point.objective;
  }
};

/// "a", "a and b", "a, b and 3 others"
std::string namesOf(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 3;
  if (names.size() <= kNamed) return listOf(names);
  return listOf({names[0], names[1], std::to_string(names.size() - 2) + " others"});
}

/// Times that a fit chooses as it chooses parameters.
int timesChosen(const SoftTerms& soft, const Motion& motion) {
  const std::vector<Instant> instants = nearestInstants(soft.set(), motion);
  int count = 0;
  for (std::size_t k = 0; k < instants.size(); ++k) count += movesInSpan(soft.set().freeTimes()[k], motion, instants[k]);
  return count;
}

void deviationsInto(EditResult& result, const FitModel& model) {
  const EditProblem& problem = model.evaluator.problem();
  Fit& fit = result.fit;
  const adjoint_detail::ThinSvd svd(model.linear.S * model.N);
  const double least = kOpen * (svd.s.size() > 0 ? svd.s[0] : 0);
  const Eigen::Index rank = (svd.s.array() > least).count();
  fit.parameters = static_cast<int>(model.N.cols()) + timesChosen(problem.soft, result.motion);
  const int freedom = fit.rows - fit.parameters;
  if (freedom <= 0) {
    fit.message = std::to_string(fit.rows) + " errors determine no standard deviations of " +
                  std::to_string(fit.parameters) + " parameters: there have to be more errors than parameters.";
    return;
  }
  fit.deviation = std::sqrt(fit.sum_of_squares / freedom);
  const Eigen::MatrixXd basis = model.N * svd.V.leftCols(rank);  // what the terms determine
  const Eigen::MatrixXd open = model.N - basis * (basis.transpose() * model.N);
  const Eigen::VectorXd rates = problem.rates(model.point.changes);
  std::vector<std::string> undetermined, bounded;
  for (Eigen::Index j = 0; j < problem.controls.size(); ++j) {
    const std::string name = problem.controls.describeVariable(static_cast<int>(j));
    if (model.at_bound[static_cast<std::size_t>(j)]) {
      bounded.push_back(name);
    } else if (open.row(j).norm() > kHasPart) {
      undetermined.push_back(name);
    } else {
      const Eigen::VectorXd share = basis.row(j).transpose().cwiseQuotient(svd.s.head(rank));
      result.changed[static_cast<std::size_t>(j)].standard_deviation = *fit.deviation * share.norm() * std::abs(rates[j]);
    }
  }
  if (!undetermined.empty()) fit.message = "The soft constraints do not determine " + namesOf(undetermined) + ".";
  if (!bounded.empty())
    fit.message += (fit.message.empty() ? "" : " ") + ("No standard deviation of " + namesOf(bounded)) + ": at a bound.";
}

}  // namespace

void fitInto(EditResult& result, const EditEvaluator& evaluator, const EditPointPtr& point) {
  const EditProblem& problem = evaluator.problem();
  if (problem.soft.empty()) return;
  const RowValues rows = problem.soft.evaluate(result.motion);
  result.soft_residuals = constrainedNumbers(problem.soft.set(), rows);
  Fit& fit = result.fit;
  fit.rows = problem.soft.set().size();
  fit.sum_of_squares = problem.soft.weighted(rows).squaredNorm();
  if (!rows.available) {
    fit.message = rows.message;
  } else if (!problem.isLeastSquares()) {
    fit.message = "No standard deviations: what is minimised has another term beside the soft constraints.";
  } else if (!result.solved()) {
    fit.message = "No standard deviations: the edit is not solved.";
  } else {
    try {
      const FitModel model(evaluator, *point);
      if (model.isStationary()) return deviationsInto(result, model);
      fit.message = "No standard deviations: the steps ended where the sum of squares has a kink or a jump.";
    } catch (const NotComputable& why) {
      fit.message = std::string("No standard deviations: ") + why.what();
    }
  }
}

}  // namespace carom::editing_detail
