// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "adjoint/contact/cone.hpp"
#include "adjoint/constrained/constrained_dynamics.hpp"

namespace carom::adjoint_detail {

/// How contacts without slip go on, as a convex program sees it.
struct ProgramModes {
  std::vector<ConeState> state;    ///< apex: off; inside: sticks; slides: begins to slip
  std::vector<Vec3> direction;     ///< of the slip that begins, a unit vector
};

/// Coulomb's law for contacts without slip, `C_mu contains f`, `u' + mu |u'_t| n in its dual cone`, f perpendicular to that: a
/// convex program for given |u'_t|, which are put in anew until `takes` is content with the modes (Acary, Cadoux, Lemarechal
/// and Malick 2011: there is a fixed point wherever forces within the cones can part all contacts). False: it never was.
bool modesByProgram(const BodyInstant<double>& body, const std::vector<ContactInstant<double>>& contacts,
                    const std::function<bool(const ProgramModes&)>& takes);

}  // namespace carom::adjoint_detail
