// SPDX-License-Identifier: MIT
#include "adjoint/group/group_slip_ends.hpp"

#include <cmath>

#include "adjoint/constrained/constrained_slip_ends.hpp"
#include "adjoint/constrained/straight_slips.hpp"
#include "adjoint/group/group_rates.hpp"
#include "adjoint/group/group_start_derivative.hpp"
#include "adjoint/group/group_stretches.hpp"

namespace carom::adjoint_detail {
namespace {

// Contacts whose slips are 0 at the end of a path: that which ends it, first, and those that come to their end with it.
std::vector<std::size_t> contactsThatStop(const GroupPath& path, const GroupInstant& now) {
  const std::optional<std::size_t> first = path.contactThatStops();
  const auto stops = [&](std::size_t k) {
    return path.contacts()[k].turns() && now.contacts[k].slipVelocity().norm() <= kNoDirectionLeft * path.scene().speed;
  };
  if (!first || !stops(*first)) return {};
  std::vector<std::size_t> found{*first};
  for (std::size_t k = 0; k < path.contacts().size(); ++k)
    if (k != *first && stops(k)) found.push_back(k);
  return found;
}

}  // namespace

std::optional<GroupSlipTurns> slipTurns(const GroupPath& path, const GroupInputs& inputs, double t) {
  const GroupInstant now = path.instantAt(t);
  const std::vector<std::size_t> stop = contactsThatStop(path, now);
  if (stop.empty()) return std::nullopt;
  GroupForces forces;
  forces.solve(path.contacts(), now, path.redundant());
  GroupSlipTurns out;
  out.turned.resize(rowAt(stop.size()), rowAt(stop.size()));
  out.change.setZero(inputs.states(), rowAt(stop.size()));
  for (std::size_t j = 0; j < stop.size(); ++j) {
    const GroupContact& of = path.contacts()[stop[j]];
    double compliance = 0;
    for (const int m : {of.member_a, of.member_b})
      if (m >= 0) compliance += now.members[static_cast<std::size_t>(m)].inverse_mass;
    const double size = compliance * of.friction * std::abs(forces.pressing(stop[j]));
    const Eigen::VectorXd answer = forces.answerToTurn(stop[j]);
    for (std::size_t m = 0; m < now.members.size(); ++m) {
      out.change.col(rowAt(j)).segment<3>(12 * rowAt(m) + 6) = now.members[m].inverse_mass / size * answer.segment<3>(6 * rowAt(m));
      out.change.col(rowAt(j)).segment<3>(12 * rowAt(m) + 9) = answer.segment<3>(6 * rowAt(m) + 3) / size;
    }
    for (std::size_t i = 0; i < stop.size(); ++i)
      out.turned(rowAt(i), rowAt(j)) = acrossSlip(now, stop[i]).dot(forces.responseAt(answer, stop[i])) / size;
  }
  if (!SlipTurns::turns(out.turned)) return std::nullopt;
  out.across.resize(rowAt(stop.size()), inputs.count);
  const std::vector<State> states = path.statesAt(t);
  GroupRates rates(path.scene(), path.contacts(), inputs, states, t, followSlips(path));
  rates.each([&](const GroupLanes& lanes, int first, int count) {
    for (std::size_t i = 0; i < stop.size(); ++i)
      for (int lane = 0; lane < count; ++lane)
        out.across(rowAt(i), first + lane) = acrossSlip(now, stop[i]).dot(ratesOf(lanes.contacts[stop[i]].u, static_cast<std::size_t>(lane)));
  });
  return out;
}

}  // namespace carom::adjoint_detail
