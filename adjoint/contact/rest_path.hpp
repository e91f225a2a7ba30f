// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/path_inputs.hpp"

namespace carom::adjoint_detail {

/// A body at rest on a face: the pose of its start, for ever. Its velocities are 0, whatever varies.
template <class S>
struct RestPath {
  PathInputs<S> in;

  PathCenter<S> centerAt(const S&) const { return {in.x, V3<S>::Zero()}; }
  PathState<S> stateAt(const S&, bool = true) const { return {in.x, V3<S>::Zero(), V3<S>::Zero(), in.R}; }
  StateDerivativeOf<S> rateAt(const S&) const { return {}; }
};

}  // namespace carom::adjoint_detail
