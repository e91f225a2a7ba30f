// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_inputs.hpp"
#include "adjoint/group/group_scene.hpp"

namespace carom::adjoint_detail {

/// All that the path of a group depends on, in columns: (x, theta, v, L) of each member at its start, 12; gravity; of each member mass,
/// inertia (three moments and yz, xz, xy) and dimensions; SupportColumns of what else they are in contact with; the friction of each contact.
struct GroupInputs {
  struct Member {
    int body, mass, sizes, size_count;
    int inertia() const { return mass + 1; }
    int products() const { return mass + 4; }
    bool hasSize(int column) const { return column >= sizes && column < sizes + size_count; }
  };
  int gravity = 0, friction = 0, count = 0;
  std::vector<Member> members;
  std::vector<SupportColumns> partners;
  std::vector<int> partner_of;  ///< of each contact; -1 between members

  GroupInputs(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& start);

  int states() const { return 12 * static_cast<int>(members.size()); }
  /// The chain rule where the states have the derivative `state` by all inputs: rows by all inputs.
  Eigen::MatrixXd chained(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& state) const {
    Eigen::MatrixXd sum = rows.leftCols(states()) * state;
    sum.rightCols(count - states()) += rows.rightCols(count - states());
    return sum;
  }
};

/// As timeShift of one body.
Eigen::VectorXd timeShift(const GroupScene& scene, const GroupInputs& inputs, double t);

}  // namespace carom::adjoint_detail
