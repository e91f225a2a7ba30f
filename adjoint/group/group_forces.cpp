// SPDX-License-Identifier: MIT
#include "adjoint/group/group_forces.hpp"

#include "adjoint/base/errors.h"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// Rows that differ from a combination of others by less than this share of the largest are that combination.
constexpr double kDependentForces = 1e-10;

}  // namespace

GroupForces::Sided GroupForces::along(std::size_t k, const Vec3& direction) const {
  const GroupContact& of = (*contacts_)[k];
  const Vec3& p = now_->contacts[k].point;
  Sided row;
  if (of.member_a >= 0) row.a << direction, Vec3(p - now_->members[static_cast<std::size_t>(of.member_a)].x).cross(direction);
  if (of.member_b >= 0) row.b << -direction, -Vec3(p - now_->members[static_cast<std::size_t>(of.member_b)].x).cross(direction);
  return row;
}

// row_k M^-1 wrench_l
double GroupForces::product(std::size_t k, const Sided& row, std::size_t l, const Sided& wrench) const {
  const GroupContact &c = (*contacts_)[k], &d = (*contacts_)[l];
  double sum = 0;
  const auto add = [&](int member, const Vec6& r, const Vec6& w) {
    const MemberInstant& m = now_->members[static_cast<std::size_t>(member)];
    sum += m.inverse_mass * r.head<3>().dot(w.head<3>()) + r.tail<3>().dot(m.A * w.tail<3>());
  };
  if (c.member_a >= 0 && c.member_a == d.member_a) add(c.member_a, row.a, wrench.a);
  if (c.member_a >= 0 && c.member_a == d.member_b) add(c.member_a, row.a, wrench.b);
  if (c.member_b >= 0 && c.member_b == d.member_a) add(c.member_b, row.b, wrench.a);
  if (c.member_b >= 0 && c.member_b == d.member_b) add(c.member_b, row.b, wrench.b);
  return sum;
}

void GroupForces::addWrench(std::size_t k, const Sided& wrench, double by, Eigen::VectorXd& sum) const {
  const GroupContact& c = (*contacts_)[k];
  if (c.member_a >= 0) sum.segment<6>(6 * c.member_a) += by * wrench.a;
  if (c.member_b >= 0) sum.segment<6>(6 * c.member_b) += by * wrench.b;
}

void GroupForces::assemble(const std::vector<GroupContact>& contacts, const GroupInstant& now) {
  contacts_ = &contacts, now_ = &now;
  wrench_.setZero(6 * rowAt(now.members.size()));
  first_.clear(), contact_of_.clear(), row_.clear(), wrench_of_.clear();
  std::vector<double> b;
  for (std::size_t k = 0; k < contacts_->size(); ++k) {
    const GroupContactInstant& c = now_->contacts[k];
    first_.push_back(rowAt(row_.size()));
    const Vec3 rate = slipRate(k);  // without forces
    if (c.mode == ContactMode::sticks) {
      for (int i = 0; i < 3; ++i) {
        row_.push_back(along(k, Vec3::Unit(i)));
        wrench_of_.push_back(row_.back());
        b.push_back(rate[i]);
        contact_of_.push_back(k);
      }
    } else {
      row_.push_back(along(k, c.n));
      wrench_of_.push_back(along(k, c.push()));
      b.push_back(c.n.dot(rate) + c.normal_rate.dot(c.u));
      contact_of_.push_back(k);
    }
  }
  b_ = Eigen::Map<const Eigen::VectorXd>(b.data(), rowAt(b.size()));
  const Index n = rowAt(row_.size());
  B_.setZero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const auto r = static_cast<std::size_t>(i), w = static_cast<std::size_t>(j);
      B_(i, j) = product(contact_of_[r], row_[r], contact_of_[w], wrench_of_[w]);
    }
}

bool GroupForces::dependent() const { return row_.size() > 1 && FullLu(B_, kDependentForces).rank() < B_.rows(); }

