// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_inputs.hpp"

namespace carom::adjoint_detail {

/// An instant of a path in numbers that carry the rates along some of its inputs.
struct ConstrainedLanes {
  static constexpr int kColumns = 12;  ///< at a time
  using Number = Dual<kColumns>;
  V3<Number> x;
  M3<Number> R;  // shape axes to world
  BodyInstant<Number> body;
  std::vector<ContactInstant<Number>> contacts;
  std::vector<Number> gap;
};

/// Puts the rates of a number into a row.
template <class Rates>
void takeRates(Rates& rates, Eigen::Index row, const ConstrainedLanes::Number& x) {
  for (std::size_t i = 0; i < x.rate.size(); ++i) rates(row, static_cast<Eigen::Index>(i)) = x.rate[i];
}

}  // namespace carom::adjoint_detail
