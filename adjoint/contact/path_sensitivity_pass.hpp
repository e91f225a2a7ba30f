// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/path_sensitivity.hpp"

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
          C(in.friction), C(in.mass), matrix(in.J), C(in.reach), vector(in.axis)};
}

/// The state less its rate times how late a time is: what a time that moves along has of a fixed one.
template <class S>
class SensitivityColumns {
 public:
  using C = ColumnsOf<S>;
  SensitivityColumns(PathForm form, const PathInputs<S>& in, const S& elapsed, bool orientation)
      : form_(form), in_(in), elapsed_(elapsed), orientation_(orientation), start_(asConstants(in)) {
    const std::optional<S> end = slipEnd(form, in);
    at_end_ = end && !(primalOf(elapsed) < primalOf(*end));
    if (at_end_) rate_ = pathRateAt(form, in, elapsed);
  }

  void fill(PathSensitivity<S>& sensitivity) const {
    const M3<S> R_end = orientation_ ? pathStateAt(form_, in_, elapsed_).R : in_.R;
    for (int first = 0; first < PathSensitivity<S>::kInputs; first += kColumns) {
      PathInputs<C> in = start_;
      const int count = std::min(kColumns, PathSensitivity<S>::kInputs - first);
      for (int lane = 0; lane < count; ++lane) seedInput<S>(in, in_.R, first + lane, lane);
      const PathState<C> state = stateOf(in);
      const C late = at_end_ ? *slipEnd(form_, in) : C(0);
      for (int lane = 0; lane < count; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        auto column = sensitivity.J.col(first + lane);
        column.template segment<3>(0) = ratesOf(state.x, l) - rate_.x * late.rate[l];
        column.template segment<3>(3).setZero();
        if (orientation_)
          column.template segment<3>(3) =
              unskew(M3<S>(ratesOf(state.R, l) * R_end.transpose())) * S(0.5) - rate_.theta * late.rate[l];
        column.template segment<3>(6) = ratesOf(state.v, l) - rate_.v * late.rate[l];
        column.template segment<3>(9) = ratesOf(state.L, l) - rate_.L * late.rate[l];
      }
    }
  }

 private:
  PathState<C> stateOf(const PathInputs<C>& in) const {
    const C t = C(elapsed_);
    if (at_end_) return glideOf(form_, in).stateAtEnd(orientation_);
    return withPath<C>(form_, in, [&](const auto& path) { return path.stateAt(t, orientation_); });
  }

  PathForm form_;
  const PathInputs<S>& in_;
  S elapsed_;
  bool orientation_, at_end_ = false;
  PathInputs<C> start_;
  StateDerivativeOf<S> rate_;
};

template <class S>
PathSensitivity<S> pathSensitivity(PathForm form, const PathInputs<S>& in, const S& elapsed, bool orientation) {
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
