// SPDX-License-Identifier: MIT
#include "editing/strategy/last_digits.hpp"

#include <cmath>
#include <limits>

#include "editing/detail/messages.hpp"

namespace carom::editing_detail {
namespace {

constexpr double kNear = 1e-6;  // of a row's natural scale: larger misses are not looked at
constexpr double kDigits = 10;  // so many times what one last digit does

}  // namespace

std::string lastDigits(const EditEvaluator& evaluator, EditPoint& point) {
  const ConstraintSet& set = evaluator.problem().constraints;
  if (set.size() == 0 || !(point.violation <= kNear) || !evaluator.differentiate(point)) return "";
  // changes are in natural scales, and a control is some of these
  const Eigen::VectorXd digits = std::numeric_limits<double>::epsilon() * (1 + point.changes.array().abs());
  const Eigen::VectorXd moved = point.row_jacobian->cwiseAbs() * digits;
  Eigen::Index worst = 0;
  point.rows.scaled.cwiseAbs().maxCoeff(&worst);
  if (!(std::abs(point.rows.scaled[worst]) <= kDigits * moved[worst])) return "";
  const Row& row = set.rows()[static_cast<std::size_t>(worst)];
  return " That is as near as the controls get, which have 16 digits: the motion is so sensitive that the last one of "
         "them moves it by " +
         brief(moved[worst] * row.scale) + unitOf(row) +
         ". An earlier time, or a range in place of a number, can be met.";
}

}  // namespace carom::editing_detail
