// SPDX-License-Identifier: MIT
#pragma once

#include "editing/certificate.h"
#include "editing/problem/edit_problem.hpp"

namespace carom::editing_detail {

/// Checks a motion of problem.controls.sceneAt(values), simulated with nothing left out; `unknowns` are those of the
/// point and `rows` what is held in it. Residuals and reliability are left to the caller, who has them.
Certificate certify(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                    const RowValues& rows);

}  // namespace carom::editing_detail
