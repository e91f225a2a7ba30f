// SPDX-License-Identifier: MIT
#include "adjoint/group/group_force_rates.hpp"

namespace carom::adjoint_detail {
namespace {

using Number = GroupLanes::Number;

}  // namespace

GroupForceRates::GroupForceRates(const std::vector<GroupContact>& contacts, const GroupInstant& now, bool redundant) : contacts_(contacts) {
  forces_.solve(contacts, now, redundant);
  if (contacts.empty()) return;
  inverse_ = forces_.inverse();
  if (forces_.shares()) weights_ = forces_.shareWeights();
}

void GroupForceRates::add(const GroupLanes& lanes, std::size_t k, const V3<Number>& force, GroupForceLanes& out) const {
  const auto push = [&](int member, const V3<Number>& f) {
    if (member < 0) return;
    const auto m = static_cast<std::size_t>(member);
    out.acceleration[m] += f * lanes.members[m].inverse_mass;
    out.moment[m] += V3<Number>(lanes.contacts[k].point - lanes.members[m].x).cross(f);
  };
  out.forces[k] += force;
  push(contacts_[k].member_a, force);
  push(contacts_[k].member_b, -force);
}

GroupForceLanes GroupForceRates::in(const GroupLanes& lanes) const {
  GroupForceLanes out;
  out.forces.assign(contacts_.size(), V3<Number>::Zero());
  out.moment.assign(lanes.members.size(), V3<Number>::Zero());
  for (const GroupLanes::Member& m : lanes.members) out.acceleration.push_back(m.gravity);
  const auto of = [&](std::size_t k, const auto& y) -> V3<Number> {  // y of contact k as a force
    if (contacts_[k].mode == ContactMode::sticks) return V3<Number>(y[0], y[1], y[2]);
    return lanes.contacts[k].push() * y[0];
  };
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    std::array<Number, 3> y;
    for (int i = 0; i < (contacts_[k].mode == ContactMode::sticks ? 3 : 1); ++i) y[static_cast<std::size_t>(i)] = forces_.solution()[forces_.unknown(k) + i];
    add(lanes, k, of(k, y), out);
  }
  if (contacts_.empty()) return out;
  Rates r = rowRates(lanes, out), dy = Rates::Zero(r.rows(), r.cols());
  if (forces_.shares()) {
    const Rates shares = shareRates(lanes);
    dy = shares;
    r += forces_.matrix() * shares;
  }
  dy -= inverse_ * r;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    std::array<Number, 3> y;
    for (int i = 0; i < (contacts_[k].mode == ContactMode::sticks ? 3 : 1); ++i)
      for (std::size_t lane = 0; lane < GroupLanes::kColumns; ++lane)
        y[static_cast<std::size_t>(i)].rate[lane] = dy(forces_.unknown(k) + i, static_cast<Eigen::Index>(lane));
    add(lanes, k, of(k, y), out);
  }
  return out;
}

// Of the accelerations that the constraints keep at 0, under forces that are kept.
GroupForceRates::Rates GroupForceRates::rowRates(const GroupLanes& lanes, const GroupForceLanes& kept) const {
  std::vector<V3<Number>> spin_rate;
  for (std::size_t m = 0; m < lanes.members.size(); ++m) {
    const GroupLanes::Member& of = lanes.members[m];
    spin_rate.push_back(of.A * V3<Number>(kept.moment[m] - of.w.cross(of.L)));
  }
  Rates rates(forces_.solution().size(), GroupLanes::kColumns);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const GroupLanes::Contact& c = lanes.contacts[k];
    const auto rate = [&](int member, const V3<Number>& driven) -> V3<Number> {
      if (member < 0) return driven;
      const auto i = static_cast<std::size_t>(member);
      const GroupLanes::Member& m = lanes.members[i];
      return kept.acceleration[i] + spin_rate[i].cross(V3<Number>(c.point - m.x)) + m.w.cross(V3<Number>(c.point_rate - m.v));
    };
    const V3<Number> slip_rate = rate(contacts_[k].member_a, c.driven_a) - rate(contacts_[k].member_b, c.driven_b);
    const Eigen::Index row = forces_.unknown(k);
    if (contacts_[k].mode == ContactMode::sticks) {
      for (int i = 0; i < 3; ++i) takeRates(rates, row + i, slip_rate[i]);
    } else {
      takeRates(rates, row, c.n.dot(slip_rate) + c.normal_rate.dot(c.u));
    }
  }
  return rates;
}

// dS w: S the rows of the constraints, by the stiffness of their contacts.
GroupForceRates::Rates GroupForceRates::shareRates(const GroupLanes& lanes) const {
  Rates rates(forces_.solution().size(), GroupLanes::kColumns);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    V3<Number> moved = V3<Number>::Zero();
    Number compliance = 0;
    const auto add = [&](int member, double sign) {
      if (member < 0) return;
      const GroupLanes::Member& m = lanes.members[static_cast<std::size_t>(member)];
      const Vec3 turn = weights_.segment<3>(6 * member + 3) / forces_.shareArm();
      moved += V3<Number>(Vec3(weights_.segment<3>(6 * member)).cast<Number>() + V3<Number>(turn.cast<Number>()).cross(V3<Number>(lanes.contacts[k].point - m.x))) * Number(sign);
      compliance += m.inverse_mass;
    };
    add(contacts_[k].member_a, 1), add(contacts_[k].member_b, -1);
    moved = moved / compliance;
    const Eigen::Index row = forces_.unknown(k);
    if (contacts_[k].mode == ContactMode::sticks) {
      for (int i = 0; i < 3; ++i) takeRates(rates, row + i, moved[i]);
    } else {
      takeRates(rates, row, lanes.contacts[k].n.dot(moved));
    }
  }
  return rates;
}

}  // namespace carom::adjoint_detail
