// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/held/held_dynamics.hpp"
#include "adjoint/held/held_rates.hpp"

namespace carom::adjoint_detail {

/// The forces at contacts that last, and what the body does under them, with their rates along some inputs.
struct ForceLanes {
  using Number = HeldLanes::Number;
  std::vector<V3<Number>> forces;  ///< on the body, of each contact
  V3<Number> acceleration, moment;

  const V3<Number>& force(std::size_t k) const { return forces[k]; }  // as shareOf asks
};

/// By the implicit function theorem: with the forces y kept as they are, rows r = b + B y of the constraints come to have
/// the rates db + dB y, which cost no more than the rows themselves, and at constant rank
///   dy = -B^+ (db + dB y) + (1 - B^+ B) dB^T B^+^T y.
class HeldForceRates {
 public:
  /// `now` has to live as long; `redundant` as of HeldDynamics.
  HeldForceRates(const HeldInstant& now, bool redundant);

  /// At the same instant.
  ForceLanes in(const HeldLanes& lanes) const;

 private:
  using Number = HeldLanes::Number;
  using Rates = Eigen::Matrix<double, Eigen::Dynamic, HeldLanes::kColumns>;

  Rates rowRates(const HeldLanes& lanes, const ForceLanes& kept) const;
  Rates leastNormRates(const HeldLanes& lanes) const;

  const HeldInstant& now_;
  Eigen::MatrixXd inverse_;
  HeldDynamics dynamics_;
  bool redundant_;
  Eigen::MatrixXd without_effect_;  // 1 - B^+ B
  Eigen::VectorXd weights_;         // B^+^T y
};

/// The value of a guard up to a factor, with its rates (see guardValue).
HeldLanes::Number guardRateOf(const HeldGuard& guard, const HeldPath& path, const HeldInputs& inputs,
                              const HeldForceRates& force_rates, const HeldLanes& lanes, int first, int count);

}  // namespace carom::adjoint_detail
