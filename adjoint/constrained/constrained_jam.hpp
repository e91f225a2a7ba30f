// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_dynamics.hpp"

namespace carom::adjoint_detail {

/// A proof that contacts jam (Painleve): weights w >= 0 of them, of sum 1, by which every force that Coulomb's law allows there
/// has w.alpha <= w.b < 0, alpha the accelerations of their gaps and b those without forces. So no forces keep all of them from
/// going deeper (Farkas' lemma), whichever of them stick, slide or part.
struct ConstrainedJam {
  std::vector<double> weight;  ///< of each contact
  double deeper = 0;           ///< m/s^2: -w.b
};

/// None: it is not proved. Contacts that stick may have any force within a pyramid around their cone of friction, those that
/// slide along n - mu d alone.
std::optional<ConstrainedJam> jamOf(const BodyInstant<double>& body, const std::vector<ContactInstant<double>>& contacts);

}  // namespace carom::adjoint_detail
