// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/impact/laws.hpp"

/// doubleDoubleImpact and doubleDoubleImpactPullback of impact_pass.hpp. Each kind of number takes a minute of compilation, and so has
/// a file of its own.
namespace carom::adjoint_detail {

/// The number of 32 digits for a number of 16: DoubleDouble, or Dual<N, DoubleDouble>.
template <class S>
struct DoubleDoubleOf {
  using Type = DoubleDouble;
};
template <int N>
struct DoubleDoubleOf<Dual<N>> {
  using Type = Dual<N, DoubleDouble>;
};

template <class T, class S>
PairCoefficientsOf<T> castPair(const PairCoefficientsOf<S>& p) {
  return {static_cast<T>(p.elasticity), static_cast<T>(p.friction), static_cast<T>(p.tangential_elasticity)};
}

template <class S>
auto doubleDoublePass(const ImpactInputs<S>& inputs) {
  using W = typename DoubleDoubleOf<S>::Type;
  ImpactInputs<W> wide;
  for (const auto& b : inputs.bodies)
    wide.bodies.push_back({b.kinematic, b.stays, W(b.inverse_mass), b.R.template cast<W>(), b.D.template cast<W>(),
                           b.x.template cast<W>(), b.v.template cast<W>(), b.L.template cast<W>()});
  for (const auto& c : inputs.contacts)
    wide.contacts.push_back({c.a, c.b, c.point.template cast<W>(), c.normal.template cast<W>(), castPair<W>(c.pair),
                             c.kept, c.surface.template cast<W>(), c.surface_moves});
  return ImpactPass<W>(std::move(wide));
}

template <class S>
ImpactOutcome<S> doubleDoubleImpact(const ImpactInputs<S>& inputs) {
  const auto pass = doubleDoublePass(inputs);
  const auto solution = pass.solve();
  ImpactOutcome<S> out{{solution.P.template cast<S>(), solution.mode, solution.stick_slip_margin, solution.outcome,
                        solution.closed, solution.loses_digits},
                       {}};
  for (const auto& b : pass.after(solution.P)) out.after.push_back({b.v.template cast<S>(), b.L.template cast<S>()});
  return out;
}

template <class S>
ImpactBars<S> doubleDoubleImpactPullback(const ImpactInputs<S>& inputs, const std::vector<StateDerivativeOf<S>>& after_bar) {
  using W = typename DoubleDoubleOf<S>::Type;
  const auto castState = []<class T>(T, const auto& b) {
    return StateDerivativeOf<T>{b.x.template cast<T>(), b.theta.template cast<T>(), b.v.template cast<T>(),
                                b.L.template cast<T>()};
  };
  const auto pass = doubleDoublePass(inputs);
  std::vector<StateDerivativeOf<W>> after;
  for (const auto& b : after_bar) after.push_back(castState(W(), b));
  const auto bars = pass.pullback(pass.solve().P, after);
  ImpactBars<S> out;
  for (const auto& b : bars.before) out.before.push_back(castState(S(), b));
  for (const auto& m : bars.model)
    out.model.push_back({static_cast<S>(m.mass), m.inertia.template cast<S>(), m.products.template cast<S>(),
                         m.center.template cast<S>()});
  for (const auto& c : bars.contact) out.contact.push_back(c.template cast<S>());
  for (const auto& p : bars.pair) out.pair.push_back(castPair<S>(p));
  for (const auto& s : bars.surface) out.surface.push_back(s.template cast<S>());
  return out;
}

}  // namespace carom::adjoint_detail
