// SPDX-License-Identifier: MIT
#include "adjoint/contact/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/types.h"
#include "adjoint/contact/symmetric_inverse.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Equations that differ from combinations of others by less than this share are these.
constexpr double kRedundant = 1e-10;

// s_0^2 - |s_1|^2, which is positive inside the cone.
double squareOf(const VectorXd& s) { return s[0] * s[0] - s.tail(s.size() - 1).squaredNorm(); }

// u o v, and x with u o x = v.
VectorXd product(const VectorXd& u, const VectorXd& v) {
  VectorXd w = u[0] * v + v[0] * u;
  w[0] = u.dot(v);
  return w;
}
VectorXd quotient(const VectorXd& u, const VectorXd& v) {
  const Index n = u.size() - 1;
  VectorXd x(u.size());
  x[0] = (u[0] * v[0] - u.tail(n).dot(v.tail(n))) / squareOf(u);
  x.tail(n) = (v.tail(n) - x[0] * u.tail(n)) / u[0];
  return x;
}

}  // namespace

InteriorPoint::InteriorPoint(const ConeProgramOf<double>& program) {
  const int n = program.contacts();
  Index columns = 0;
  J_ = MatrixXd::Zero(3 * n, 3 * n);
  D_ = MatrixXd::Zero(3 * n, 3 * n);
  a_ = VectorXd::Zero(3 * n);
  for (int k = 0; k < n; ++k) addContact(program, k, columns);
  const Index rows = cones_.empty() ? 0 : cones_.back().at + cones_.back().size;
  J_ = J_.leftCols(columns).eval();
  D_ = D_.topLeftCorner(rows, columns).eval();
  a_ = a_.head(rows).eval();
  K_ = J_.transpose() * program.K * J_;
  b_ = J_.transpose() * program.b;
  G_.resize(static_cast<Index>(program.equal.size()), columns);
  g_.resize(G_.rows());
  for (Index e = 0; e < G_.rows(); ++e) {
    const Index k = program.equal[static_cast<std::size_t>(e)];
    G_.row(e) = program.normal[static_cast<std::size_t>(k)].transpose() * program.K.middleRows(3 * k, 3) * J_;
    g_[e] = program.rise[static_cast<std::size_t>(e)];
  }
  makeIndependent();
  y_ = VectorXd::Zero(columns);
  lambda_ = VectorXd::Zero(G_.rows());
  s_ = a_, z_ = VectorXd::Zero(rows);
  for (const Cone& c : cones_) {
    s_[c.at] = std::max(s_[c.at], 1e-2);
    z_[c.at] = 1;
  }
}

// Equations of redundant contacts are linear combinations of others: an orthonormal basis of all takes their place.
void InteriorPoint::makeIndependent() {
  combined_ = MatrixXd::Identity(G_.rows(), G_.rows());
  if (G_.rows() == 0) return;
  const ThinSvd svd(G_);
  Index rank = 0;
  while (rank < svd.s.size() && svd.s[rank] > kRedundant * svd.s[0]) ++rank;
  combined_ = svd.U.leftCols(rank) * svd.s.head(rank).cwiseInverse().asDiagonal();
  g_ = combined_.transpose() * g_;
  G_ = svd.V.leftCols(rank).transpose();
}

InteriorPoint::InteriorPoint(const MatrixXd& D, const VectorXd& a, const VectorXd& b)
    : InteriorPoint(D, a, b, std::vector<int>(static_cast<std::size_t>(a.size() / 3), 3)) {
  by_rows_ = false;
}

InteriorPoint::InteriorPoint(const MatrixXd& D, const VectorXd& a, const VectorXd& b, const std::vector<int>& cones)
    : D_(D), K_(MatrixXd::Zero(D.cols(), D.cols())), G_(0, D.cols()), b_(b), g_(0), a_(a) {
  y_ = VectorXd::Zero(D.cols());
  lambda_.resize(0);
  s_ = a_, z_ = VectorXd::Zero(a.size());
  Index at = 0;
  for (const int size : cones) {
    cones_.push_back({at, size, 1, {}, {}});
    s_[at] = std::max(s_[at], s_.segment(at + 1, size - 1).norm() + 1e-1);
    z_[at] = 1.0 / static_cast<double>(cones.size());
    at += size;
  }
  by_rows_ = true;
}

void InteriorPoint::addContact(const ConeProgramOf<double>& program, int k, Index& column) {
  const auto kk = static_cast<std::size_t>(k);
  const Vec3& n = program.normal[kk];
  const double mu = program.friction[kk];
  const bool rubs = mu > 0 && !program.free[kk];
  const Index at = cones_.empty() ? 0 : cones_.back().at + cones_.back().size;
  J_.block<3, 1>(3 * k, column) = n;
  if (!program.free[kk]) {
    cones_.push_back({at, rubs ? 3 : 1, rubs ? mu : 1, {}, {}});
    D_(at, column) = cones_.back().mu;
    a_[at] = cones_.back().mu * program.offset[kk];
  }
  ++column;
  if (!rubs) return;
  const Vec3 across = n.unitOrthogonal();
  J_.block<3, 1>(3 * k, column) = across;
  J_.block<3, 1>(3 * k, column + 1) = n.cross(across);
  D_(at + 1, column) = D_(at + 2, column + 1) = 1;
  column += 2;
}

VectorXd InteriorPoint::velocities() const { return J_ * (D_.transpose() * z_); }

double InteriorPoint::gap() const {
  const double all = s_.dot(z_);
  return cones_.empty() ? 0 : (all < 0 ? 0 : all) / static_cast<double>(cones_.size());
}

double InteriorPoint::unbalanced() const {
  return (D_.transpose() * z_ + G_.transpose() * lambda_ - K_ * y_ - b_).cwiseAbs().maxCoeff();
}

