// SPDX-License-Identifier: MIT
#include "adjoint/contact/path_sensitivity_pass.hpp"

namespace carom::adjoint_detail {

template PathSensitivity<Dual<4>> pathSensitivity(PathForm, const PathInputs<Dual<4>>&, const Dual<4>&, bool);
template StateDerivativeOf<Dual<4>> tangent(const PathSensitivity<Dual<4>>&, const StateDerivativeOf<Dual<4>>&,
                                      const PathInputsDerivative<Dual<4>>&);
template StateDerivativeOf<Dual<4>> pullback(const PathSensitivity<Dual<4>>&, const StateDerivativeOf<Dual<4>>&,
                                       PathInputsDerivative<Dual<4>>&);

}  // namespace carom::adjoint_detail
