// SPDX-License-Identifier: MIT
#include "adjoint/impact/laws.hpp"

#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/impact/law.hpp"

namespace carom::adjoint_detail {
namespace {

using Rate = Dual<1>;

ImpactProblemOf<Rate> along(const ImpactProblem& p, const ImpactProblemDerivative& d) {
  ImpactProblemOf<Rate> both{p.K.cast<Rate>(), p.u.cast<Rate>(), {}, {}, p.driven};
  setRates(both.K, d.K, 0);
  setRates(both.u, d.u, 0);
  for (std::size_t k = 0; k < p.normal.size(); ++k) {
    both.normal.push_back(p.normal[k].cast<Rate>());
    setRates(both.normal[k], d.normal[k], 0);
    PairCoefficientsOf<Rate>& pair =
        both.pair.emplace_back(p.pair[k].elasticity, p.pair[k].friction, p.pair[k].tangential_elasticity);
    pair.elasticity.rate[0] = d.pair[k].elasticity;
    pair.friction.rate[0] = d.pair[k].friction;
    pair.tangential_elasticity.rate[0] = d.pair[k].tangential_elasticity;
  }
  return both;
}

template <class Law>
Eigen::VectorXd tangentOf(const ImpactProblem& p, const ImpactProblemDerivative& d) {
  return ratesOf(Law::solve(along(p, d)).P, 0);
}

template <class Law>
constexpr ImpactLaw rowOf(const char* name) {
  return {name, &Law::template solve<double>, &tangentOf<Law>, &Law::template pullback<double>};
}

}  // namespace

const ImpactLaw kFrictionlessLaw = rowOf<FrictionlessLaw>("frictionless");
const ImpactLaw kFrictionLaw = rowOf<FrictionLaw>("friction");
const ImpactLaw kJointLaw = rowOf<JointLaw>("joint");

ContactSolution solveContact(const ContactProblem& problem) {
  if (lawOf(problem.pair) == Law::frictionless)
    return {FrictionlessTerms<double>(problem).impulse(), ImpactMode::frictionless, 1};
  const FrictionTerms<double> t(problem);
  return {t.impulse(), t.slides ? ImpactMode::slide : ImpactMode::stick, t.margin};
}

double frictionFromZeroMargin(const ContactProblem& problem) {
  const FrictionTerms<double> t(problem);
  return t.slides ? t.margin : 0;
}

template ImpactSolutionOf<double> adjoint_detail::solveLaw(const ImpactProblemOf<double>&);
template ImpactProblemDerivativeOf<double> adjoint_detail::lawPullback(const ImpactProblemOf<double>&,
                                                                       const VectorOf<double>&);
template ImpactSolutionOf<Rate> adjoint_detail::solveLaw(const ImpactProblemOf<Rate>&);

}  // namespace carom::adjoint_detail
