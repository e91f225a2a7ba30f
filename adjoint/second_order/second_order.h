// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "adjoint/derivative/tangent.h"
#include "adjoint/second_order/reading_direction.h"

namespace carom {

/// Rates of the weights of the seeds for given `rates` of the states that are read, one per seed, at the moving
/// instants; returns one StateSeed per seed, of which only the weights are used. Empty: constant weights.
using SeedRates = std::function<std::vector<StateSeed>(std::span<const BodyStateRate> rates)>;

/// Whether second derivatives are implemented for all of a motion. They are not where a body begins to tip, slides
/// with friction without rotating, or moves on corners, edges or faces.
bool hasSecondOrder(const Motion& motion);

/// Directional derivatives of the gradient of the seeded functional.
struct SecondOrder {
  SceneGradient gradient;                     ///< adjoint(tape, seeds), if there is a direction
  std::vector<SceneGradient> gradient_rates;  ///< its derivative along each direction
  std::vector<Eigen::VectorXd> time_rates;    ///< of timeDerivative of each seed; 0 for those at events
};

/// Which entries of gradient_rates are computed: those of all scene parameters; or only those of parameters that some
/// direction varies, which is cheaper. The other entries are then unspecified.
enum class RatesWanted { all, varied };

/// Exact second derivatives, forward over reverse: the reverse pass in dual numbers whose dual part is the tangent
/// along a direction. Section 9 of docs/equations.md. Costs a few reverse passes per direction, independent of the
/// number of seeds. The matrix over all scene parameters and reading times is symmetric except for orientations:
/// successive world rotation vectors do not commute (equation 9.5), D_a (df.b) - D_b (df.a) = df.(b x a). Throws
/// InputError like `adjoint`, and NotComputable if !hasSecondOrder(motion).
SecondOrder secondOrder(DerivativeTape& tape, std::span<const StateSeed> seeds, const SeedRates& seed_rates,
                        std::span<const ReadingDirection> directions, RatesWanted wanted = RatesWanted::all);

}  // namespace carom
