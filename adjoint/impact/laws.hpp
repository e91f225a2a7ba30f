// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/joint_pullback.hpp"
#include "adjoint/impact/law.hpp"
#include "adjoint/impact/single_laws.hpp"

/// The impact laws of law.hpp for any number. Derivatives along directions are the law itself in dual numbers; adjoints
/// are written by hand, and the dot-product tests hold one against the other.
namespace carom::adjoint_detail {

/// 4.1. Where the contact slips, friction that grows from 0 is 4.2 with a coefficient of 0: the same impulse, with its
/// derivatives with respect to friction.
struct FrictionlessLaw {
  template <class S>
  static ImpactSolutionOf<S> solve(const ImpactProblemOf<S>& p) {
    const ContactProblemOf<S> one = onlyContact(p);
    if constexpr (has_rates<S>) {
      const FrictionTerms<S> friction(one);
      if (slipsWithoutFriction(friction)) return {friction.impulse(), ImpactMode::frictionless, 1, {}, {}};
    }
    return {FrictionlessTerms<S>(one).impulse(), ImpactMode::frictionless, 1, {}, {}};
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
    return {t.impulse(), t.slides ? ImpactMode::slide : ImpactMode::stick, t.margin, {}, {}};
  }
  template <class S>
  static void pullback(const ImpactProblemOf<S>& p, const VectorOf<S>& P_bar, ImpactProblemDerivativeOf<S>& bar) {
    FrictionTerms<S>(onlyContact(p)).pullback(V3<S>(P_bar), bar);
  }
};

struct JointLaw {  // 4.4
  template <class S>
  static ImpactSolutionOf<S> solve(const ImpactProblemOf<S>& p) {
    const Branch<S> b(p, has_rates<S>);
    ImpactSolutionOf<S> solution{b.P, ImpactMode::joint, b.margin(), {}, {}, b.cone && b.cone->losesDigits()};
    for (int k = 0; k < p.contacts(); ++k) {
      const ConeState state = b.stateOf(k);
      solution.outcome.push_back(state == ConeState::apex     ? ContactOutcome::off
                                 : state == ConeState::inside ? ContactOutcome::sticks
                                                              : ContactOutcome::slides);
      const bool keeps = Branch<S>::isIn(b.normal_active, k) || Branch<S>::isIn(b.joined, k);
      const bool plastic = p.pair[static_cast<std::size_t>(k)].elasticity == S(0) || Branch<S>::isConstrained(p, k);
      solution.closed.push_back(keeps && plastic);
    }
    closeRedundant(p, solution.closed);
    return solution;
  }
  // What the closed contacts of a face hold is closed without an impulse of its own.
  template <class S>
  static void closeRedundant(const ImpactProblemOf<S>& p, std::vector<char>& closed) {
    Contacts holding, all;
    for (int k = 0; k < p.contacts(); ++k) {
      all.push_back(k);
      if (closed[static_cast<std::size_t>(k)]) holding.push_back(k);
    }
    if (holding.empty() || holding.size() == all.size()) return;
    const MatrixOf<S> N = normalsOf<S>(p, all);
    const auto A = valuesOf(MatrixOf<S>(N.transpose() * p.K * N));
    for (const int k : all)
      if (p.pair[static_cast<std::size_t>(k)].elasticity == S(0) && followsFrom<Value<S>>(A, holding, k))
        closed[static_cast<std::size_t>(k)] = 1;
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

/// One contact that is held: as though without elasticity, and without friction where it would pull.
template <class S>
ImpactProblemOf<S> asConstrained(ImpactProblemOf<S> p) {
  p.pair[0].elasticity = S(0);
  if (p.normal[0].dot(V3<S>(p.u)) > S(0)) p.pair[0].friction = S(0);
  p.held.clear();
  return p;
}
template <class S>
bool isOnePersistent(const ImpactProblemOf<S>& p) {
  return p.contacts() == 1 && !p.held.empty() && p.held[0];
}

template <class S>
ImpactSolutionOf<S> solveLaw(const ImpactProblemOf<S>& p) {
  if (isOnePersistent(p)) return solveLaw(asConstrained(p));
  auto solution = withLaw(p, [&](auto law) { return law.solve(p); });
  if (p.contacts() > 1) return solution;
  solution.outcome = {solution.mode == ImpactMode::stick ? ContactOutcome::sticks : ContactOutcome::slides};
  solution.closed = {p.pair[0].elasticity == S(0)};
  return solution;
}
template <class S>
ImpactProblemDerivativeOf<S> lawPullback(const ImpactProblemOf<S>& p, const VectorOf<S>& P_bar) {
  if (isOnePersistent(p)) {
    const ImpactProblemOf<S> held = asConstrained(p);
    ImpactProblemDerivativeOf<S> bar = lawPullback(held, P_bar);
    bar.pair[0].elasticity = S(0);
    if (!(held.pair[0].friction > S(0))) bar.pair[0].friction = S(0);
    return bar;
  }
  ImpactProblemDerivativeOf<S> bar(p.contacts());
  withLaw(p, [&](auto law) { law.pullback(p, P_bar, bar); });
  return bar;
}

}  // namespace carom::adjoint_detail
