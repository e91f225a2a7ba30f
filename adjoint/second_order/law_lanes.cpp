// SPDX-License-Identifier: MIT
#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/impact/laws.hpp"
#include "adjoint/second_order/dual_state.hpp"

// The impact laws with the rates of second derivatives.

namespace carom::adjoint_detail {

template ImpactSolutionOf<Num> solveLaw(const ImpactProblemOf<Num>&);
template ImpactProblemDerivativeOf<Num> lawPullback(const ImpactProblemOf<Num>&, const VectorOf<Num>&);

}  // namespace carom::adjoint_detail
