// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/contact/glide_turn.hpp"
#include "adjoint/contact/turn_integrals.hpp"

namespace carom::adjoint_detail {

/// Derivative of how a ball turns in a glide (11.10) by what its angular velocity depends on: the slip at the start
/// (3), the slope of the face (3), the friction c, the lever m (3) and the spin at the start (3). Along the clock, on
/// which w and |s| are power series, the integral of R^T d(w |s|) is a sum of few products.
template <class S>
class GlideTurnRates {
 public:
  static constexpr int kInputs = 13;
  using Rates = Eigen::Matrix<S, 3, kInputs>;
  struct Result {
    M3<S> E;  ///< the turn
    Rates G;  ///< at a fixed time; at the end of slip less the angular velocity there times its rate
  };

  GlideTurnRates(const GlideSlip<S>& slip, const V3<S>& spin, const V3<S>& m) : slip_(slip), turn_(slip, spin, m) {
    passes_.reserve(4);
    for (int first = 0; first < kInputs; first += kLanes) passes_.push_back(passOf(slip, spin, m, first));
  }

  Result over(const S& t, bool to_end) {
    const S last = to_end ? S(0) : slip_.xiAt(t);
    const double stop = to_end ? std::numeric_limits<double>::infinity() : primalOf(last);
    Q4<S> q = Q4<S>::UnitX();
    Result result{M3<S>::Identity(), Rates::Zero()};
    S xi = 0;
    while (true) {
      const auto at = turn_.startAt(xi);
      if (turn_.isShort(at, primalOf(S(t - at.t)), primalOf(t), true)) return closing(result, xi, t, to_end);
      if (slip_.isStraightFrom(xi)) return straightOn(result, xi, t);
      const double step = turn_.lengthAt(at);
      const bool is_last = !(primalOf(xi) + step < stop);
      const S h = is_last ? S(last - xi) : S(step);
      addSegment(result, at, xi, h);
      q = productOf(turn_.segment(at, h), q);
      result.E = turnOf(q);
      xi += h;
      if (is_last) return atFixedTime(result, last);
    }
  }

 private:
  static constexpr int kLanes = 4;
  using C = Dual<kLanes, S>;
  static constexpr std::size_t kTerms = kTurnTerms;
  // The glide with rates along a few of the inputs.
  struct Pass {
    V3<C> spin, m;
    GlideSlip<C> slip;
  };
  static V3<C> constant(const V3<S>& v) { return {v[0], v[1], v[2]}; }
  static Pass passOf(const GlideSlip<S>& slip, const V3<S>& spin, const V3<S>& m, int first) {
    V3<C> s0 = constant(slip.start()), g = constant(slip.slope()), lever = constant(m), w = constant(spin);
    C c = slip.friction();
    for (int lane = 0; lane < kLanes && first + lane < kInputs; ++lane) {
      const int input = first + lane;
      C& varied = input < 3    ? s0[input]
                  : input < 6  ? g[input - 3]
                  : input == 6 ? c
                  : input < 10 ? lever[input - 7]
                               : w[input - 10];
      varied.rate[static_cast<std::size_t>(lane)] = S(1);
    }
    return {w, lever, GlideSlip<C>(s0, g, c, slip.scale())};
  }
  template <class F>
  void eachLane(F f) const {
    for (std::size_t p = 0; p < passes_.size(); ++p)
      for (int lane = 0; lane < kLanes && kLanes * static_cast<int>(p) + lane < kInputs; ++lane)
        f(passes_[p], static_cast<std::size_t>(lane), kLanes * static_cast<int>(p) + lane);
  }

  void addSegment(Result& result, const typename GlideTurn<S>::Start& at, const S& xi, const S& h);
  // From a place on the clock to the time, which the rates reach elsewhere on it.
  Result atFixedTime(Result& result, const S& xi) const;
  // The rest of the way, along a straight line.
  Result straightOn(Result& result, const S& xi, const S& t) const;
  // The rest of the way, over which the angular velocity does not change.
  Result closing(Result& result, const S& xi, const S& t, bool to_end) const;

