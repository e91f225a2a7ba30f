// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/contact/ball_sensitivity.hpp"
#include "adjoint/contact/glide_turn_rates.hpp"
#include "adjoint/contact/path_sensitivity.hpp"
#include "adjoint/contact/turn_integrals.hpp"

namespace carom::adjoint_detail {

/// How many columns are computed at once.
inline constexpr int kColumns = 4;

/// The number that carries them.
template <class S>
using ColumnsOf = Dual<kColumns, S>;

template <class S>
void setRate(ColumnsOf<S>& number, int lane) {
  number.rate[static_cast<std::size_t>(lane)] = S(1);
}

/// Seeds column `input` of PathSensitivity.
template <class S>
void seedInput(PathInputs<ColumnsOf<S>>& in, const M3<S>& R, int input, int lane) {
  const int i = input % 3;
  if (input < 3) {
    setRate(in.x[i], lane);
  } else if (input < 6) {
    setRates(in.R, M3<S>(skew(V3<S>(V3<S>::Unit(i))) * R), static_cast<std::size_t>(lane));
  } else if (input < 9) {
    setRate(in.v[i], lane);
  } else if (input < 12) {
    setRate(in.L[i], lane);
  } else if (input < 15) {
    setRate(in.gravity[i], lane);
  } else if (input < 18) {
    setRate(in.normal[i], lane);
  } else if (input == 18) {
    setRate(in.friction, lane);
  } else if (input == 19) {
    setRate(in.mass, lane);
  } else if (input < 23) {
    setRate(in.J(input - 20, input - 20), lane);
  } else if (input < 26) {
    const int of = input - 23, row = (of + 1) % 3, column = (of + 2) % 3;
    setRate(in.J(row, column), lane);
    setRate(in.J(column, row), lane);
  } else {
    setRate(in.reach, lane);
  }
}

template <class S>
PathInputs<ColumnsOf<S>> asConstants(const PathInputs<S>& in) {
  using C = ColumnsOf<S>;
  const auto vector = [](const V3<S>& v) { return V3<C>(v[0], v[1], v[2]); };
  const auto matrix = [](const M3<S>& m) { return M3<C>(m.unaryExpr([](const S& x) { return C(x); })); };
  return {vector(in.x), vector(in.v), vector(in.L), matrix(in.R), vector(in.gravity), vector(in.normal),
          C(in.friction), C(in.mass), matrix(in.J), C(in.reach), vector(in.axis), in.begins};
}

/// The inputs whose columns have to be computed: of a place, all that moves with it; of a ball, one moment for three.
inline std::vector<int> variedInputs(PathForm form) {
  std::vector<int> inputs = {6, 7, 8, 12, 13, 14, 15, 16, 17};
  if (glides(form)) inputs.push_back(18);
  if (form == PathForm::glide_block) return inputs;
  if (form == PathForm::roll_axle) {
    inputs.insert(inputs.end(), {3, 4, 5, 9, 10, 11, 19, 20, 21, 22, 23, 24, 25, 26});
  } else {
    inputs.insert(inputs.end(), {9, 10, 11, 19, 20, 26});
  }
  return inputs;
}

/// Fills the columns of a path, a few at a time. What moves along with the end of slip is taken back to a fixed time.
template <class S>
class SensitivityColumns {
 public:
  using C = ColumnsOf<S>;
  using Columns = Eigen::Matrix<S, 3, kColumns>;
  SensitivityColumns(PathForm form, const PathInputs<S>& in, const S& elapsed, bool orientation)
      : form_(form), in_(in), elapsed_(elapsed), turns_(orientation && form != PathForm::glide_block) {
    const std::optional<S> end = slipEnd(form, in);
    at_end_ = end && !(primalOf(elapsed) < primalOf(*end));
    if (at_end_) rate_ = pathRateAt(form, in, elapsed);
  }

  void fill(PathSensitivity<S>& sensitivity) {
    sensitivity.J.setZero();
    for (int i = 0; i < 3; ++i) sensitivity.J(i, i) = S(1);
    prepareTurns(sensitivity);
    const PathInputs<C> start = asConstants(in_);
    const std::vector<int> inputs = variedInputs(form_);
    for (std::size_t first = 0; first < inputs.size(); first += kColumns) {
      PathInputs<C> in = start;
      const std::size_t count = std::min<std::size_t>(kColumns, inputs.size() - first);
      for (std::size_t lane = 0; lane < count; ++lane)
        seedInput<S>(in, in_.R, inputs[first + lane], static_cast<int>(lane));
      withPath<C>(form_, in, [&](const auto& path) {
        const PathState<C> state = stateOf(path);
        const C late = lateness(path);
        const Columns theta = turnsOf(path);
        for (std::size_t lane = 0; lane < count; ++lane) {
          auto column = sensitivity.J.col(inputs[first + lane]);
          column.template segment<3>(0) = ratesOf(state.x, lane) - rate_.x * late.rate[lane];
          column.template segment<3>(3) += theta.col(static_cast<Eigen::Index>(lane));
          column.template segment<3>(6) = ratesOf(state.v, lane) - rate_.v * late.rate[lane];
          column.template segment<3>(9) = ratesOf(state.L, lane) - rate_.L * late.rate[lane];
        }
      });
    }
    if (form_ == PathForm::glide_ball || form_ == PathForm::roll_ball)
      sensitivity.J.col(21) = sensitivity.J.col(22) = sensitivity.J.col(20);
  }

