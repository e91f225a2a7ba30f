// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_step.hpp"
#include "adjoint/group/group_forces.hpp"

namespace carom::adjoint_detail {

/// A stretch of the path of a group: polynomials in time, of degree 12, twelve rows a member (x, theta, v, L).
struct GroupStep : ContactStep {
  std::vector<State> from;  ///< at the start
  Eigen::MatrixXd slopes;   ///< 12n x nodes, coefficients of d/dt of (x, theta, v, L)

  ConstrainedSlopes slopesOf(std::size_t member) const { return slopes.middleRows<12>(12 * rowAt(member)); }
  State stateAt(std::size_t member, double t) const {
    return moved(from[member], length * (slopes.middleRows<12>(12 * rowAt(member)) * Gauss::integrals((t - start) / length).transpose()));
  }
  std::vector<State> statesAt(double t) const;
};

/// Steps of a group by Gauss collocation, as those of one body (ConstrainedStepper).
class GroupStepper {
 public:
  GroupStepper(const GroupScene& scene, const std::vector<GroupContact>& contacts, bool redundant)
      : scene_(scene), contacts_(contacts), redundant_(redundant) {}

  struct Start {
    std::vector<State> states;
    double time = 0;
    std::vector<Vec3> slip;
    std::vector<char> frozen;
  };
  /// A step of a given length; nothing where its equations were not solved. `like`: one that begins or ends there, or none.
  std::optional<GroupStep> tried(const Start& start, double length, const GroupStep* like);
  /// What its polynomials leave out, as a share of what may be left out.
  double errorOf(const GroupStep& step) const;

 private:
  using OfSlip = Eigen::Matrix<double, 3, Gauss::kNodes>;
  Eigen::MatrixXd guess(GroupStep& step, const GroupStep* like);
  void slopesAt(std::size_t node, const GroupStep& step, const std::vector<State>& states, const std::vector<Vec3>& theta, Eigen::MatrixXd& F);
  Eigen::MatrixXd evaluate(GroupStep& step, const Eigen::MatrixXd& change);
  double turnSlips(GroupStep& step, Eigen::MatrixXd& next);
  bool solve(GroupStep& step, Eigen::MatrixXd& F);
  Eigen::VectorXd scaleOf(double of_x, double of_theta) const;

  const GroupScene& scene_;
  const std::vector<GroupContact>& contacts_;
  bool redundant_;
  GroupForces forces_;
  GroupInstant start_;
  std::array<GroupInstant, Gauss::kNodes> at_;
  std::vector<std::size_t> turning_;
  std::vector<OfSlip> slip_rate_;                // of these
  std::vector<Eigen::MatrixXd> slope_by_turn_;   // 6n x nodes, of v and L
  std::vector<std::vector<OfSlip>> rate_by_turn_;  // [of][by]
};

}  // namespace carom::adjoint_detail
