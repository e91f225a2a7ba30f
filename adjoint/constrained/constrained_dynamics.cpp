// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_dynamics.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {

namespace {

// Forces of redundant contacts: what is smaller than this share of the largest pivot is rounding.
constexpr double kRank = 1e-10;

// y = -B^+ b, of least norm where B has not full rank, with b in its range. `redundant`: it may not have it.
Eigen::VectorXd solveForces(const Eigen::MatrixXd& B, const Eigen::VectorXd& b, bool redundant,
                            Eigen::MatrixXd* inverse = nullptr) {
  if (!B.allFinite() || !b.allFinite()) throw NotComputable("forces at its contacts are beyond the range of doubles");
  if (B.rows() == 0) return {};
  if (B.rows() == 1 && !redundant) {
    if (inverse) *inverse = B.cwiseInverse();
    return -b / B(0, 0);
  }
  if (!redundant) {
    const PartialLu whole(B);
    const Eigen::VectorXd y = whole.solve(b);
    if (inverse) *inverse = whole.inverse();
    if (y.allFinite() && (!inverse || inverse->allFinite())) return -y;
  }
  const CompleteOrthogonal whole(B, kRank);
  if (inverse) *inverse = whole.pseudoInverse();
  return -whole.solve(b);
}

}  // namespace

ConstrainedDynamics::ConstrainedDynamics(const BodyInstant<double>& body, const std::vector<ContactInstant<double>>& contacts,
                           bool redundant, Eigen::MatrixXd* inverse)
    : body_(body), contacts_(contacts) {
  Eigen::Index unknowns = 0;
  for (const auto& c : contacts) first_.push_back(unknowns), unknowns += c.mode == ContactMode::sticks ? 3 : 1;
  free_.resize(contacts.size());
  const Vec3 turning = body.A * body.L.cross(body.omega);  // of omega, without forces
  B_.resize(unknowns, unknowns);
  b_.resize(unknowns);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ContactInstant<double>& c = contacts[k];
    free_[k] = body.gravity + turning.cross(c.r) + body.omega.cross(Vec3(c.point_rate - body.v)) - c.support_acceleration;
    if (c.mode == ContactMode::sticks) {
      b_.segment<3>(first_[k]) = free_[k];
    } else {
      b_[first_[k]] = c.n.dot(free_[k]) + c.normal_rate.dot(body.relativeVelocity(c));
    }
    for (std::size_t l = 0; l < contacts.size(); ++l) fill(k, l);
  }
  y_ = solveForces(B_, b_, redundant, inverse);
  force_ = forcesOf(y_);
}

std::vector<Vec3> ConstrainedDynamics::forcesOf(const Eigen::VectorXd& y) const {
  std::vector<Vec3> forces(contacts_.size());
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const ContactInstant<double>& c = contacts_[k];
    forces[k] = c.mode == ContactMode::sticks ? Vec3(y.segment<3>(first_[k])) : Vec3(c.push() * y[first_[k]]);
  }
  return forces;
}

void ConstrainedDynamics::fill(std::size_t k, std::size_t l) {
  const ContactInstant<double>&at = contacts_[k], &by = contacts_[l];
  const Eigen::Index row = first_[k], column = first_[l];
  if (by.mode == ContactMode::slides) {
    const Vec3 answer = responseAt(at.r, l, by.push());
    if (at.mode == ContactMode::slides) {
      B_(row, column) = at.n.dot(answer);
    } else {
      B_.block<3, 1>(row, column) = answer;
    }
    return;
  }
  Mat3 K = -(skew(at.r) * body_.A * skew(by.r));
  K.diagonal().array() += body_.inverse_mass;
  if (at.mode == ContactMode::slides) {
    B_.block<1, 3>(row, column) = at.n.transpose() * K;
  } else {
    B_.block<3, 3>(row, column) = K;
  }
}

Vec3 ConstrainedDynamics::acceleration() const {
  Vec3 a = body_.gravity;
  for (const Vec3& f : force_) a += f * body_.inverse_mass;
  return a;
}

Vec3 ConstrainedDynamics::moment() const {
  Vec3 m = Vec3::Zero();
  for (std::size_t k = 0; k < force_.size(); ++k) m += contacts_[k].r.cross(force_[k]);
  return m;
}

Vec3 ConstrainedDynamics::slipRate(std::size_t k) const {
  Vec3 rate = free_[k];
  for (std::size_t l = 0; l < force_.size(); ++l) rate += responseAt(contacts_[k].r, l, force_[l]);
  return rate;
}

std::vector<Vec3> ConstrainedDynamics::answerToTurn(std::size_t l, bool redundant) const {
  const ContactInstant<double>& by = contacts_[l];
  const Vec3 own = y_[first_[l]] * Vec3(-by.friction * by.n.cross(by.slip));
  Eigen::VectorXd b(b_.size());
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const Vec3 d = responseAt(contacts_[k].r, l, own);
    if (contacts_[k].mode == ContactMode::sticks) {
      b.segment<3>(first_[k]) = d;
    } else {
      b[first_[k]] = contacts_[k].n.dot(d);
    }
  }
  std::vector<Vec3> answer = forcesOf(solveForces(B_, b, redundant));
  answer[l] += own;
  return answer;
}

Vec3 ConstrainedDynamics::responseAt(const Vec3& r, const std::vector<Vec3>& forces) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t l = 0; l < forces.size(); ++l) sum += responseAt(r, l, forces[l]);
  return sum;
}

}  // namespace carom::adjoint_detail
