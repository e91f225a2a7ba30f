// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"
#include "editing/motion_function.h"
#include "editing/problem/rows/quantity_place.hpp"

/// Where a body touches in an impact: the mean of its contacts. It is no point of the body: it moves along both
/// surfaces,
///   c = (1/m) sum of p_k(x_a, R_a, x_b, R_b),   dc = (1/m) sum of dp_k, p_k the point of ContactJacobian.
namespace carom::editing_detail {

/// The contacts of a body in an impact that are reported; those with `with` unless that is -1.
std::vector<const Contact*> contactsOf(const Event& event, int body, int with);

/// Their mean, m. Throws InputError where there are none.
Vec3 contactPlace(const Motion& motion, int event, int body, int with);

/// One component of it as a row.
RowReading readContactPlace(const QuantityPlace& place);

}  // namespace carom::editing_detail
