// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/impact/contact_part.hpp"
#include "adjoint/motion/body_geometry.h"

namespace carom::adjoint_detail {

/// What the guard of a transition is made of beyond its contacts' gaps, normals and points:
///   slip_ends: t . u at the first contact, t the direction of slip there, held: u is 0 at the root;
///   leaves: weight . (p - x - R border), (x, R) of a body whose feature ends there (see FeatureLimit);
///   of a path that is integrated: its own row, of the first participants.
template <class S>
struct EventGuard {
  std::shared_ptr<const PathGuard> by_path;
  bool by_slip = false;
  V3<S> slip = V3<S>::Zero();  // t
  int border_body = -1, border_participant = -1;
  V3<S> weight = V3<S>::Zero();         // world axes
  V3<S> border_arm = V3<S>::Zero();     // p - x
  VectorOf<S> border_rates;             // weight . R d(border)/d(size)

  /// That of a contact which comes to `limit` at `point`, where its body has the pose (x, R); `part` gets the weights of
  /// the contact.
  static EventGuard atBorder(const FeatureLimit& limit, int participant, const V3<S>& x, const M3<S>& R,
                             const V3<S>& point, ContactPart<S>& part) {
    EventGuard guard;
    guard.border_body = limit.body;
    guard.border_participant = participant;
    guard.border_arm = point - x;
    V3<S> weight = limit.point_weight.template cast<S>();
    if (limit.radius > 0) {  // towards the axis of the circle, wherever the point goes on it
      const V3<S> along = limit.axis.cross(limit.point_weight).template cast<S>();
      const V3<S> beside = R.transpose() * guard.border_arm - limit.border.template cast<S>();
      weight -= along * (along.dot(beside) / S(limit.radius));
    }
    guard.weight = R * weight;
    if (limit.border_rates.cols() > 0)
      guard.border_rates = Eigen::VectorXd(limit.border_rates.transpose() * limit.point_weight).template cast<S>();
    part.guard.template tail<3>() = guard.weight;
    return guard;
  }

  /// d/dt of its part of the guard, beyond that of the contacts.
  S rate(const ImpactPass<S>& impact, const std::vector<StateDerivativeOf<S>>& rates) const {
    S d = 0;
    if constexpr (std::is_same_v<S, double>) {
      if (by_path) {
        for (std::size_t i = 0; i < by_path->by_state.size(); ++i) d += by_path->by_state[i].dot(rates[i]);
        return d + by_path->by_time;
      }
    }
    if (by_slip) {  // A is that of a ball, or nothing turns
      const auto& c = impact.inputs().contacts[0];
      for (std::size_t i = 0; i < rates.size(); ++i) {
        const auto& b = impact.inputs().bodies[i];
        const double sign = static_cast<int>(i) == c.a ? 1 : -1;
        const M3<S> A = b.R * b.D * b.R.transpose();
        d += sign * slip.dot(V3<S>(rates[i].v + V3<S>(A * rates[i].L).cross(V3<S>(c.point - b.x))));
      }
    }
    if (border_participant >= 0) d += borderTangent(rates[static_cast<std::size_t>(border_participant)].x,
                                                    rates[static_cast<std::size_t>(border_participant)].theta);
    return d;
  }
  /// Of the border, where its body moves.
  S borderTangent(const V3<S>& dx, const V3<S>& dtheta) const {
    return -weight.dot(dx) - dtheta.dot(border_arm.cross(weight));
  }
};

/// Its part that the velocities at the contact have.
template <class S>
ImpactBars<S> slipPullback(const ImpactPass<S>& impact, const V3<S>& slip, const S& sigma) {
  ImpactBars<S> bars = impact.noBars();
  auto between = impact.nothingBetween();
  ImpactProblemDerivativeOf<S> problem(impact.problem().contacts());
  problem.u.template head<3>() = sigma * slip;
  impact.problemPullback(problem, between, bars);
  impact.betweenPullback(between, bars);
  return bars;
}

}  // namespace carom::adjoint_detail
