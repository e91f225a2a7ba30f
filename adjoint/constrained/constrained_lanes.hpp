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

}  // namespace carom::adjoint_detail
