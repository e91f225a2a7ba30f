// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "adjoint/derivative/derivative_tape.h"

namespace carom {

/// What can be checked of a motion without believing how it was made.
struct Certificate {
  bool taken = false;  ///< false: nothing was checked (EditOptions::certify), the numbers below say nothing

  double residual = 0;         ///< largest |error| of a constraint in the motion simulated afresh, SI, units mixed
  double scaled_residual = 0;  ///< the same, dimensionless

  /// Largest |E(t) - E(start)| of a flight, over the largest kinetic energy and change of potential energy in it. E is
  /// the kinetic and potential energy of the body, taken at kEnergySamples instants of every flight and at its ends.
  double energy_drift = 0;
  /// Largest growth of the kinetic energy of the bodies of an impact, over what it was before; 0 where none grows.
  /// What a kinematic body gives, the impulse times the velocity of its surface, is not counted.
  double energy_gain = 0;

  /// How deep bodies overlap at the most, m, by the exact geometry of their shapes: at every impact, and at
  /// kOverlapSamples instants of every flight that lie closer towards its ends, of each body with all others. Nothing
  /// where the source of contacts does not know whole bodies (adjoint/motion/body_geometry.h).
  std::optional<double> deepest_penetration;

  Reliability reliability;  ///< of the derivatives of the constraints, worst row

  /// Length of the smallest change of the controls, in the norm that the edit minimises (its objective is 1/2 of its
  /// square), at which the impacts are predicted to be others, to first order; infinite where none is in sight. Seen
  /// are: impacts that come to graze, sticking that becomes sliding and the reverse, contacts that move over the border
  /// of their feature, impacts of one instant that part, impacts that change places, and impacts that come to lie on
  /// the other side of an instant that is held or of the end. Not seen: bodies, or parts of a compound, that would only
  /// then be met. Bounds of the controls do not count. Of the first kMarginEvents impacts.
  /// NaN, with a sentence below, where there are more than kMarginBodies bodies.
  double signature_radius = std::numeric_limits<double>::infinity();
  std::string signature_event;     ///< what happens there, a sentence; empty when the radius is infinite
  Eigen::VectorXd signature_step;  ///< the change that leads there, one number a control; empty when it is infinite
};

inline constexpr int kEnergySamples = 16, kOverlapSamples = 16;
inline constexpr std::size_t kMarginEvents = 60, kMarginBodies = 100;

}  // namespace carom
