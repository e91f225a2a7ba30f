// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/problem/edit_problem.hpp"

namespace carom::formats_detail {

using namespace editing_detail;

/// One column of a Jacobian by differences with one step.
struct DifferenceColumn {
  bool compared = false;    ///< only where every motion that the differences use has the same impact sequence
  std::string scheme;       ///< "central"; "forward" or "backward" where the scene is impossible on the other side;
                            ///< ", extrapolated": together with the step before
  std::string why;          ///< a sentence when not compared
  Eigen::VectorXd values;   ///< d(rows)/d(control), SI
  double disagreement = 0;  ///< largest over the rows, relative to the column's scale, but for entries
                            ///< that are rounding
  Eigen::VectorXd rounding;  ///< of the values, by that of rows and derivatives
  std::vector<std::string> below;  ///< the impact sequence on the lower side, one line an impact
  std::vector<std::string> above;  ///< and on the upper side
};

/// The same derivatives by adjoint, by tangent and by differences. Disagreements are between dimensionless entries,
/// relative to the largest entry of their column; entries that differ by more than the tolerance, but by no more than the
/// rounding of what cancels in them, are counted apart.
struct DerivativeCheck {
  /// The entry in which two ways disagree most.
  struct Entry {
    int row = -1;             ///< of the Jacobian
    int column = -1;          ///< of the Jacobian
    double disagreement = 0;  ///< relative to the largest entry of the column
    int rounding = 0;         ///< entries that were left out, because they differ by rounding
  };
  Eigen::MatrixXd by_adjoint;      ///< row by row
  Eigen::MatrixXd by_tangent;      ///< column by column
  Eigen::MatrixXd by_differences;  ///< each column at its best step; NaN where no step could be compared
  std::vector<double> steps;       ///< of the natural scale of each control
  std::vector<std::vector<DifferenceColumn>> columns;  ///< [column][step]
  std::vector<int> best_step;                          ///< of each column; -1 where no step could be compared
  std::vector<std::string> sequence;                   ///< of the motion itself
  Entry adjoint_tangent;                               ///< the worst entry between adjoint and tangent
  Entry differences;                                   ///< the worst entry between adjoint and differences
  int not_compared = 0;                                ///< columns of which no step could be compared
  bool passed = false;  ///< all that was compared agrees
  std::string message;  ///< one sentence
};

/// The answer of `carom check --json`.
std::string checkJson(const EditProblem& problem, const DerivativeCheck& check);

}  // namespace carom::formats_detail
