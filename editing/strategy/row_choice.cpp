// SPDX-License-Identifier: MIT
#include "editing/strategy/row_choice.hpp"

#include <algorithm>
#include <cmath>

#include "editing/detail/messages.hpp"
#include "editing/solve/dependence.hpp"

namespace carom::editing_detail {
namespace {

constexpr int kPointsTried = 2;
constexpr double kStepBeside = 1e-3;  // of the natural scales
/// A dependent row this far (dimensionless) from what the others make it is a contradiction, not rounding.
constexpr double kContradiction = 1e-7;

/// A point near the start, in the same impact sequence; null where none is found. Offsets are irregular, so that no
/// symmetry of the scene survives, and the same every time.
EditPointPtr pointBeside(EditEvaluator& evaluator, const EditPoint& start, int which) {
  const Eigen::Index n = start.changes.size();
  Eigen::VectorXd direction(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double phase = 0.754877666 * static_cast<double>(j + 1) + 0.569840291 * (which + 1);
    direction[j] = 2 * (phase - std::floor(phase)) - 1;
  }
  for (double length = kStepBeside; length > 1e-7; length /= 10) {
    const Eigen::VectorXd changes =
        (start.changes + length * direction).cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper());
    EditPointPtr point = evaluator.evaluate(changes);
    if (point && point->signature == start.signature && evaluator.differentiate(*point)) return point;
  }
  return nullptr;
}

std::string offBy(const EditEvaluator& evaluator, const EditPoint& point, int row) {
  const ConstraintSet& constraints = evaluator.problem().constraints;
  return constraints.describeRow(row) + " (off by " + brief(point.rows.residuals[row]) + ")";
}

/// With the number that it shall have, where it is one that can be read: two nails of one thing are told apart by it.
std::string withTarget(const ConstraintSet& constraints, int index) {
  const Row& row = constraints.rows()[static_cast<std::size_t>(index)];
  const bool measured_from_it = row.kind && row.kind->from_target;
  if (measured_from_it || !std::isfinite(row.target)) return constraints.describeRow(index);
  return constraints.describeRow(index) + " = " + number(row.target);
}

std::string explainContradictions(const EditEvaluator& evaluator, const EditPoint& start, const RowSplit& split) {
  std::string text;
  const ConstraintSet& constraints = evaluator.problem().constraints;
  for (int row : split.zero) {
    if (std::abs(start.rows.scaled[row]) <= evaluator.options().tolerance) continue;
    text += (text.empty() ? "" : " ") + std::string("In this impact sequence no control can influence ") +
            offBy(evaluator, start, row) + ".";
  }
  for (const DependentRow& dependent : split.dependent) {
    double size = 1;
    for (double weight : dependent.weights) size = std::max(size, std::abs(weight));
    const double off = contradictionOf(split, dependent, start.rows.scaled);
    if (std::abs(off) <= kContradiction * size) continue;
    std::vector<std::string> others;
    for (int row : dependent.on) others.push_back(withTarget(constraints, row));
    text += (text.empty() ? "" : " ") + sentence(withTarget(constraints, dependent.row) + " cannot be met together with " +
                                              listOf(others) + ": the controls move them only together");
  }
  return text;
}

}  // namespace

RowChoice chooseRows(EditEvaluator& evaluator, const EditPointPtr& start) {
  evaluator.differentiate(*start);
  const Eigen::MatrixXd& J = *start->row_jacobian;
  const std::vector<int>& equations = evaluator.problem().constraints.equations();
  const RowSplit split = splitRows(J, equations);
  RowChoice choice{split.independent, start, ""};
  if (split.zero.empty() && split.dependent.empty()) return choice;

  Eigen::MatrixXd all = J;
  for (int k = 0; k < kPointsTried; ++k) {
    const EditPointPtr point = pointBeside(evaluator, *start, k);
    if (!point) continue;
    const Eigen::MatrixXd& beside = *point->row_jacobian;
    all.conservativeResize(Eigen::NoChange, all.cols() + beside.cols());
    all.rightCols(beside.cols()) = beside;
    const RowSplit split_beside = splitRows(beside, equations);
    if (split_beside.independent.size() > choice.rows.size()) choice = {split_beside.independent, point, ""};
  }
  choice.contradiction = explainContradictions(evaluator, *start, splitRows(all, equations));
  return choice;
}

}  // namespace carom::editing_detail
