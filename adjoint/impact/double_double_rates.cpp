// SPDX-License-Identifier: MIT
#include "adjoint/impact/double_double_pass.hpp"

// Impacts of 32 digits with their rates along one direction.

namespace carom::adjoint_detail {

template ImpactOutcome<Dual<1>> doubleDoubleImpact(const ImpactInputs<Dual<1>>&);

}  // namespace carom::adjoint_detail
