// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "adjoint/derivative/tangent.h"
#include "adjoint/second_order/reading_direction.h"

namespace carom {

/// How the weights of the seeds change when the states that they are read from change at `rates`, one a seed, in which
/// the instants have moved along; what is returned holds one seed a seed, of which only the weights are read. Empty
/// where the weights are constant.
using SeedRates = std::function<std::vector<StateSeed>(std::span<const BodyStateRate> rates)>;

/// Whether second derivatives are known all through a motion. They are not where a body begins to tip,
/// slides against friction without turning, or moves on corners, edges or faces.
bool hasSecondOrder(const Motion& motion);

/// Derivatives, along each direction, of the gradient of the sum of the seeds.
struct SecondOrder {
  SceneGradient gradient;                     ///< adjoint(tape, seeds), where a direction is given
  std::vector<SceneGradient> gradient_rates;  ///< of it
  std::vector<Eigen::VectorXd> time_rates;    ///< of timeDerivative of each seed; 0 for those at events
};

/// Which rates are wanted: of the gradient by every number of the scene; or by those only that some direction varies,
/// which is cheaper. Those not wanted may be missing parts, and are good for nothing.
enum class RatesWanted { all, varied };

/// Exact second derivatives: the reverse pass with dual numbers, whose other half is the tangent along the directions.
/// Section 9 of docs/equations.md. Its cost is a few reverse passes a direction, whatever the number of seeds. The
/// matrix over all scene numbers and reading times is symmetric, but for orientations: world rotation vectors applied
/// one after another do not commute (equation 9.5), D_a (df.b) - D_b (df.a) = df.(b x a).
/// Throws InputError like `adjoint`, and NotComputable where !hasSecondOrder(motion).
SecondOrder secondOrder(DerivativeTape& tape, std::span<const StateSeed> seeds, const SeedRates& seed_rates,
                        std::span<const ReadingDirection> directions, RatesWanted wanted = RatesWanted::all);

}  // namespace carom
