// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/constrained/constrained_contact.hpp"
#include "adjoint/constrained/constrained_dynamics.hpp"

namespace carom::adjoint_detail {

/// The body and its contacts at one instant of a path, in doubles.
struct ConstrainedInstant {
  BodyInstant<double> body;
  std::vector<ContactInstant<double>> contacts;
  std::vector<double> gap_rate;

  /// Against what it touches.
  Vec3 velocityAt(std::size_t k) const { return body.relativeVelocity(contacts[k]); }
  Vec3 slipAt(std::size_t k) const {
    const Vec3 u = velocityAt(k), &n = contacts[k].n;
    return u - n.dot(u) * n;
  }
};

/// All but the directions of slip at time t, in the storage that `now` has. R: of the state.
void placeInstant(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& state, const Mat3& R,
                  double t, ConstrainedInstant& now);
/// `slip`: a direction for each contact.
ConstrainedInstant instantOf(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& state,
                      double t, const std::vector<Vec3>& slip);

/// The part of a direction along the plane of a normal, of unit length.
inline Vec3 inPlane(const Vec3& d, const Vec3& n) { return (d - n.dot(d) * n).normalized(); }

}  // namespace carom::adjoint_detail
