// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// Everything else that could vary. Internal to editing/.
namespace carom::editing_detail {

/// A control that an edit does not have, or the components of one that it does not vary, with the derivative of the
/// rows of a point by it.
struct Candidate {
  Control control;
  std::string name;
  Eigen::MatrixXd columns;       ///< rows x numbers, dimensionless
  Eigen::VectorXd lower, upper;  ///< of the changes
};

/// Whether two controls vary numbers of the same kind and owner.
bool varyTheSame(const Control& a, const Control& b);

/// All kinds of controls for all their owners: bodies, materials, gravity, and tilts of the impacts that happened (the
/// first kTiltedImpacts of a body). Two reverse passes a row give the derivatives with respect to all of them, and as many again for
/// the kinds that write the scene in other words (mass, moments).
std::vector<Candidate> candidatesFor(const EditProblem& problem, const EditPoint& point);
inline constexpr int kTiltedImpacts = 6;

}  // namespace carom::editing_detail
