// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_path.hpp"

namespace carom::adjoint_detail {

/// All that a path in lasting contact depends on, in columns: its start (x, theta, v, L), then gravity, mass, inertia
/// (three moments and yz, xz, xy), the dimensions of the body; of each body that it is in contact with position and
/// orientation (a rotation vector), 6, and dimensions; the friction of each contact.
struct ConstrainedInputs {
  static constexpr int kStart = 12, kGravity = 12, kMass = 15, kInertia = 16, kProducts = 19, kSizes = 22;
  struct Partner {
    int body, pose, sizes, size_count;
  };
  int size_count = 0, friction = 0, count = 0;
  std::vector<Partner> partners;
  std::vector<std::size_t> partner_of;  // of each contact

  ConstrainedInputs(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& start);

  /// Of a derivative of a pair's geometry what belongs to a column; nothing where that does not move the pair.
  std::optional<Eigen::Matrix<double, 7, 1>> columnOf(const ContactJacobian& J, const PersistentContact& contact, std::size_t k,
                                                      int column) const;

  /// The chain rule where the state has the derivative `state`, 12 rows, by the inputs: rows by all inputs.
  static Eigen::MatrixXd chained(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& state) {
    Eigen::MatrixXd sum = rows.leftCols<kStart>() * state;
    sum.rightCols(rows.cols() - kStart) += rows.rightCols(rows.cols() - kStart);
    return sum;
  }
};

inline Eigen::Matrix<double, 12, 1> asVector(const StateDerivative& d) {
  return (Eigen::Matrix<double, 12, 1>() << d.x, d.theta, d.v, d.L).finished();
}
inline StateDerivative asState(const Eigen::Matrix<double, 12, 1>& v) {
  StateDerivative d;
  d.x = v.head<3>(), d.theta = v.segment<3>(3), d.v = v.segment<3>(6), d.L = v.tail<3>();
  return d;
}

}  // namespace carom::adjoint_detail
