// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "adjoint/derivative/derivative_tape.h"

namespace carom {

/// Checks of a motion that are independent of how it was computed.
struct Certificate {
  bool taken = false;  ///< false: nothing was checked (EditOptions::certify), the numbers below are unspecified

  double residual = 0;         ///< largest |error| of a constraint in the re-simulated motion, SI, mixed units
  double scaled_residual = 0;  ///< the same, dimensionless

  /// Largest |E(t) - E(start)| of a flight, over the largest kinetic energy and change of potential energy in it. E is
  /// the kinetic and potential energy of the body, taken at kEnergySamples instants of every flight and at its ends.
  double energy_drift = 0;
  /// Largest relative growth of the kinetic energy of the bodies of an impact; 0 if none grows. The work of a
  /// kinematic body, the impulse times the velocity of its surface, is not counted.
  double energy_gain = 0;

  /// Largest penetration depth of bodies, m, by the exact geometry of their shapes: at every impact, and at
  /// kOverlapSamples instants of every flight, denser towards its ends, of each body with all others. Empty if the
  /// contact source has no BodyGeometry (adjoint/motion/body_geometry.h).
  std::optional<double> deepest_penetration;

  Reliability reliability;  ///< of the derivatives of the constraints, worst row

  /// First-order distance to the nearest boundary of the impact sequence, in the norm that the edit minimises (its
  /// objective is 1/2 of the square); infinite if none is found. Covers impacts that become grazing, changes between
  /// sticking and sliding, contacts that leave their feature, simultaneous impacts that separate, impacts that change
  /// order, and impacts that cross a constrained instant or the end. Does not cover new impacts with bodies, or parts
  /// of a compound, that were not met. Ignores bounds of the controls. For the first kMarginEvents impacts. NaN, with
  /// a message below, for more than kMarginBodies bodies.
  double signature_radius = std::numeric_limits<double>::infinity();
  std::string signature_event;     ///< what happens there, a sentence; empty if infinite
  Eigen::VectorXd signature_step;  ///< the change that leads there, one number per control; empty if infinite
};

inline constexpr int kEnergySamples = 16;            ///< instants of a flight, see Certificate::energy_drift
inline constexpr int kOverlapSamples = 16;           ///< the same, see Certificate::deepest_penetration
inline constexpr std::size_t kMarginEvents = 60;     ///< impacts, see Certificate::signature_radius
inline constexpr std::size_t kMarginBodies = 100;    ///< bodies, likewise

}  // namespace carom