 private:
  // The turn over the path, and what takes rates of the angular velocity to rates of the orientation.
  void prepareTurns(PathSensitivity<S>& sensitivity) {
    M3<S> E = M3<S>::Identity();
    if (turns_) withPath<S>(form_, in_, [&](const auto& path) { E = prepare(path); });
    if (turns_ || form_ == PathForm::glide_block) sensitivity.J.template block<3, 3>(3, 3) = E;
  }
  M3<S> prepare(const RestPath<S>&) { return M3<S>::Identity(); }
  M3<S> prepare(const RollPath<S>& path) { return prepareLinear(path.spinAt(S(0)), path.spinRate()); }
  M3<S> prepare(const GlidePath<S>& path) {
    if (!path.slip().moving()) return prepareLinear(path.startSpin(), path.accelerationOfSpin(path.directionAt(S(0))));
    GlideTurnRates<S> rates(path.slip(), path.startSpin(), path.lever());
    const auto [E, G] = rates.over(at_end_ ? *path.end() : elapsed_, at_end_);
    curved_ = G;
    return E;
  }
  M3<S> prepareLinear(const V3<S>& spin, const V3<S>& rate) {
    const TurnIntegrals<S> integrals(spin, rate, elapsed_);
    by_spin_ = integrals.E * integrals.M0;
    by_spin_rate_ = integrals.E * integrals.M1;
    return integrals.E;
  }

  Columns turnsOf(const RestPath<C>&) const { return Columns::Zero(); }
  Columns turnsOf(const RollPath<C>& path) const {
    return turns_ ? linear(path.spinAt(C(0)), path.spinRate()) : Columns::Zero().eval();
  }
  Columns turnsOf(const GlidePath<C>& path) const {
    if (!turns_) return Columns::Zero();
    if (!path.slip().moving()) return linear(path.startSpin(), path.accelerationOfSpin(path.directionAt(C(0))));
    Columns columns;
    for (std::size_t lane = 0; lane < kColumns; ++lane) {
      Eigen::Matrix<S, GlideTurnRates<S>::kInputs, 1> d;
      d << ratesOf(path.slip().start(), lane), ratesOf(path.slip().slope(), lane), path.slip().friction().rate[lane],
          ratesOf(path.lever(), lane), ratesOf(path.startSpin(), lane);
      columns.col(static_cast<Eigen::Index>(lane)) = curved_ * d;
    }
    return columns;
  }
  Columns linear(const V3<C>& spin, const V3<C>& rate) const {
    Columns columns;
    for (int lane = 0; lane < kColumns; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      columns.col(lane) = by_spin_ * ratesOf(spin, l) + by_spin_rate_ * ratesOf(rate, l);
    }
    return columns;
  }

  template <class Path>
  PathState<C> stateOf(const Path& path) const {
    if constexpr (std::is_same_v<Path, GlidePath<C>>) {
      if (at_end_) return path.stateAtEnd(false);
    }
    return path.stateAt(C(elapsed_), false);
  }
  // How late the end of slip is.
  template <class Path>
  C lateness(const Path& path) const {
    if constexpr (std::is_same_v<Path, GlidePath<C>>) {
      if (at_end_) return *path.end();
    }
    return C(0);
  }

  PathForm form_;
  const PathInputs<S>& in_;
  S elapsed_;
  bool turns_, at_end_ = false;
  StateDerivativeOf<S> rate_;
  M3<S> by_spin_ = M3<S>::Zero(), by_spin_rate_ = M3<S>::Zero();
  typename GlideTurnRates<S>::Rates curved_ = GlideTurnRates<S>::Rates::Zero();
};

template <class S>
PathSensitivity<S> pathSensitivity(PathForm form, const PathInputs<S>& in, const S& elapsed, bool orientation) {
  if constexpr (std::is_same_v<S, double>) {
    if (const auto closed = ballSensitivity(form, in, elapsed, orientation)) return {*closed};
  }
  PathSensitivity<S> sensitivity;
  if (form == PathForm::rest) {
    sensitivity.J.setZero();
    for (int i = 0; i < 6; ++i) sensitivity.J(i, i) = S(1);
  } else {
    SensitivityColumns<S>(form, in, elapsed, orientation).fill(sensitivity);
  }
  return sensitivity;
}

template <class S>
StateDerivativeOf<S> tangent(const PathSensitivity<S>& sensitivity, const StateDerivativeOf<S>& dstart,
                             const PathInputsDerivative<S>& dinputs) {
  Eigen::Matrix<S, PathSensitivity<S>::kInputs, 1> d;
  d << dstart.x, dstart.theta, dstart.v, dstart.L, dinputs.gravity, dinputs.normal, dinputs.friction, dinputs.mass,
      dinputs.inertia, dinputs.products, dinputs.reach;
  const Eigen::Matrix<S, 12, 1> end = sensitivity.J * d;
  return {end.template segment<3>(0), end.template segment<3>(3), end.template segment<3>(6),
          end.template segment<3>(9)};
}

template <class S>
StateDerivativeOf<S> pullback(const PathSensitivity<S>& sensitivity, const StateDerivativeOf<S>& end_bar,
                              PathInputsDerivative<S>& inputs_bar) {
  Eigen::Matrix<S, 12, 1> end;
  end << end_bar.x, end_bar.theta, end_bar.v, end_bar.L;
  const Eigen::Matrix<S, PathSensitivity<S>::kInputs, 1> bar = sensitivity.J.transpose() * end;
  inputs_bar.gravity += bar.template segment<3>(12);
  inputs_bar.normal += bar.template segment<3>(15);
  inputs_bar.friction += bar[18];
  inputs_bar.mass += bar[19];
  inputs_bar.inertia += bar.template segment<3>(20);
  inputs_bar.products += bar.template segment<3>(23);
  inputs_bar.reach += bar[26];
  return {bar.template segment<3>(0), bar.template segment<3>(3), bar.template segment<3>(6),
          bar.template segment<3>(9)};
}

}  // namespace carom::adjoint_detail
