// SPDX-License-Identifier: MIT
#include "adjoint/constrained/border_rate.hpp"
#include "adjoint/constrained/constrained_force_rates.hpp"
#include "adjoint/constrained/constrained_share.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {
namespace {

using LaneNumber = ConstrainedLanes::Number;

LaneNumber borderRate(const ConstrainedGuard& guard, const ConstrainedPath& path, const ConstrainedInputs& inputs, const ConstrainedLanes& lanes,
                  int first, int count, const ConstrainedRates& rates) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const PersistentContact& held = path.contacts()[k];
  const ConstrainedInputs::Partner& partner = inputs.partners[inputs.partner_of[k]];
  const ContactInstant<LaneNumber>& c = lanes.contacts[k];
  const V3<LaneNumber> point = lanes.x + c.r, n = held.is_first ? c.n : V3<LaneNumber>(-c.n);
  if (guard.border.body != held.with)
    return borderRateOf(guard.border, lanes.x, lanes.R, {ConstrainedInputs::kSizes - first, inputs.size_count}, point, n);
  const auto support = inputs.supportOf<LaneNumber>(path.scene().with[k], k, first, count, rates.flow(k));
  return borderRateOf(guard.border, support.x, support.R, {partner.sizes - first, partner.size_count}, point, n);
}

LaneNumber roomOf(const ContactInstant<LaneNumber>& c, const V3<LaneNumber>& force) {
  const LaneNumber pressing = c.n.dot(force);
  return c.friction * pressing - sqrt(V3<LaneNumber>(force - c.n * pressing).squaredNorm());
}

// At the best share the least room does not change with what contacts push against each other, so pushes may change in
// any way that leaves them without sum and moment, as arms move: by the least.
LaneNumber sharedRate(const ConstrainedShare& share, const std::vector<ContactInstant<LaneNumber>>& contacts,
                  const ForceLanes& forces) {
  const auto n = static_cast<Eigen::Index>(share.contact.size());
  Eigen::MatrixXd W(6, 3 * n);
  V3<LaneNumber> moment = V3<LaneNumber>::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto ii = static_cast<std::size_t>(i);
    const V3<LaneNumber>& r = contacts[share.contact[ii]].r;
    W.middleCols<3>(3 * i) << Mat3::Identity(), skew(Vec3(r.unaryExpr([](const LaneNumber& x) { return x.value; })));
    moment += r.cross(V3<LaneNumber>(share.push[ii].cast<LaneNumber>()));
  }
  Eigen::MatrixXd left(6, ConstrainedLanes::kColumns);
  left.setZero();
  for (int row = 0; row < 3; ++row)
    for (int lane = 0; lane < ConstrainedLanes::kColumns; ++lane)
      left(3 + row, lane) = -moment[row].rate[static_cast<std::size_t>(lane)];
  const Eigen::MatrixXd pushed = CompleteOrthogonal(W, 1e-9).pseudoInverse() * left;
  LaneNumber room = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto ii = static_cast<std::size_t>(i);
    if (!(share.weight[ii] > 0)) continue;
    const ContactInstant<LaneNumber>& c = contacts[share.contact[ii]];
    V3<LaneNumber> force = forces.force(share.contact[ii]) + V3<LaneNumber>(share.push[ii].cast<LaneNumber>());
    for (int row = 0; row < 3; ++row)
      for (int lane = 0; lane < ConstrainedLanes::kColumns; ++lane)
        force[row].rate[static_cast<std::size_t>(lane)] += pushed(3 * i + row, lane);
    const LaneNumber pressing = c.n.dot(force);
    room += LaneNumber(share.weight[ii]) * c.friction * pressing +
            V3<LaneNumber>(share.turn[ii].cast<LaneNumber>()).dot(V3<LaneNumber>(force - c.n * pressing));
  }
  return room;
}

}  // namespace

LaneNumber guardRateOf(const ConstrainedGuard& guard, const ConstrainedPath& path, const ConstrainedInputs& inputs,
                       const ConstrainedForceRates& force_rates, const ConstrainedLanes& lanes, int first, int count,
                       const ConstrainedRates& rates) {
  const auto k = static_cast<std::size_t>(guard.contact);
  const ContactInstant<LaneNumber>& c = lanes.contacts[k];
  if (guard.cause == TransitionCause::leaves) return borderRate(guard, path, inputs, lanes, first, count, rates);
  if (guard.cause == TransitionCause::sticks) return c.slip.dot(lanes.body.relativeVelocity(c));
  const ForceLanes forces = force_rates.in(lanes);
  const bool slips = guard.cause == TransitionCause::slips;
  if (c.mode == ContactMode::sticks)  // a force that comes to 0 leaves no room either
    if (const auto share = shareOf<LaneNumber>(lanes.contacts, forces)) return sharedRate(*share, lanes.contacts, forces);
  return slips ? roomOf(c, forces.force(k)) : c.n.dot(forces.force(k));
}

}  // namespace carom::adjoint_detail
