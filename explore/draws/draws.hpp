// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "editing/problem/controls/control_set.hpp"
#include "explore/draws/marginal.hpp"
#include "explore/draws/points.h"
#include "explore/numbers/sobol.hpp"

/// Scene parameters by world. Internal to explore/.
namespace carom::explore_detail {

/// The distributions of controls, bound to the numbers that these vary.
class Draws {
 public:
  /// Throws InputError naming "/controls/<i>/distribution/...": counts of numbers, deviations that are not positive, a
  /// distribution of which the bounds leave nothing, ...; "/controls" where there is no distribution, or too many
  /// numbers for Sobol's points. `written_index`: of each control, by which errors name it.
  Draws(const editing_detail::ControlSet& controls, const std::vector<int>& written_index, Points points,
        std::uint64_t seed);

  /// The numbers that are drawn, as indices of variables of the controls, in their order.
  const std::vector<int>& variables() const { return variables_; }
  /// Sentences about what is cut off.
  const std::vector<std::string>& notes() const { return notes_; }

  /// The values of all controls in a world: those that are not drawn stay as written. False: some lie outside of their
  /// bounds, which a joint distribution is not cut off at.
  bool draw(std::uint64_t world, Eigen::VectorXd& values) const;

 private:
  struct Component {
    int variable;
    int index;  // among the components that vary
    Marginal marginal;
  };
  /// One control that is drawn.
  struct Group {
    int control;
    int first_number;  // of those that a world has
    bool orientation = false;
    std::vector<Component> components;
    Eigen::MatrixXd factor;  // not empty: of a joint distribution
  };
  void bind(const editing_detail::ControlSet& controls, int control, const std::string& of_control);
  void bindOrientation(const editing_detail::ControlSet& controls, int control, Group& group, const std::string& where);
  void bindNormal(const editing_detail::ControlSet& controls, Marginal::Kind kind, const std::vector<double>& centre,
                  const std::vector<double>& deviation, const std::vector<std::vector<double>>& factor, Group& group,
                  const std::string& where);
  void bindUniform(const editing_detail::ControlSet& controls, const UniformDistribution& uniform, Group& group,
                   const std::string& where);
  void add(const editing_detail::ControlSet& controls, int variable, int index, Marginal marginal, Group& group,
           const std::string& where);
  double uniform(std::uint64_t world, int number) const;  // in (0, 1)

  std::uint64_t seed_;
  std::vector<Group> groups_;
  std::vector<int> variables_;
  std::vector<std::string> notes_;
  int numbers_ = 0;
  Eigen::VectorXd start_;
  std::vector<double> cones_;  // of the controls that are tilts, else 0
  std::vector<std::vector<int>> of_control_;
  std::optional<SobolPoints> sobol_;
};

}  // namespace carom::explore_detail
