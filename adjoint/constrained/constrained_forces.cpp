// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_forces.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/constrained/constrained_share.hpp"

namespace carom::adjoint_detail {
namespace {

using Vec6 = ConstrainedForces::Vec6;

// Constraints that differ from a combination of others by less than this share of the largest are that combination.
constexpr double kDependent = 1e-10;

// Rows of `rank` entries become those of an orthonormal matrix; gives the upper triangle R that they are to be multiplied
// with, by Gram and Schmidt's modified method.
Eigen::Matrix<double, 6, 6> orthonormalize(std::vector<Vec6>& rows, int rank) {
  Eigen::Matrix<double, 6, 6> R = Eigen::Matrix<double, 6, 6>::Zero();
  for (int j = 0; j < rank; ++j) {
    double square = 0;
    for (const Vec6& row : rows) square += row[j] * row[j];
    R(j, j) = std::sqrt(square);
    for (Vec6& row : rows) row[j] /= R(j, j);
    for (int l = j + 1; l < rank; ++l) {
      double along = 0;
      for (const Vec6& row : rows) along += row[j] * row[l];
      R(j, l) = along;
      for (Vec6& row : rows) row[l] -= along * row[j];
    }
  }
  return R;
}

}  // namespace

void ConstrainedForces::solve(const ConstrainedInstant& now, bool redundant) {
  now_ = &now;
  assemble();
  redundant_ = redundant || row_.size() > 6;
  const std::size_t unknowns = row_.size();
  wrench_.setZero();
  if (unknowns == 0) return;
  if (!redundant_ && !solveSquare()) redundant_ = true;  // contacts that move come to one point at an end of the path
  if (redundant_) {
    factorReduced();
    Column z = Column::Zero(rank_);
    for (std::size_t i = 0; i < unknowns; ++i) z -= b_[i] * U_[i].head(rank_);
    T_.topLeftCorner(rank_, rank_).triangularView<Eigen::Upper>().solveInPlace(z);
    const Column x = solveReduced(z);
    for (std::size_t i = 0; i < unknowns; ++i) y_[i] = V_[i].head(rank_).dot(x);
  }
  for (std::size_t i = 0; i < unknowns; ++i) wrench_ += y_[i] * wrenches_[i];
  if (!wrench_.allFinite()) throw NotComputable("forces at its contacts are beyond the range of doubles");
  for (std::size_t k = 0; k < now.contacts.size(); ++k) {
    const std::size_t i = first_[k];
    force_[k] = now.contacts[k].mode == ContactMode::sticks ? Vec3(y_[i], y_[i + 1], y_[i + 2])
                                                         : Vec3(y_[i] * wrenches_[i].head<3>());
  }
}

// False where constraints are not independent to the last bit.
bool ConstrainedForces::solveSquare() {
  if (row_.size() == 1) {
    y_[0] = -b_[0] / row_[0].dot(moved_[0]);
    return true;
  }
  factorSquare();
  const Column y = square_.solve(Eigen::Map<const Eigen::VectorXd>(b_.data(), static_cast<Eigen::Index>(row_.size())));
  for (std::size_t i = 0; i < row_.size(); ++i) y_[i] = -y[static_cast<Eigen::Index>(i)];
  return y.allFinite();
}

void ConstrainedForces::share() {
  const std::optional<ConstrainedShare> share = shareOf<double>(now_->contacts, *this);
  if (!share) return;
  for (std::size_t i = 0; i < share->contact.size(); ++i) force_[share->contact[i]] += share->push[i];
}

void ConstrainedForces::assemble() {
  const BodyInstant<double>& body = now_->body;
  const std::size_t n = now_->contacts.size();
  free_.resize(n), force_.resize(n), first_.resize(n);
  row_.clear(), wrenches_.clear(), moved_.clear(), b_.clear();
  const Vec3 turning = body.A * body.L.cross(body.omega);  // of omega, without forces
  for (std::size_t k = 0; k < n; ++k) {
    const ContactInstant<double>& c = now_->contacts[k];
    first_[k] = row_.size();
    free_[k] = body.gravity + turning.cross(c.r) + body.omega.cross(Vec3(c.point_rate - body.v)) - c.support_acceleration;
    const auto add = [&](const Vec3& along, const Vec3& push, double b) {
      Vec6 row, wrench;
      row << along, c.r.cross(along);
      wrench << push, c.r.cross(push);
      row_.push_back(row), wrenches_.push_back(wrench), moved_.push_back(moved(wrench));
      b_.push_back(b);
    };
    if (c.mode == ContactMode::sticks) {
      for (int i = 0; i < 3; ++i) add(Vec3::Unit(i), Vec3::Unit(i), free_[k][i]);
    } else {
      add(c.n, c.n - c.friction * c.slip, c.n.dot(free_[k]) + c.normal_rate.dot(body.relativeVelocity(c)));
    }
  }
  y_.resize(row_.size());
}

void ConstrainedForces::factorSquare() {
  const auto n = static_cast<Eigen::Index>(row_.size());
  Square B(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      B(i, j) = row_[static_cast<std::size_t>(i)].dot(moved_[static_cast<std::size_t>(j)]);
  square_.compute(B);
}

// The rows of the constraints, by Gram and Schmidt's method, the furthest from all before first.
void ConstrainedForces::findBasis() {
  length_ = 0;
  for (const ContactInstant<double>& c : now_->contacts) length_ = std::max(length_, c.r.norm());
  if (!(length_ > 0)) length_ = 1;
  U_ = row_;
  for (Vec6& row : U_) row.tail<3>() /= length_;
  double largest = 0;
  for (rank_ = 0; rank_ < 6; ++rank_) {
    std::size_t furthest = 0;
    double square = 0;
    for (std::size_t i = 0; i < U_.size(); ++i)
      if (const double s = U_[i].squaredNorm(); s > square) square = s, furthest = i;
    const double norm = std::sqrt(square);
    if (rank_ == 0) largest = norm;
    if (!(norm > kDependent * largest)) break;
    const Vec6 q = U_[furthest] / norm;
    basis_.col(rank_) = q;
    for (Vec6& row : U_) row -= q.dot(row) * q;
  }
}

void ConstrainedForces::factorReduced() {
  findBasis();
  V_.resize(row_.size());
  for (std::size_t i = 0; i < row_.size(); ++i) {
    Vec6 row = row_[i], by = moved_[i];
    row.tail<3>() /= length_, by.tail<3>() *= length_;
    U_[i].head(rank_) = basis_.leftCols(rank_).transpose() * row;
    V_[i].head(rank_) = basis_.leftCols(rank_).transpose() * by;
  }
  T_ = orthonormalize(U_, rank_);
  S_ = orthonormalize(V_, rank_);
  wrench_by_x_.setZero();
  for (std::size_t i = 0; i < row_.size(); ++i)
    wrench_by_x_.leftCols(rank_) += wrenches_[i] * V_[i].head(rank_).transpose();
}

// The forces V x of least norm whose accelerations are z in the basis.
ConstrainedForces::Column ConstrainedForces::solveReduced(Column z) const {
  S_.topLeftCorner(rank_, rank_).transpose().triangularView<Eigen::Lower>().solveInPlace(z);
  return z;
}

Vec6 ConstrainedForces::answerToTurn(std::size_t k) const {
  const ContactInstant<double>& c = now_->contacts[k];
  const Vec3 push = y_[first_[k]] * Vec3(-c.friction * c.n.cross(c.slip));
  Vec6 wrench;
  wrench << push, c.r.cross(push);
  Vec6 by = moved(wrench);
  if (redundant_) {
    by.tail<3>() *= length_;
    const Column x = solveReduced(-basis_.leftCols(rank_).transpose() * by);
    return wrench + wrench_by_x_.leftCols(rank_) * x;
  }
  if (row_.size() == 1) return wrench - row_[0].dot(by) / row_[0].dot(moved_[0]) * wrenches_[0];
  const auto n = static_cast<Eigen::Index>(row_.size());
  Column b(n);
  for (Eigen::Index i = 0; i < n; ++i) b[i] = row_[static_cast<std::size_t>(i)].dot(by);
  const Column y = square_.solve(b);
  for (Eigen::Index i = 0; i < n; ++i) wrench -= y[i] * wrenches_[static_cast<std::size_t>(i)];
  return wrench;
}

}  // namespace carom::adjoint_detail
