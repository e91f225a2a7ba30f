// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/group/group_forces.hpp"
#include "adjoint/group/group_rates.hpp"

namespace carom::adjoint_detail {

/// The forces at the contacts of a group, and what its members do under them, with their rates along some inputs.
struct GroupForceLanes {
  using Number = GroupLanes::Number;
  std::vector<V3<Number>> forces;                ///< on a, of each contact
  std::vector<V3<Number>> acceleration, moment;  ///< of each member
};

/// By the implicit function theorem, as ConstrainedForceRates: with the forces y kept as they are the rows b + B y of the constraints have
/// rates r; then dy = -B^-1 r, and where redundant forces share, y = S w, dy = dS w - S (B S)^+ (r + B dS w).
class GroupForceRates {
 public:
  /// `contacts` and `now` have to live as long; `redundant` as of GroupForces.
  GroupForceRates(const std::vector<GroupContact>& contacts, const GroupInstant& now, bool redundant);

  const GroupForces& forces() const { return forces_; }
  /// At the same instant.
  GroupForceLanes in(const GroupLanes& lanes) const;

 private:
  using Number = GroupLanes::Number;
  using Rates = Eigen::Matrix<double, Eigen::Dynamic, GroupLanes::kColumns>;
  Rates rowRates(const GroupLanes& lanes, const GroupForceLanes& kept) const;
  Rates shareRates(const GroupLanes& lanes) const;
  void add(const GroupLanes& lanes, std::size_t k, const V3<Number>& force, GroupForceLanes& out) const;

  const std::vector<GroupContact>& contacts_;
  GroupForces forces_;
  Eigen::MatrixXd inverse_;
  Eigen::VectorXd weights_;  // w
};

}  // namespace carom::adjoint_detail
