// SPDX-License-Identifier: MIT
#include "adjoint/impact/double_double_pass.hpp"
#include "adjoint/second_order/dual_state.hpp"

// The reverse pass of impacts of 32 digits with the rates of second derivatives.

namespace carom::adjoint_detail {

template ImpactBars<Num> doubleDoubleImpactPullback(const ImpactInputs<Num>&, const std::vector<StateBar>&);

}  // namespace carom::adjoint_detail
