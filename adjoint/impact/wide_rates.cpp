// SPDX-License-Identifier: MIT
#include "adjoint/impact/wide_pass.hpp"

// Impacts of 32 digits with their rates along one direction.

namespace carom::adjoint_detail {

template ImpactOutcome<Dual<1>> wideImpact(const ImpactInputs<Dual<1>>&);

}  // namespace carom::adjoint_detail