void InteriorPoint::scale(Cone& c) {
  const VectorXd s = s_.segment(c.at, c.size), z = z_.segment(c.at, c.size);
  const double s2 = squareOf(s), z2 = squareOf(z), beta = std::sqrt(std::sqrt(s2 / z2));
  VectorXd one = s / std::sqrt(s2), other = z / std::sqrt(z2);
  const double gamma = std::sqrt((1 + one.dot(other)) / 2);
  const Index n = c.size - 1;
  VectorXd w = one + other;
  w.tail(n) = one.tail(n) - other.tail(n);
  w /= 2 * gamma;
  MatrixXd even(c.size, c.size);
  even(0, 0) = w[0];
  even.bottomLeftCorner(n, 1) = w.tail(n);
  even.topRightCorner(1, n) = w.tail(n).transpose();
  even.bottomRightCorner(n, n) = MatrixXd::Identity(n, n) + w.tail(n) * w.tail(n).transpose() / (1 + w[0]);
  c.W = beta * even;
  even.bottomLeftCorner(n, 1) *= -1;
  even.topRightCorner(1, n) *= -1;
  c.inverse = even / beta;
}

void InteriorPoint::direction(const VectorXd& q) {
  const VectorXd lacks = D_ * y_ + a_ - s_;
  VectorXd scaled(z_.size()), along(z_.size());
  for (const Cone& c : cones_) {
    scaled.segment(c.at, c.size) = q.segment(c.at, c.size) - c.inverse * lacks.segment(c.at, c.size);
    along.segment(c.at, c.size) = c.inverse * scaled.segment(c.at, c.size);
  }
  if (by_rows_) {
    dy_ = scaled_->solveNormal(scaled, D_.transpose() * z_ - b_);
    dlambda_.setZero(0);
  } else {
    const VectorXd right = D_.transpose() * (along + z_) + G_.transpose() * lambda_ - K_ * y_ - b_;
    const VectorXd first = H_inverse_ * right;
    dlambda_ = S_inverse_ * (g_ - G_ * y_ - G_ * first);
    dy_ = first + H_inverse_ * (G_.transpose() * dlambda_);
  }
  const VectorXd moved = D_ * dy_;
  ds_ = moved + lacks;
  dz_ = along;
  for (const Cone& c : cones_) dz_.segment(c.at, c.size) -= c.inverse * (c.inverse * moved.segment(c.at, c.size));
}

// How far `from` may go before it leaves a cone.
double InteriorPoint::longest(const VectorXd& from, const VectorXd& along) const {
  double most = 1e3;
  for (const Cone& c : cones_) {
    const VectorXd s = from.segment(c.at, c.size), d = along.segment(c.at, c.size);
    const Index n = c.size - 1;
    const double A = squareOf(d), B = s[0] * d[0] - s.tail(n).dot(d.tail(n)), C = squareOf(s);
    const double root = B * B - A * C;  // A t^2 + 2 B t + C = 0
    if (d[0] < 0) most = std::min(most, -s[0] / d[0]);
    if (root < 0) continue;
    const double t = B < 0 ? C / (-B + std::sqrt(root)) : A < 0 ? (-B - std::sqrt(root)) / A : 1e3;
    if (t > 0) most = std::min(most, t);
  }
  return most;
}

// For directions: the matrix of y with its inverse, or its scaled rows. False where numbers let it come no nearer.
bool InteriorPoint::factorise() {
  if (by_rows_) {
    MatrixXd rows(D_.rows(), D_.cols());
    for (Cone& c : cones_) {
      scale(c);
      rows.middleRows(c.at, c.size) = c.inverse * D_.middleRows(c.at, c.size);
    }
    if (!rows.allFinite()) return false;
    scaled_.emplace(rows);
    return true;
  }
  MatrixXd H = K_;
  H.diagonal().array() += 1e-14;
  for (Cone& c : cones_) {
    scale(c);
    const MatrixXd rows = c.inverse * D_.middleRows(c.at, c.size);
    H += rows.transpose() * rows;
  }
  if (!H.allFinite()) return false;
  H_inverse_ = inverseOfSymmetric(H);
  S_inverse_ = symmetricInverse<double>(G_ * H_inverse_ * G_.transpose(), VectorXd::Ones(G_.rows()));
  return true;
}

void InteriorPoint::step() {
  if (!factorise()) {
    s_.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  VectorXd even(z_.size());
  for (const Cone& c : cones_) even.segment(c.at, c.size) = c.W * z_.segment(c.at, c.size);
  direction(-even);
  const double now = gap(), far = std::min({1.0, longest(s_, ds_), longest(z_, dz_)});
  const double towards = (s_ + far * ds_).dot(z_ + far * dz_) / std::max<double>(static_cast<double>(cones_.size()), 1);
  const double left = towards / now, share = now > 0 ? std::clamp(left * left * left, 1e-4, 1.0) : 0;
  VectorXd q(z_.size());
  for (const Cone& c : cones_) {
    const VectorXd v = even.segment(c.at, c.size), ds = c.inverse * ds_.segment(c.at, c.size),
                   dz = c.W * dz_.segment(c.at, c.size);
    VectorXd aim = -product(v, v) - product(ds, dz);
    aim[0] += share * now;
    q.segment(c.at, c.size) = quotient(v, aim);
  }
  direction(q);
  const double length = std::min({1.0, 0.99 * longest(s_, ds_), 0.99 * longest(z_, dz_)});
  y_ += length * dy_;
  lambda_ += length * dlambda_;
  s_ += length * ds_;
  z_ += length * dz_;
}

}  // namespace carom::adjoint_detail
