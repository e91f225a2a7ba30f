// SPDX-License-Identifier: MIT
#include "editing/solve/reduced_hessian.hpp"

#include "editing/solve/dependence.hpp"

namespace carom::editing_detail {
namespace {

/// Curvatures along a step that are learned from: beyond them the step crossed a boundary, or a bend.
constexpr double kLeastCurvature = 0.05, kMostCurvature = 20;
/// No step is longer than so many of those for straight rows.
constexpr double kLonger = 3;

}  // namespace

void ReducedHessian::learn(const Eigen::VectorXd& moved, const Eigen::VectorXd& more_gradient) {
  const double sy = moved.dot(more_gradient), ss = moved.squaredNorm();
  if (!(sy > kLeastCurvature * ss) || !(more_gradient.squaredNorm() < kMostCurvature * kMostCurvature * ss)) return;
  const Eigen::VectorXd Hy = inverse_ * more_gradient;
  inverse_ += (1 + more_gradient.dot(Hy) / sy) / sy * moved * moved.transpose() -
              (Hy * moved.transpose() + moved * Hy.transpose()) / sy;
}

Eigen::VectorXd ReducedHessian::stepAlong(const Eigen::VectorXd& at, const Eigen::MatrixXd& row_jacobian,
                                          const Eigen::VectorXd& plain) {
  const Eigen::MatrixXd free = nullSpace(row_jacobian);
  const auto alongRows = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return free * (free.transpose() * v); };
  if (at_before_.size() == 0) {
    inverse_ = Eigen::MatrixXd::Identity(at.size(), at.size());
  } else {
    learn(alongRows(at - at_before_), plain_before_ - plain);
  }
  at_before_ = at, plain_before_ = plain;
  const Eigen::VectorXd step = alongRows(inverse_ * plain);
  if (!(step.dot(plain) > 0)) {
    inverse_.setIdentity();
    return plain;
  }
  const double longest = kLonger * plain.norm();
  return step.norm() > longest ? Eigen::VectorXd(longest / step.norm() * step) : step;
}

}  // namespace carom::editing_detail
