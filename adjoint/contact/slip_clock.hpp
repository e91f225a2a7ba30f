// SPDX-License-Identifier: MIT
#pragma once

namespace carom::adjoint_detail {

/// The slip of a glide in plain numbers: speed P exp(-(c - a) xi) + Q exp(-(c + a) xi), dt = speed d xi.
struct SlipClock {
  double P, Q, a, c;
  double timeAt(double xi) const;
  double speedAt(double xi) const;
  /// Tangent of half the angle between slip and slope: it shrinks, and where it is nothing the rest is straight.
  double tiltAt(double xi) const;
  /// The xi of a time; of a path that ends, one before its end.
  double xiAt(double t) const;

 private:
  double xiBeforeEnd(double remaining) const;
};

}  // namespace carom::adjoint_detail
