// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/contact_path.hpp"

namespace carom::adjoint_detail {

/// Tangent of the inputs of a path other than its start, or the adjoint of one.
template <class S>
struct PathInputsDerivative {
  V3<S> gravity = V3<S>::Zero(), normal = V3<S>::Zero();
  S friction = 0, mass = 0;
  V3<S> inertia = V3<S>::Zero(), products = V3<S>::Zero();  ///< as in BodyModelDerivative: yz, xz, xy
  S reach = 0;
};

/// Derivative of the state (x, theta, v, L) at a fixed time by that at the start (12), and by gravity (3), normal (3),
/// friction, mass, inertia (3), products (3) and reach.
template <class S>
struct PathSensitivity {
  static constexpr int kInputs = 27;
  Eigen::Matrix<S, 12, kInputs> J;
};

/// At the end of slip: the derivative of the state at the moving end less the rate there, times that of its time.
/// What contact fixes has rows and columns of zeros: a body at rest keeps its pose, whatever else varies. Right for a
/// ball whose inertia stays a multiple of 1 (single moments do not keep it), and for a block by everything but its
/// angular momentum, whose columns are 0: how fast a spin about the normal dies away depends on where it is pressed.
/// A ball that has turned is as good as one that has not: where nobody asks how it has turned, `orientation` is false,
/// and its rows of theta are not computed (0).
template <class S>
PathSensitivity<S> pathSensitivity(PathForm form, const PathInputs<S>& in, const S& elapsed, bool orientation = true);

/// Tangent of the state at the time.
template <class S>
StateDerivativeOf<S> tangent(const PathSensitivity<S>& sensitivity, const StateDerivativeOf<S>& dstart,
                             const PathInputsDerivative<S>& dinputs);
/// Its adjoint: from that of the state to that of the start; adds to that of the inputs.
template <class S>
StateDerivativeOf<S> pullback(const PathSensitivity<S>& sensitivity, const StateDerivativeOf<S>& end_bar,
                              PathInputsDerivative<S>& inputs_bar);

}  // namespace carom::adjoint_detail