void GroupForces::solve(const std::vector<GroupContact>& contacts, const GroupInstant& now, bool redundant) {
  redundant_ = redundant;
  force_.assign(contacts.size(), Vec3::Zero());
  assemble(contacts, now);
  if (row_.empty()) return;
  reduced_.reset();
  if (!B_.allFinite() || !b_.allFinite()) throw NotComputable("forces at the contacts of bodies that move on each other are beyond the range of doubles");
  if (!redundant_) {
    square_.compute(B_);
    y_ = solved(b_);
    if (!y_.allFinite()) redundant_ = true;
  }
  if (redundant_) {
    arm_ = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      for (const int m : {contacts[k].member_a, contacts[k].member_b})
        if (m >= 0) arm_ = std::max(arm_, (now.contacts[k].point - now.members[static_cast<std::size_t>(m)].x).norm());
    shares_.setZero(rowAt(row_.size()), wrench_.size());
    for (std::size_t i = 0; i < row_.size(); ++i) {
      const GroupContact& c = contacts[contact_of_[i]];
      double compliance = 0;
      for (const int m : {c.member_a, c.member_b})
        if (m >= 0) compliance += now.members[static_cast<std::size_t>(m)].inverse_mass;
      const auto put = [&](int m, const Vec6& row) {
        if (m < 0) return;
        shares_.row(rowAt(i)).segment<3>(6 * m) += row.head<3>().transpose() / compliance;
        shares_.row(rowAt(i)).segment<3>(6 * m + 3) += row.tail<3>().transpose() / (compliance * arm_);
      };
      put(c.member_a, row_[i].a), put(c.member_b, row_[i].b);
    }
    reduced_.emplace(B_ * shares_, kDependentForces);
    y_ = solved(b_);
  }
  if (!y_.allFinite()) throw NotComputable("forces at the contacts of bodies that move on each other are beyond the range of doubles");
  for (std::size_t i = 0; i < row_.size(); ++i) addWrench(contact_of_[i], wrench_of_[i], y_[rowAt(i)], wrench_);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const GroupContactInstant& c = now.contacts[k];
    force_[k] = c.mode == ContactMode::sticks ? Vec3(y_.segment<3>(first_[k])) : Vec3(y_[first_[k]] * c.push());
  }
}

Eigen::VectorXd GroupForces::solved(const Eigen::VectorXd& b) const {
  if (reduced_) return -(shares_ * reduced_->solve(b));
  return -square_.solve(b);
}

Vec3 GroupForces::acceleration(std::size_t member) const {
  const MemberInstant& m = now_->members[member];
  return m.gravity + m.inverse_mass * wrench_.segment<3>(6 * rowAt(member));
}

Vec3 GroupForces::spinRate(std::size_t member) const {
  const MemberInstant& m = now_->members[member];
  return m.turning() + m.A * moment(member);
}

Vec3 GroupForces::slipRateAt(const GroupContact& of, const GroupContactInstant& c) const {
  const auto rate = [&](int member, const Vec3& driven) -> Vec3 {
    if (member < 0) return driven;
    const auto i = static_cast<std::size_t>(member);
    const MemberInstant& m = now_->members[i];
    return acceleration(i) + spinRate(i).cross(Vec3(c.point - m.x)) + m.w.cross(Vec3(c.point_rate - m.v));
  };
  return rate(of.member_a, c.driven_a) - rate(of.member_b, c.driven_b);
}

Vec3 GroupForces::responseAt(const Eigen::VectorXd& wrench, std::size_t k) const {
  const GroupContact& of = (*contacts_)[k];
  const auto response = [&](int member) -> Vec3 {
    if (member < 0) return Vec3::Zero();
    const MemberInstant& m = now_->members[static_cast<std::size_t>(member)];
    const Vec3 spin = m.A * wrench.segment<3>(6 * member + 3);
    return m.inverse_mass * wrench.segment<3>(6 * member) + spin.cross(Vec3(now_->contacts[k].point - m.x));
  };
  return response(of.member_a) - response(of.member_b);
}

Eigen::VectorXd GroupForces::answerToTurn(std::size_t k) const {
  const GroupContactInstant& c = now_->contacts[k];
  Eigen::VectorXd wrench = Eigen::VectorXd::Zero(wrench_.size());
  addWrench(k, along(k, -c.friction * c.n.cross(c.slip)), y_[first_[k]], wrench);
  Eigen::VectorXd b(b_.size());
  for (std::size_t l = 0; l < contacts_->size(); ++l) {
    const Vec3 moved = responseAt(wrench, l);
    if (now_->contacts[l].mode == ContactMode::sticks) b.segment<3>(first_[l]) = moved;
    else b[first_[l]] = now_->contacts[l].n.dot(moved);
  }
  const Eigen::VectorXd y = solved(b);
  for (std::size_t i = 0; i < row_.size(); ++i) addWrench(contact_of_[i], wrench_of_[i], y[rowAt(i)], wrench);
  return wrench;
}

}  // namespace carom::adjoint_detail
