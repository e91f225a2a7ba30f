// SPDX-License-Identifier: MIT
#include "explore/draws/draws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/base/errors.h"
#include "adjoint/base/types.h"
#include "adjoint/numeric/so3.hpp"
#include "editing/detail/messages.hpp"
#include "explore/numbers/normal_quantile.hpp"
#include "explore/numbers/philox.hpp"
#include "explore/numbers/random_orientation.hpp"

namespace carom::explore_detail {

using namespace editing_detail;

namespace {

constexpr double kWorthSaying = 1e-9;  // of a distribution, that is cut off

/// One number for all components, or one each.
double entry(const std::vector<double>& numbers, int index, int count, const std::string& where) {
  if (numbers.size() != 1 && numbers.size() != static_cast<std::size_t>(count))
    throw InputError(where, "found " + std::to_string(numbers.size()) + " numbers, expected 1 or " +
                                std::to_string(count) + ", one for each component that varies");
  const double x = numbers.size() == 1 ? numbers[0] : numbers[static_cast<std::size_t>(index)];
  if (!std::isfinite(x)) throw InputError(where, "found " + number(x) + ", expected a finite number");
  return x;
}

/// The slots that vary, and which of them the variables of a control are: one without room is none.
std::vector<int> slotsOf(const ControlSet& controls, int control, const std::string& where) {
  return varyingSlots(controls.writtenScene(), controls.controls()[static_cast<std::size_t>(control)], where);
}

Eigen::MatrixXd matrixOf(const std::vector<std::vector<double>>& rows, int count, const std::string& where) {
  const std::size_t columns = rows[0].size();
  if (rows.size() != static_cast<std::size_t>(count))
    throw InputError(where, "found " + std::to_string(rows.size()) + " rows, expected " + std::to_string(count) +
                                ", one for each component that varies");
  Eigen::MatrixXd factor(count, static_cast<Eigen::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != columns || columns == 0)
      throw InputError(where + "/" + std::to_string(i),
                       "found " + std::to_string(rows[i].size()) + " numbers, expected " +
                           std::to_string(std::max<std::size_t>(columns, 1)) + ", as in the first row");
    for (std::size_t k = 0; k < columns; ++k) {
      if (!std::isfinite(rows[i][k]))
        throw InputError(where + "/" + std::to_string(i) + "/" + std::to_string(k),
                         "found " + number(rows[i][k]) + ", expected a finite number");
      factor(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = rows[i][k];
    }
  }
  return factor;
}

}  // namespace

Draws::Draws(const ControlSet& controls, const std::vector<int>& written_index, Points points, std::uint64_t seed)
    : seed_(seed), start_(controls.startValues()) {
  of_control_.resize(controls.controls().size());
  for (int i = 0; i < controls.size(); ++i)
    of_control_[static_cast<std::size_t>(controls.variables()[static_cast<std::size_t>(i)].control)].push_back(i);
  for (std::size_t c = 0; c < controls.controls().size(); ++c) {
    cones_.push_back(controls.controls()[c].cone);
    bind(controls, static_cast<int>(c), "/controls/" + std::to_string(written_index[c]));
  }
  if (groups_.empty())
    throw InputError("/controls",
                     "found no \"distribution\", expected one for a control at least: nothing varies between worlds");
  if (points != Points::sobol) return;
  if (numbers_ > kSobolDimensions)
    throw InputError("/controls", "found distributions of " + std::to_string(numbers_) + " numbers, expected at most " +
                                      std::to_string(kSobolDimensions) + " with Sobol's points");
  sobol_.emplace(numbers_, seed);
}

void Draws::bind(const ControlSet& controls, int control, const std::string& of_control) {
  Group group{control, numbers_, false, {}, {}};
  const std::string where = of_control + "/distribution";
  const Distribution& distribution = *controls.controls()[static_cast<std::size_t>(control)].control.distribution;
  if (const auto* normal = std::get_if<NormalDistribution>(&distribution))
    bindNormal(controls, Marginal::Kind::normal, normal->mean, normal->deviation, normal->factor, group,
               where + "/normal");
  else if (const auto* log_normal = std::get_if<LogNormalDistribution>(&distribution))
    bindNormal(controls, Marginal::Kind::log_normal, log_normal->median, log_normal->deviation, log_normal->factor,
               group, where + "/log_normal");
  else if (const auto* uniform = std::get_if<UniformDistribution>(&distribution))
    bindUniform(controls, *uniform, group, where + "/uniform");
  else
    bindOrientation(controls, control, group, where);
  groups_.push_back(std::move(group));
}

void Draws::bindOrientation(const ControlSet& controls, int control, Group& group, const std::string& where) {
  const BoundControl& bound = controls.controls()[static_cast<std::size_t>(control)];
  const std::vector<int>& variables = of_control_[static_cast<std::size_t>(control)];
  const bool bounded = std::any_of(variables.begin(), variables.end(), [&](int i) {
    const Variable& v = controls.variables()[static_cast<std::size_t>(i)];
    return std::isfinite(v.lower) || std::isfinite(v.upper);
  });
  if (!bound.kind->is_turn || variables.size() != 3 || bounded)
    throw InputError(
        where,
        "found every orientation, expected that of a control of an orientation with all components, without bounds");
  group.orientation = true;
  for (const int i : variables) variables_.push_back(i);
  numbers_ += 3;
}

void Draws::add(const ControlSet& controls, int variable, int index, Marginal marginal, Group& group,
                const std::string& where) {
  const Variable& v = controls.variables()[static_cast<std::size_t>(variable)];
  const std::string name = controls.describeVariable(variable);
  if (group.factor.size() == 0 && !(marginal.kept() > 0))
    throw InputError(where, "found nothing of the distribution of " + name + " within its bounds, " + number(v.lower) +
                                " to " + number(v.upper));
  if (1 - marginal.kept() >= kWorthSaying)
    notes_.push_back(brief(100 * (1 - marginal.kept())) + " % of the distribution of " + name +
                     (group.factor.size() == 0 ? " lies outside of its bounds and is cut off."
                                               : " lies outside of its bounds: such worlds are not simulated."));
  group.components.push_back({variable, index, marginal});
  variables_.push_back(variable);
}

void Draws::bindNormal(const ControlSet& controls, Marginal::Kind kind, const std::vector<double>& centre,
                       const std::vector<double>& deviation, const std::vector<std::vector<double>>& factor,
                       Group& group, const std::string& where) {
  const bool logarithmic = kind == Marginal::Kind::log_normal;
  const std::string centre_word = logarithmic ? "/median" : "/mean";
  const std::vector<int> slots = slotsOf(controls, group.control, where);
  const int count = static_cast<int>(slots.size());
  if (!factor.empty() && !deviation.empty())
    throw InputError(where + "/factor", "found a factor beside a deviation, expected one of them");
  if (factor.empty() && deviation.empty())
    throw InputError(where, "found neither deviation nor factor, expected one of them");
  if (!factor.empty()) group.factor = matrixOf(factor, count, where + "/factor");
  for (const int i : of_control_[static_cast<std::size_t>(group.control)]) {
    const Variable& v = controls.variables()[static_cast<std::size_t>(i)];
    const int k = static_cast<int>(std::find(slots.begin(), slots.end(), v.slot) - slots.begin());
    const double middle = centre.empty() ? v.before : entry(centre, k, count, where + centre_word);
    if (logarithmic && !(middle > 0))
      throw InputError(where + centre_word,
                       "found " + number(middle) + " for " + controls.describeVariable(i) + ", expected a number > 0");
    const double spread =
        factor.empty() ? entry(deviation, k, count, where + "/deviation") : group.factor.row(k).norm();
    if (!(spread > 0) && factor.empty())
      throw InputError(where + "/deviation", "found " + number(spread) + ", expected a number > 0");
    if (!(spread > 0))
      throw InputError(where + "/factor/" + std::to_string(k),
                       "found a row without a number other than 0, expected one: " + controls.describeVariable(i) +
                           " would not vary");
    add(controls, i, k, Marginal(kind, middle, spread, {v.lower, v.upper}), group, where);
  }
  numbers_ += factor.empty() ? static_cast<int>(group.components.size()) : static_cast<int>(group.factor.cols());
}

void Draws::bindUniform(const ControlSet& controls, const UniformDistribution& uniform, Group& group,
                        const std::string& where) {
  const std::vector<int> slots = slotsOf(controls, group.control, where);
  const int count = static_cast<int>(slots.size());
  for (const int i : of_control_[static_cast<std::size_t>(group.control)]) {
    const Variable& v = controls.variables()[static_cast<std::size_t>(i)];
    const int k = static_cast<int>(std::find(slots.begin(), slots.end(), v.slot) - slots.begin());
    const double from = entry(uniform.from, k, count, where + "/from"), to = entry(uniform.to, k, count, where + "/to");
    if (!(from <= to))
      throw InputError(where + "/from", "found " + number(from) + ", expected a number <= to, which is " + number(to));
    add(controls, i, k, Marginal(Marginal::Kind::uniform, from, to, {v.lower, v.upper}), group, where);
  }
  numbers_ += static_cast<int>(group.components.size());
}

double Draws::uniform(std::uint64_t world, int number) const {
  return sobol_ ? sobol_->coordinate(world, number) : randomNumber(seed_, world, static_cast<std::uint32_t>(number));
}

bool Draws::draw(std::uint64_t world, Eigen::VectorXd& values) const {
  values = start_;
  bool inside = true;
  for (const Group& group : groups_) {
    if (group.orientation) {
      const double u = uniform(world, group.first_number), v = uniform(world, group.first_number + 1),
                   w = uniform(world, group.first_number + 2);
      const Vec3 turn = adjoint_detail::logSO3(orientationOf(u, v, w));
      for (int k = 0; k < 3; ++k)
        values[of_control_[static_cast<std::size_t>(group.control)][static_cast<std::size_t>(k)]] = turn[k];
      continue;
    }
    Eigen::VectorXd z(group.factor.cols());
    for (int k = 0; k < z.size(); ++k) z[k] = normalQuantile(uniform(world, group.first_number + k));
    for (std::size_t k = 0; k < group.components.size(); ++k) {
      const Component& c = group.components[k];
      if (z.size() == 0) {
        values[c.variable] = c.marginal.at(uniform(world, group.first_number + static_cast<int>(k)));
        continue;
      }
      double offset = 0;
      for (Eigen::Index j = 0; j < z.size(); ++j) offset += group.factor(c.index, j) * z[j];
      values[c.variable] = c.marginal.atOffset(offset);
      inside = inside && c.marginal.allows(values[c.variable]);
    }
  }
  // The cone of a tilt is no bound of one number.
  for (const Group& group : groups_) {
    const auto c = static_cast<std::size_t>(group.control);
    double square = 0;
    for (const int i : of_control_[c]) square += values[i] * values[i];
    inside = inside && !(cones_[c] > 0 && square > cones_[c] * cones_[c]);
  }
  return inside;
}

}  // namespace carom::explore_detail
