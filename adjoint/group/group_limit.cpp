// SPDX-License-Identifier: MIT
#include "adjoint/group/group_limit.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/group/group_shares.hpp"
#include "adjoint/group/group_start.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;
using Number = GroupLanes::Number;

// Contacts whose room is no more than this, of the unit of force, are at the limit; forces below it are none.
constexpr double kAtLimit = 1e-7;
// What changes the rooms by less than this share by any other share of the loads is rounding.
constexpr double kStationary = 1e-7;

}  // namespace

GroupLimit::GroupLimit(const GroupScene& scene, const std::vector<GroupContact>& contacts, const GroupInstant& now, const GroupForces& forces)
    : contacts_(contacts) {
  const SharedForces best = sharedForces(scene, contacts, now, forces);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const bool other = best.within && contacts[k].mode == ContactMode::sticks;
    share_.push_back(other ? Vec3(best.force[k] - forces.force(k)) : Vec3::Zero());
    if (contacts[k].mode == ContactMode::sticks) stick_.push_back(k);
  }
  wrenches_ = velocityRows(now, contacts, stick_).transpose();
  const Eigen::MatrixXd others = FullLu(wrenches_, kStationary).kernel();  // shares without effect
  std::vector<Eigen::VectorXd> slopes;
  for (std::size_t i = 0; i < stick_.size(); ++i) {
    const std::size_t k = stick_[i];
    const GroupContactInstant& c = now.contacts[k];
    const Vec3 f = forces.force(k) + share_[k];
    const double unit = scene.forceUnit(contacts[k]), pressing = c.n.dot(f);
    const Vec3 along = f - pressing * c.n;
    if (!(roomOfFriction(c, f) <= kAtLimit * unit)) continue;
    const bool lifts = !(along.norm() > kAtLimit * unit);
    const Vec3 slope = lifts ? c.n : Vec3(c.friction * c.n - along / along.norm());
    weighted_.push_back({k, 0, lifts});
    slopes.push_back(others.middleRows<3>(3 * rowAt(i)).transpose() * slope);
  }
  if (weighted_.empty()) throw NotComputable("the contact that ends the path of bodies that move on each other is not known");
  Eigen::MatrixXd by(others.cols(), rowAt(slopes.size()));
  for (std::size_t i = 0; i < slopes.size(); ++i) by.col(rowAt(i)) = slopes[i];
  by = (by.cwiseAbs().array() > kStationary).select(by, 0);
  const Eigen::MatrixXd weights = by.rows() > 0 ? FullLu(by, kStationary).kernel() : Eigen::MatrixXd::Identity(by.cols(), by.cols());
  const double sum = weights.cols() == 1 ? weights.sum() : 0;
  if (weights.cols() != 1 || !((weights / sum).minCoeff() >= -kStationary))
    throw NotComputable("several contacts come to the limit of friction at once: the derivative of when is not unique");
  for (std::size_t i = 0; i < weighted_.size(); ++i) weighted_[i].weight = weights(rowAt(i), 0) / sum;
}

GroupLanes::Number GroupLimit::rate(const GroupLanes& lanes, const GroupForceLanes& forces) const {
  std::vector<V3<Number>> shared;
  std::vector<V3<Number>> moment(lanes.members.size(), V3<Number>::Zero());
  for (const std::size_t k : stick_) {
    shared.push_back(share_[k].cast<Number>());
    const auto add = [&](int member, double sign) {
      if (member < 0) return;
      const auto m = static_cast<std::size_t>(member);
      moment[m] += V3<Number>(lanes.contacts[k].point - lanes.members[m].x).cross(shared.back()) * Number(sign);
    };
    add(contacts_[k].member_a, 1), add(contacts_[k].member_b, -1);
  }
  // shares stay without effect as arms move
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(wrenches_.rows(), GroupLanes::kColumns);
  for (std::size_t m = 0; m < moment.size(); ++m)
    for (int row = 0; row < 3; ++row)
      for (std::size_t lane = 0; lane < GroupLanes::kColumns; ++lane)
        left(6 * rowAt(m) + 3 + row, rowAt(lane)) = -moment[m][row].rate[lane];
  if (!left.isZero(0)) {
    const Eigen::MatrixXd moved = CompleteOrthogonal(wrenches_, kStationary).pseudoInverse() * left;
    for (std::size_t i = 0; i < stick_.size(); ++i)
      for (int row = 0; row < 3; ++row)
        for (std::size_t lane = 0; lane < GroupLanes::kColumns; ++lane) shared[i][row].rate[lane] = moved(3 * rowAt(i) + row, rowAt(lane));
  }
  Number sum = 0;
  for (const Weighted& w : weighted_) {
    const auto i = static_cast<std::size_t>(std::ranges::find(stick_, w.contact) - stick_.begin());
    const GroupLanes::Contact& c = lanes.contacts[w.contact];
    const V3<Number> f = forces.forces[w.contact] + shared[i];
    const Number pressing = c.n.dot(f);
    sum += Number(w.weight) * (w.lifts ? pressing : Number(c.friction * pressing - sqrt(V3<Number>(f - c.n * pressing).squaredNorm())));
  }
  return sum;
}

}  // namespace carom::adjoint_detail
