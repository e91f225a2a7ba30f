// SPDX-License-Identifier: MIT
#include "adjoint/impact/laws.hpp"

#include "adjoint/impact/impact_pass.hpp"

// The impact laws in doubles, and with their rates along one direction.

namespace carom::adjoint_detail {

template FrictionTerms<double>::FrictionTerms(const ContactProblemOf<double>&);
template ImpactSolutionOf<double> solveLaw(const ImpactProblemOf<double>&);
template ImpactProblemDerivativeOf<double> lawPullback(const ImpactProblemOf<double>&, const VectorOf<double>&);
template ImpactSolutionOf<Dual<1>> solveLaw(const ImpactProblemOf<Dual<1>>&);

FromZero fromZero(const ImpactProblem& problem) {
  const Branch<double> branch(problem, true);
  return branch.cone ? fromZero(branch.cone->terms()) : FromZero();
}

}  // namespace carom::adjoint_detail
