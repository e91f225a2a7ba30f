// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Contacts closer in time than it takes two bodies to move by this share of their size, in one contact graph, are one
/// instant (docs/equations.md section 4).
inline constexpr double kInstant = 1e-9;
/// An approach that is a smaller share of the speeds involved is none, nor is it a parting.
inline constexpr double kNeither = 1e-12;

/// What is measured by two bodies themselves, so that it is the same in other units, and whatever else there is.
struct PairScale {
  double length = 0;  ///< radius of the smaller one of those that impacts move, m
  double speed = 0;   ///< of one against the other, of what turns, and what gravity gives over the length, m/s

  /// s
  double instant() const { return speed > 0 ? kInstant * length / speed : 0; }
  /// m/s
  double neither() const { return kNeither * speed; }
};

/// Of all pairs of a scene.
class PairScales {
 public:
  PairScales(const Scene& scene, const std::vector<BodyModel>& models);

  /// At least one of the two can be moved by impacts. At a time that is known of both arcs.
  PairScale of(int a, int b, const Arc& arc_a, const Arc& arc_b, double t) const;
  /// Of the first contact of an event, on the arcs that it ends, s.
  double instantOf(const Motion& motion, const Event& event) const;
  /// The largest radius of a dynamic body, m; 0 without one.
  double largest() const { return largest_; }
  /// Of a body about its centre of mass, m; infinite for a plane.
  double radius(int body) const { return radius_[static_cast<std::size_t>(body)]; }
  /// No contact has a larger acceleration, but where something spins far faster than at the start, m/s^2: 1e5 g + 10 v^2/l.
  double mostAcceleration() const { return most_acceleration_; }
  /// Positions of the scene are known to about a tenth of this height, m: 1e-12 S, docs/collision.md.
  double leastHeight() const { return least_height_; }

 private:
  double gravity_, most_acceleration_ = 0, largest_ = 0, least_height_ = 0;
  std::vector<double> radius_;  // a body each, as are these
  std::vector<char> moved_;     // by impacts
};

}  // namespace carom::adjoint_detail
