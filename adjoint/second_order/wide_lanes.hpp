// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/wide.hpp"
#include "adjoint/second_order/dual_state.hpp"

namespace carom::detail {

/// The same lanes in numbers of 32 digits, and back.
using WideNum = Dual<static_cast<int>(kLanes), Wide>;
inline WideNum widened(const Num& x) {
  WideNum w(x.value);
  for (std::size_t i = 0; i < kLanes; ++i) w.rate[i] = x.rate[i];
  return w;
}
inline Num narrowed(const WideNum& w) {
  Num x(w.value.high);
  for (std::size_t i = 0; i < kLanes; ++i) x.rate[i] = w.rate[i].high;
  return x;
}
inline V3<WideNum> widened(const NVec& v) { return {widened(v[0]), widened(v[1]), widened(v[2])}; }
inline NVec narrowed(const V3<WideNum>& v) { return {narrowed(v[0]), narrowed(v[1]), narrowed(v[2])}; }
inline M3<WideNum> widened(const NMat& m) {
  return m.unaryExpr([](const Num& x) { return widened(x); });
}
inline NMat narrowed(const M3<WideNum>& m) {
  return m.unaryExpr([](const WideNum& x) { return narrowed(x); });
}

}  // namespace carom::detail
