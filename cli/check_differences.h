// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "editing/problem/jacobian.hpp"
#include "formats/answers/check_json.hpp"

/// Differences, the only ones of the program: a test tool that the exact derivatives are held against.
namespace carom::cli {

using namespace formats_detail;

/// Largest relative disagreement of differences, each column at its best step, and of adjoint and tangent.
inline constexpr double kDifferencesTolerance = 1e-6;
inline constexpr double kTangentTolerance = 1e-12;

/// The derivatives that are checked; tests put wrong ones here.
struct CheckedPasses {
  using Pass = std::function<Eigen::MatrixXd(const EditProblem&, const Eigen::VectorXd&, const Motion&, const RowValues&)>;
  Pass by_adjoint = [](const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                       const RowValues& rows) { return jacobianByAdjoint(problem, values, motion, rows); };
  Pass by_tangent = jacobianByTangent;
};

/// Checks the derivatives of the rows at `values`, where all rows are available. `progress` gets a line now and then.
DerivativeCheck checkDerivatives(const EditProblem& problem, const Eigen::VectorXd& values,
                                 const std::function<void(const std::string&)>& progress,
                                 const CheckedPasses& passes = {});

}  // namespace carom::cli