  const GlideSlip<S>& slip_;
  GlideTurn<S> turn_;
  std::vector<Pass> passes_;
};

template <class S>
void GlideTurnRates<S>::addSegment(Result& result, const typename GlideTurn<S>::Start& at, const S& xi, const S& h) {
  const ClockSeries<S> series(slip_, turn_.lever(), at, h);
  // Of R^T over the segment, of R^T |s| and of R^T w; then their integrals with the powers of the clock.
  std::array<M3<S>, kTerms> turn, with_speed;
  std::array<V3<S>, kTerms> with_spin, turning;
  turn[0] = M3<S>::Identity();
  for (std::size_t j = 0; j < kTerms; ++j) {
    turning[j] = V3<S>::Zero();
    with_speed[j] = M3<S>::Zero();
    with_spin[j] = V3<S>::Zero();
    for (std::size_t i = 0; i <= j; ++i) {
      turning[j] += series.spin[j - i] * (series.u[i] * h);
      with_speed[j] += turn[i] * series.u[j - i];
      with_spin[j] += turn[i] * series.spin[j - i];
    }
    if (j + 1 == kTerms) break;
    M3<S> next = M3<S>::Zero();  // (R^T)' = -R^T [w |s|]x
    for (std::size_t i = 0; i <= j; ++i) next -= turn[j - i] * skew(turning[i]);
    turn[j + 1] = next / (static_cast<double>(j) + 1);
  }
  const M3<S> back = result.E.transpose();
  std::array<M3<S>, kTerms> by_spin;
  std::array<V3<S>, kTerms> by_speed;
  for (std::size_t i = 0; i < kTerms; ++i) {
    M3<S> of_spin = M3<S>::Zero();
    V3<S> of_speed = V3<S>::Zero();
    for (std::size_t j = 0; j < kTerms; ++j) {
      const double share = 1.0 / (static_cast<double>(i + j) + 1);
      of_spin += with_speed[j] * S(share);
      of_speed += with_spin[j] * S(share);
    }
    by_spin[i] = back * of_spin * h;
    by_speed[i] = back * of_speed * h;
  }
  std::vector<ClockSeries<C>> varied;
  varied.reserve(passes_.size());
  for (const Pass& pass : passes_)
    varied.emplace_back(pass.slip, pass.m, GlideTurn<C>(pass.slip, pass.spin, pass.m).startAt(C(xi)), C(h));
  eachLane([&](const Pass& pass, std::size_t lane, int input) {
    const ClockSeries<C>& of = varied[static_cast<std::size_t>(&pass - passes_.data())];
    for (std::size_t i = 0; i < kTerms; ++i)
      result.G.col(input) += by_spin[i] * ratesOf(of.spin[i], lane) + by_speed[i] * of.u[i].rate[lane];
  });
}

template <class S>
typename GlideTurnRates<S>::Result GlideTurnRates<S>::atFixedTime(Result& result, const S& xi) const {
  result.G = (result.E * result.G).eval();
  const V3<S> spin = turn_.startAt(xi).spin;
  eachLane([&](const Pass& pass, std::size_t lane, int input) {
    result.G.col(input) -= spin * pass.slip.timeAt(C(xi)).rate[lane];
  });
  return result;
}

template <class S>
typename GlideTurnRates<S>::Result GlideTurnRates<S>::straightOn(Result& result, const S& xi, const S& t) const {
  const auto at = turn_.startAt(xi);
  const V3<S> rate = turn_.rateAt(at);
  const TurnIntegrals<S> rest(at.spin, rate, S(t - at.t));
  result = atFixedTime(result, xi);
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const Pass& pass = passes_[p];
    const GlideTurn<C> turn(pass.slip, pass.spin, pass.m);
    const auto varied = turn.startAt(C(xi));
    const V3<C> varied_rate = turn.rateAt(varied);
    for (int lane = 0; lane < kLanes && kLanes * static_cast<int>(p) + lane < kInputs; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      const V3<S> spin = ratesOf(varied.spin, l) - rate * varied.t.rate[l];  // at a fixed time
      result.G.col(kLanes * static_cast<int>(p) + lane) += rest.M0 * spin + rest.M1 * ratesOf(varied_rate, l);
    }
  }
  result.G = (rest.E * result.G).eval();
  result.E = (rest.E * result.E).eval();
  return result;
}

template <class S>
typename GlideTurnRates<S>::Result GlideTurnRates<S>::closing(Result& result, const S& xi, const S& t,
                                                              bool to_end) const {
  const auto at = turn_.startAt(xi);
  const V3<S> angle = turn_.angleOver(at, xi, t, to_end);
  const M3<S> E = turnBy<S>(angle), half = skew(angle) * S(0.5);  // the left Jacobian is 1 + [angle]x/2 + ...
  const V3<S> spin = to_end ? V3<S>(at.spin + turn_.change(at, t)) : V3<S>::Zero();
  result.G = (E * result.E * result.G).eval();
  result.E = (E * result.E).eval();
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const Pass& pass = passes_[p];
    const GlideTurn<C> turn(pass.slip, pass.spin, pass.m);
    const C end = to_end ? *pass.slip.end() : C(t);
    const V3<C> angles = turn.angleOver(turn.startAt(C(xi)), C(xi), end, to_end);
    for (int lane = 0; lane < kLanes && kLanes * static_cast<int>(p) + lane < kInputs; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      const V3<S> rate = ratesOf(angles, l);
      result.G.col(kLanes * static_cast<int>(p) + lane) += rate + half * rate - spin * end.rate[l];
    }
  }
  return result;
}

}  // namespace carom::adjoint_detail
