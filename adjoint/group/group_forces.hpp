// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "adjoint/group/group_instant.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {

/// Forces at the contacts of a group in their modes, and the accelerations under them: (11.34) of docs/equations.md.
///   C (v'_free + M^-1 P y) = -c,  C rows of u (3 where it sticks, n where it slides), P their wrenches.
/// Redundant forces share as equally stiff contacts do: y = E^-1 C w, E = 1/m_a + 1/m_b.
class GroupForces {
 public:
  /// `redundant`: rows may depend on each other. Keeps a reference to `now`.
  void solve(const std::vector<GroupContact>& contacts, const GroupInstant& now, bool redundant);
  /// C M^-1 P and c of these contacts alone, without forces.
  void assemble(const std::vector<GroupContact>& contacts, const GroupInstant& now);
  const Eigen::MatrixXd& matrix() const { return B_; }
  const Eigen::VectorXd& withoutForces() const { return b_; }

  const Vec3& force(std::size_t k) const { return force_[k]; }  ///< N, on a
  double pressing(std::size_t k) const { return now_->contacts[k].n.dot(force_[k]); }
  Vec3 acceleration(std::size_t member) const;
  Vec3 moment(std::size_t member) const { return wrench_.segment<3>(6 * static_cast<Eigen::Index>(member) + 3); }
  Vec3 spinRate(std::size_t member) const;
  Vec3 slipRate(std::size_t k) const { return slipRateAt((*contacts_)[k], now_->contacts[k]); }  ///< u' at a contact
  /// The same of one of these bodies that has no force.
  Vec3 slipRateAt(const GroupContact& of, const GroupContactInstant& c) const;
  bool dependent() const;  ///< its rows are not independent

  /// How all wrenches answer as the direction of slip at contact k turns about its normal, by 1 rad.
  Eigen::VectorXd answerToTurn(std::size_t k) const;
  /// What wrenches do to u' at contact k.
  Vec3 responseAt(const Eigen::VectorXd& wrench, std::size_t k) const;
  const Eigen::VectorXd& wrench() const { return wrench_; }

  /// y, and where the rows of contact k begin in it.
  const Eigen::VectorXd& solution() const { return y_; }
  Eigen::Index unknown(std::size_t k) const { return first_[k]; }
  /// y = -inverse() b.
  Eigen::MatrixXd inverse() const { return reduced_ ? Eigen::MatrixXd(shares_ * reduced_->pseudoInverse()) : square_.inverse(); }
  /// Whether redundant forces are shared: y = E^-1 C w, moments of w divided by shareArm().
  bool shares() const { return reduced_.has_value(); }
  Eigen::VectorXd shareWeights() const { return -reduced_->solve(b_); }
  double shareArm() const { return arm_; }

 private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  struct Sided {
    Vec6 a = Vec6::Zero(), b = Vec6::Zero();
  };
  Sided along(std::size_t k, const Vec3& direction) const;
  double product(std::size_t k, const Sided& row, std::size_t l, const Sided& wrench) const;
  Eigen::VectorXd solved(const Eigen::VectorXd& b) const;  // y with B y = -b
  void addWrench(std::size_t k, const Sided& wrench, double by, Eigen::VectorXd& sum) const;

  const std::vector<GroupContact>* contacts_ = nullptr;
  const GroupInstant* now_ = nullptr;
  bool redundant_ = false;
  std::vector<Eigen::Index> first_;      // of each contact's rows
  std::vector<std::size_t> contact_of_;  // of each row
  std::vector<Sided> row_, wrench_of_;
  Eigen::MatrixXd B_, shares_;           // shares_: E^-1 C
  Eigen::VectorXd b_, y_, wrench_;
  PartialLu square_;
  std::optional<CompleteOrthogonal> reduced_;
  double arm_ = 0;  // m, of what shares_ has of moments
  std::vector<Vec3> force_;
};

}  // namespace carom::adjoint_detail
