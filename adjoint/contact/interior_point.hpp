// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "adjoint/contact/cone.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {

/// The cone program by the primal-dual interior point method with the scaling of Nesterov and Todd (1998) and the steps
/// of Mehrotra (1992): a dozen steps from anywhere, however weak the forces that decide. All contacts take part alike,
/// so their order does not matter. It comes close enough to tell the active set. Of numbers of like size.
class InteriorPoint {
 public:
  explicit InteriorPoint(const ConeProgramOf<double>& program);
  /// Minimise b.y, where every three rows of D y + a are in the cone s_0 >= |(s_1, s_2)|.
  InteriorPoint(const Eigen::MatrixXd& D, const Eigen::VectorXd& a, const Eigen::VectorXd& b);
  /// The same with cones of these sizes: 3 rows each, or 1, which is s >= 0. Directions come from the scaled rows themselves,
  /// whose square would be singular near the solution; the columns of D are independent.
  InteriorPoint(const Eigen::MatrixXd& D, const Eigen::VectorXd& a, const Eigen::VectorXd& b, const std::vector<int>& cones);

  void step();
  double gap() const;  ///< of the cones, f.V each on the average
  /// The largest component of D^T z + G^T lambda - K y - b, which is 0 at the solution.
  double unbalanced() const;
  Eigen::VectorXd forces() const { return J_ * y_; }
  const Eigen::VectorXd& unknowns() const { return y_; }
  const Eigen::VectorXd& duals() const { return z_; }  ///< of the rows of D y + a
  Eigen::VectorXd velocities() const;  ///< V of ConeTerms
  Eigen::VectorXd multipliers() const { return combined_ * lambda_; }

 private:
  struct Cone {
    Eigen::Index at, size;  // rows in s and z; 3, or 1 without friction
    double mu;
    Eigen::MatrixXd W, inverse;  // the scaling: W z = W^-1 s
  };
  void addContact(const ConeProgramOf<double>& program, int k, Eigen::Index& column);
  void makeIndependent();
  void scale(Cone& cone);
  bool factorise();
  /// Directions of y, lambda, s and z for W^-1 ds + W dz = q.
  void direction(const Eigen::VectorXd& q);
  double longest(const Eigen::VectorXd& from, const Eigen::VectorXd& along) const;

  std::vector<Cone> cones_;
  Eigen::MatrixXd J_, D_, K_, G_;  // df/dy, ds/dy, in y; the equations, independent
  Eigen::MatrixXd combined_;       // of these by the equations of the program
  Eigen::VectorXd b_, g_, a_;      // s = D y + a
  Eigen::VectorXd y_, lambda_, s_, z_, dy_, dlambda_, ds_, dz_;
  Eigen::MatrixXd H_inverse_, S_inverse_;
  std::optional<HouseholderQr> scaled_;  // of W^-1 D
  bool by_rows_ = false;
};

}  // namespace carom::adjoint_detail
