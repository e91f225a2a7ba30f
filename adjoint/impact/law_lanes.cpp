// SPDX-License-Identifier: MIT
#include "adjoint/detail/dual_state.hpp"
#include "adjoint/detail/impact_pass.hpp"
#include "adjoint/detail/laws.hpp"

// The impact laws with the rates of second derivatives.

namespace carom::detail {

template ImpactSolutionOf<Num> solveLaw(const ImpactProblemOf<Num>&);
template ImpactProblemDerivativeOf<Num> lawPullback(const ImpactProblemOf<Num>&, const VectorOf<Num>&);

}  // namespace carom::detail
