// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/cone_terms.hpp"

namespace carom::adjoint_detail {

/// How far an impact is from where it has no derivative with respect to coefficients of friction that are 0.
struct FromZero {
  /// A body that does not slip sticks with the least friction: |P_t|/P_n of the untruncated impulse, and of several contacts
  /// the slowest slip of those that push without friction, as a share of the fastest speed at them; 1 where there is none.
  double margin = 1;
  /// Several contacts share their load as the least friction chooses: another sharing would rub the bodies in another way.
  bool shared = false;
};

/// Of several contacts. With t the directions of their slips and N their normals, loads z with K N z = 0 are free; friction
/// mu of them gives the velocities mu K t z, which have to be 0 for each of these z.
FromZero fromZero(const ConeTerms<double>& terms);

}  // namespace carom::adjoint_detail
