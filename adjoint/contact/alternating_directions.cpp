// SPDX-License-Identifier: MIT
#include "adjoint/contact/alternating_directions.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/base/types.h"
#include "adjoint/contact/symmetric_inverse.hpp"

namespace carom::adjoint_detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

AlternatingDirections::AlternatingDirections(ConeProgramOf<double> program) : q_(std::move(program)) {
  if (!q_.K.allFinite() || !q_.b.allFinite())
    throw NotComputable("the effective masses of its contacts are beyond the range of doubles");
  eigen_.compute(q_.K);
  const VectorXd& values = eigen_.eigenvalues();
  const double most = values[values.size() - 1];
  double least = most;
  for (double v : values)
    if (v > 1e-6 * most) least = std::min(least, v);
  pull_ = std::sqrt(most * least);
  rows_.resize(static_cast<Index>(q_.equal.size()), q_.K.cols());
  rise_.resize(rows_.rows());
  for (Index e = 0; e < rows_.rows(); ++e) {
    const auto ee = static_cast<std::size_t>(e);
    const Index k = q_.equal[ee];
    rows_.row(e) = q_.normal[static_cast<std::size_t>(k)].transpose() * q_.K.middleRows(3 * k, 3);
    rise_[e] = q_.rise[ee];
  }
  z_ = y_ = f_ = VectorXd::Zero(q_.K.rows());
  prepare();
}

void AlternatingDirections::prepare() {
  const MatrixXd& V = eigen_.eigenvectors();
  inverse_ = V * (eigen_.eigenvalues().array().max(0.0) + pull_).inverse().matrix().asDiagonal() * V.transpose();
  onto_ = symmetricInverse<double>(rows_ * inverse_ * rows_.transpose(), VectorXd::Ones(rows_.rows()));
}

void AlternatingDirections::intoCones(VectorXd& f) const {
  for (int k = 0; k < q_.contacts(); ++k) {
    const auto kk = static_cast<std::size_t>(k);
    const Vec3& n = q_.normal[kk];
    const double mu = q_.friction[kk], f_n = n.dot(f.segment<3>(3 * k)), P = f_n + q_.offset[kk];
    const Vec3 f_t = f.segment<3>(3 * k) - f_n * n;
    const double side = f_t.norm();
    if (q_.free[kk]) {
      f.segment<3>(3 * k) = f_n * n;
    } else if (mu * side <= -P) {
      f.segment<3>(3 * k) = -q_.offset[kk] * n;
    } else if (side > mu * P) {
      const double onto = (P + mu * side) / (1 + mu * mu);
      f.segment<3>(3 * k) = (onto - q_.offset[kk]) * n + mu * onto / side * f_t;
    }
  }
}

void AlternatingDirections::iterate(int times) {
  constexpr double kOver = 1.6;  // over-relaxation
  double apart = 0, moved = 0;
  for (int i = 0; i < times; ++i) {
    f_ = inverse_ * (pull_ * (z_ - y_) - q_.b);
    f_ += inverse_ * (rows_.transpose() * (onto_ * (rise_ - rows_ * f_)));
    const VectorXd old = z_, between = kOver * f_ + (1 - kOver) * z_;
    z_ = between + y_;
    intoCones(z_);
    y_ += between - z_;
    apart = (f_ - z_).norm();
    moved = pull_ * (z_ - old).norm();
  }
  // a weaker or stronger pull where one of the two lags behind
  const double ratio = apart > 10 * moved ? 3 : moved > 10 * apart ? 1.0 / 3 : 1;
  if (ratio == 1) return;
  pull_ *= ratio;
  y_ /= ratio;
  prepare();
}

VectorXd AlternatingDirections::multipliers() const {
  // V = b + K (f - N lambda) at the contacts; from where it is stationary
  const VectorXd lacks = q_.K * z_ + q_.b + pull_ * y_;
  const VectorXd normal = rows_ * eigen_.eigenvectors() *
                          eigen_.eigenvalues().unaryExpr([](double v) { return v > 1e-9 ? 1 / v : 0.0; }).asDiagonal() *
                          (eigen_.eigenvectors().transpose() * lacks);
  MatrixXd A(rows_.rows(), rows_.rows());
  for (Index e = 0; e < A.cols(); ++e) {
    const Index k = q_.equal[static_cast<std::size_t>(e)];
    A.col(e) = rows_.middleCols(3 * k, 3) * q_.normal[static_cast<std::size_t>(k)];
  }
  return symmetricInverse<double>(A, VectorXd::Ones(A.rows())) * normal;
}

}  // namespace carom::adjoint_detail
