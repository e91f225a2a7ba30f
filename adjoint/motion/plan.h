// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/flight/arc.h"
#include "adjoint/scene/scene.h"

namespace carom {

/// What will be asked of one body of a motion: the less, the cheaper the model that is exact for it.
struct Asked {
  bool orientation = true;  ///< its orientation, or a point fixed to it
  bool inertia = true;      ///< derivatives by moments (or sizes) that vary one by one
};

/// Impact law of a pair (docs/equations.md section 4).
enum class Law { frictionless, friction };

/// Coefficients in force between two bodies, after combination of their materials.
template <class S>
struct PairCoefficientsOf {
  S elasticity = 0;             ///< e, 0 to 1
  S friction = 0;               ///< Coulomb coefficient mu
  S tangential_elasticity = 0;  ///< e_t, -1 to 1

  /// Field by field.
  PairCoefficientsOf& operator+=(const PairCoefficientsOf& o) {
    elasticity += o.elasticity, friction += o.friction, tangential_elasticity += o.tangential_elasticity;
    return *this;
  }
};
using PairCoefficients = PairCoefficientsOf<double>;  ///< of a motion
/// The coefficients of two materials in contact, by the rules that they name.
PairCoefficients combine(const Material& a, const Material& b);

/// How one body is computed, and why.
struct BodyPlan {
  Tier tier = Tier::triaxial;             ///< of the motion
  Tier derivative_tier = Tier::triaxial;  ///< of the tangent and adjoint passes
  bool derivative_products = false;       ///< these need products of inertia: principal axes turn in the shape
  const char* why = "";                   ///< the tier of the motion, in words
  const char* derivative_why = "";        ///< the tier of the derivatives, in words
};

/// What each body and pair got. Pairs are not listed one by one: law(a, b) answers.
struct Plan {
  std::vector<BodyPlan> bodies;  ///< one a body
};

/// Chooses the cheapest tiers that are exact for what is asked. An empty `asked` asks for everything of every body.
Plan makePlan(const Scene& scene, const std::vector<Asked>& asked = {});

/// Friction unless its coefficient is 0.
Law lawOf(const PairCoefficients& pair);

}  // namespace carom
