// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "formats/answers/check_json.hpp"

/// Differences, the only ones of the program: a test tool that the exact derivatives are held against.
namespace carom::cli {

using namespace formats_detail;

/// Largest relative disagreement of differences, each column at its best step, and of adjoint and tangent.
inline constexpr double kDifferencesTolerance = 1e-6;
inline constexpr double kTangentTolerance = 1e-12;

/// Checks the derivatives of the rows at `values`, where all rows are available. `progress` gets a line now and then.
DerivativeCheck checkDerivatives(const EditProblem& problem, const Eigen::VectorXd& values,
                                 const std::function<void(const std::string&)>& progress);

}  // namespace carom::cli
