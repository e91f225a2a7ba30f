// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/joint_law.hpp"
#include "adjoint/impact/law.hpp"
#include "adjoint/impact/single_laws.hpp"

/// The impact laws of law.hpp for any number. Derivatives along directions are the law itself in dual numbers; adjoints
/// are written by hand, and the dot-product tests hold one against the other.
namespace carom::adjoint_detail {

template <class S>
inline constexpr bool has_rates = !std::is_same_v<S, Value<S>>;

/// 4.1. Where the contact slips, friction that grows from 0 is 4.2 with a coefficient of 0: the same impulse, with its
/// derivatives by friction.
struct FrictionlessLaw {
  template <class S>
  static ImpactSolutionOf<S> solve(const ImpactProblemOf<S>& p) {
    const ContactProblemOf<S> one = onlyContact(p);
    if constexpr (has_rates<S>) {
      const FrictionTerms<S> friction(one);
      if (slipsWithoutFriction(friction)) return {friction.impulse(), ImpactMode::frictionless, 1};
    }
    return {FrictionlessTerms<S>(one).impulse(), ImpactMode::frictionless, 1};
  }
  template <class S>
  static void pullback(const ImpactProblemOf<S>& p, const VectorOf<S>& P_bar, ImpactProblemDerivativeOf<S>& bar) {
    const ContactProblemOf<S> one = onlyContact(p);
    const FrictionTerms<S> friction(one);
    const bool slips = slipsWithoutFriction(friction);
    if (has_rates<S> && slips) return friction.pullback(V3<S>(P_bar), bar);
    FrictionlessTerms<S>(one).pullback(V3<S>(P_bar), bar);
    if (slips) bar.pair[0].friction += rateByFrictionFromZero(friction).dot(V3<S>(P_bar));
  }
};

struct FrictionLaw {  // 4.2
  template <class S>
  static ImpactSolutionOf<S> solve(const ImpactProblemOf<S>& p) {
    const FrictionTerms<S> t(onlyContact(p));
    return {t.impulse(), t.slides ? ImpactMode::slide : ImpactMode::stick, t.margin};
  }
  template <class S>
  static void pullback(const ImpactProblemOf<S>& p, const VectorOf<S>& P_bar, ImpactProblemDerivativeOf<S>& bar) {
    FrictionTerms<S>(onlyContact(p)).pullback(V3<S>(P_bar), bar);
  }
};

struct JointLaw {  // 4.3
  template <class S>
  static ImpactSolutionOf<S> solve(const ImpactProblemOf<S>& p) {
    const Branch<S> b(p);
    return {b.P_N + b.kappa * b.d, ImpactMode::joint, b.limit < 0 ? b.margin : 1.0};
  }
  template <class S>
  static void pullback(const ImpactProblemOf<S>& p, const VectorOf<S>& P_bar, ImpactProblemDerivativeOf<S>& bar) {
    jointPullback<S>(p, P_bar, bar);
  }
};

/// Calls visit(law) with the law that a problem falls under.
template <class S, class Visit>
auto withLaw(const ImpactProblemOf<S>& p, const Visit& visit) {
  if (p.contacts() > 1) return visit(JointLaw());
  if (p.pair[0].friction > 0) return visit(FrictionLaw());
  return visit(FrictionlessLaw());
}

template <class S>
ImpactSolutionOf<S> solveLaw(const ImpactProblemOf<S>& p) {
  return withLaw(p, [&](auto law) { return law.solve(p); });
}
template <class S>
ImpactProblemDerivativeOf<S> lawPullback(const ImpactProblemOf<S>& p, const VectorOf<S>& P_bar) {
  ImpactProblemDerivativeOf<S> bar(p.contacts());
  withLaw(p, [&](auto law) { law.pullback(p, P_bar, bar); });
  return bar;
}

}  // namespace carom::adjoint_detail
