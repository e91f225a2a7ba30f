// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/impact/laws.hpp"

/// wideImpact and wideImpactPullback of impact_pass.hpp. Each kind of number takes a minute of compilation, and so has
/// a file of its own.
namespace carom::adjoint_detail {

inline Wide widened(double x) { return x; }
template <int N>
Dual<N, Wide> widened(const Dual<N>& x) {
  Dual<N, Wide> w(x.value);
  for (std::size_t i = 0; i < N; ++i) w.rate[i] = x.rate[i];
  return w;
}
inline double narrowed(const Wide& w) { return w.high; }
template <int N>
Dual<N> narrowed(const Dual<N, Wide>& w) {
  Dual<N> x(w.value.high);
  for (std::size_t i = 0; i < N; ++i) x.rate[i] = w.rate[i].high;
  return x;
}
template <class M>
auto widened(const Eigen::MatrixBase<M>& m) {
  return m.unaryExpr([](const auto& x) { return widened(x); }).eval();
}
template <class M>
auto narrowed(const Eigen::MatrixBase<M>& m) {
  return m.unaryExpr([](const auto& x) { return narrowed(x); }).eval();
}
template <class S>
auto widened(const PairCoefficientsOf<S>& p) {
  using W = decltype(widened(p.friction));
  return PairCoefficientsOf<W>{widened(p.elasticity), widened(p.friction), widened(p.tangential_elasticity)};
}

template <class S>
using WideOf = decltype(widened(S()));

template <class S>
ImpactPass<WideOf<S>> widePass(const ImpactInputs<S>& inputs) {
  ImpactInputs<WideOf<S>> wide;
  for (const auto& b : inputs.bodies)
    wide.bodies.push_back({b.kinematic, widened(b.inverse_mass), widened(b.R), widened(b.D), widened(b.x),
                           widened(b.v), widened(b.L)});
  for (const auto& c : inputs.contacts)
    wide.contacts.push_back({c.a, c.b, widened(c.point), widened(c.normal), widened(c.pair)});
  return ImpactPass<WideOf<S>>(std::move(wide));
}

template <class S>
ImpactOutcome<S> wideImpact(const ImpactInputs<S>& inputs) {
  const auto pass = widePass(inputs);
  const auto solution = pass.solve();
  ImpactOutcome<S> out{{narrowed(solution.P), solution.mode, solution.stick_slip_margin}, {}};
  for (const auto& b : pass.after(solution.P)) out.after.push_back({narrowed(b.v), narrowed(b.L)});
  return out;
}

template <class S>
ImpactBars<S> wideImpactPullback(const ImpactInputs<S>& inputs, const std::vector<StateDerivativeOf<S>>& after_bar) {
  const auto pass = widePass(inputs);
  std::vector<StateDerivativeOf<WideOf<S>>> after;
  for (const auto& b : after_bar) after.push_back({widened(b.x), widened(b.theta), widened(b.v), widened(b.L)});
  const auto bars = pass.pullback(pass.solve().P, after);
  ImpactBars<S> out;
  for (const auto& b : bars.before)
    out.before.push_back({narrowed(b.x), narrowed(b.theta), narrowed(b.v), narrowed(b.L)});
  for (const auto& m : bars.model)
    out.model.push_back({narrowed(m.mass), narrowed(m.inertia), narrowed(m.products), narrowed(m.center)});
  for (const auto& c : bars.contact) out.contact.push_back(narrowed(c));
  for (const auto& p : bars.pair)
    out.pair.push_back({narrowed(p.elasticity), narrowed(p.friction), narrowed(p.tangential_elasticity)});
  return out;
}

}  // namespace carom::adjoint_detail
