// SPDX-License-Identifier: MIT
#include "adjoint/contact/path_sensitivity_pass.hpp"

namespace carom::adjoint_detail {

template PathSensitivity<double> pathSensitivity(PathForm, const PathInputs<double>&, const double&, bool);
template StateDerivativeOf<double> tangent(const PathSensitivity<double>&, const StateDerivativeOf<double>&,
                                      const PathInputsDerivative<double>&);
template StateDerivativeOf<double> pullback(const PathSensitivity<double>&, const StateDerivativeOf<double>&,
                                       PathInputsDerivative<double>&);

}  // namespace carom::adjoint_detail
