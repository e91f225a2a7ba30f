// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/scene/body_model.h"

namespace carom::adjoint_detail {

/// How the inertia tensor of a body can change, in principal axes, when the scene varies.
struct InertiaChange {
  bool keeps_symmetry = true;  ///< moments that are equal stay equal
  bool keeps_axes = true;      ///< no products of inertia
};

/// As the dimensions of its shape vary at these rates.
InertiaChange inertiaChange(const std::vector<SolidRate>& rates, const BodyModel& model);

}  // namespace carom::adjoint_detail
