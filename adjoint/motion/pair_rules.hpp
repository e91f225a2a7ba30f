// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "adjoint/motion/plan.h"

/// How two materials make the coefficients of a pair, for any number.
namespace carom::adjoint_detail {

template <class S>
struct Rule {
  S value, by_a, by_b;
};

// The pair's coefficient and its derivatives with respect to those of the two materials. On a tie of minimum or maximum each material
// has half of the derivative.
template <class S>
Rule<S> combined(Combine rule, const S& a, const S& b) {
  if (rule == Combine::average) return {0.5 * (a + b), 0.5, 0.5};
  if (rule == Combine::multiply) return {a * b, b, a};
  if (a == b) return {a, 0.5, 0.5};
  const bool takes_a = (a < b) == (rule == Combine::minimum);
  return takes_a ? Rule<S>{a, 1, 0} : Rule<S>{b, 0, 1};
}

template <class S>
struct PairRules {
  Rule<S> elasticity, friction, tangential;

  PairRules() = default;
  // The coefficients of the materials stand in the fields of `of_a` and `of_b`.
  PairRules(const Material& a, const Material& b, const MaterialDerivativeOf<S>& of_a,
            const MaterialDerivativeOf<S>& of_b)  // the enumerators stand in the order of precedence
      : elasticity(combined(std::min(a.combine_elasticity, b.combine_elasticity), of_a.elasticity, of_b.elasticity)),
        friction(combined(std::min(a.combine_friction, b.combine_friction), of_a.friction, of_b.friction)),
        tangential(combined(Combine::average, of_a.tangential_elasticity, of_b.tangential_elasticity)) {}

  PairCoefficientsOf<S> values() const { return {elasticity.value, friction.value, tangential.value}; }
  PairCoefficientsOf<S> tangent(const MaterialDerivativeOf<S>& da, const MaterialDerivativeOf<S>& db) const {
    return {elasticity.by_a * da.elasticity + elasticity.by_b * db.elasticity,
            friction.by_a * da.friction + friction.by_b * db.friction,
            tangential.by_a * da.tangential_elasticity + tangential.by_b * db.tangential_elasticity};
  }
  void pullback(const PairCoefficientsOf<S>& pair_bar, MaterialDerivativeOf<S>& a_bar,
                MaterialDerivativeOf<S>& b_bar) const {
    a_bar.elasticity += elasticity.by_a * pair_bar.elasticity;
    b_bar.elasticity += elasticity.by_b * pair_bar.elasticity;
    a_bar.friction += friction.by_a * pair_bar.friction;
    b_bar.friction += friction.by_b * pair_bar.friction;
    a_bar.tangential_elasticity += tangential.by_a * pair_bar.tangential_elasticity;
    b_bar.tangential_elasticity += tangential.by_b * pair_bar.tangential_elasticity;
  }
};

inline MaterialDerivative coefficientsOf(const Material& m) {
  return {m.elasticity, m.friction, m.tangential_elasticity};
}
inline PairRules<double> rulesOf(const Material& a, const Material& b) {
  return {a, b, coefficientsOf(a), coefficientsOf(b)};
}

}  // namespace carom::adjoint_detail
