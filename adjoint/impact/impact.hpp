// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/impact/law.hpp"
#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

template <class S>
struct ImpactInputs;

/// What the impulse of an event depends on: its contacts, and its participants with their states before.
ImpactInputs<double> impactInputs(const Event& event, const std::vector<BodyModel>& models);

/// Tangent of (states before, contacts, coefficients, models) -> states after: the impact itself in numbers that carry
/// their rates. `dcontact[k]` holds d(gap, normal of the impulse, point) of contact k, `dsurface[k]` d(surface velocity); all
/// others are of participants.
/// `wide`: with 32 digits, see double_double_impact.hpp.
std::vector<StateDerivative> impactTangent(const ImpactInputs<double>& inputs, bool wide,
                                           const std::vector<StateDerivative>& dbefore,
                                           const std::vector<Eigen::Matrix<double, 7, 1>>& dcontact,
                                           const std::vector<Vec3>& dsurface,
                                           const std::vector<PairCoefficients>& dpair,
                                           const std::vector<BodyModelDerivative>& dmodel);

/// Tangent of the velocity of the first contact's bodies relative to each other, where it moves along with them.
Vec3 velocityTangent(const ImpactInputs<double>& inputs, const std::vector<StateDerivative>& dbefore,
                     const Eigen::Matrix<double, 7, 1>& dcontact, const std::vector<BodyModelDerivative>& dmodel);

/// Fills in impulses, mode, approach, margins and which contacts part without speed (`lasts`) of an event and gives the
/// states of its participants after it. Throws
/// NotComputable where these are not finite numbers, and where a contact does not part as fast as its elasticity says.
void solveImpact(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after);

}  // namespace carom::adjoint_detail
