// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/constrained/constrained_dynamics.hpp"
#include "adjoint/constrained/constrained_rates.hpp"

namespace carom::adjoint_detail {

/// The forces at contacts that last, and what the body does under them, with their rates along some inputs.
struct ForceLanes {
  using Number = ConstrainedLanes::Number;
  std::vector<V3<Number>> forces;  ///< on the body, of each contact
  V3<Number> acceleration, moment;

  const V3<Number>& force(std::size_t k) const { return forces[k]; }  // as shareOf asks
};

/// By the implicit function theorem: with the forces y kept as they are, rows r = b + B y of the constraints come to have
/// the rates db + dB y, which cost no more than the rows themselves, and at constant rank
///   dy = -B^+ (db + dB y) + (1 - B^+ B) dB^T B^+^T y.
class ConstrainedForceRates {
 public:
  /// `now` has to live as long; `redundant` as of ConstrainedDynamics.
  ConstrainedForceRates(const ConstrainedInstant& now, bool redundant);

  /// At the same instant.
  ForceLanes in(const ConstrainedLanes& lanes) const;

 private:
  using Number = ConstrainedLanes::Number;
  using Rates = Eigen::Matrix<double, Eigen::Dynamic, ConstrainedLanes::kColumns>;

  Rates rowRates(const ConstrainedLanes& lanes, const ForceLanes& kept) const;
  Rates leastNormRates(const ConstrainedLanes& lanes) const;

  const ConstrainedInstant& now_;
  Eigen::MatrixXd inverse_;
  ConstrainedDynamics dynamics_;
  bool redundant_;
  Eigen::MatrixXd without_effect_;  // 1 - B^+ B
  Eigen::VectorXd weights_;         // B^+^T y
};

/// The value of a guard up to a factor, with its rates (see guardValue).
ConstrainedLanes::Number guardRateOf(const ConstrainedGuard& guard, const ConstrainedPath& path, const ConstrainedInputs& inputs,
                                     const ConstrainedForceRates& force_rates, const ConstrainedLanes& lanes, int first, int count,
                                     const ConstrainedRates& rates);

}  // namespace carom::adjoint_detail
