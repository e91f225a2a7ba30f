// SPDX-License-Identifier: MIT
#pragma once

#include "editing/problem/rows/quantity_place.hpp"

/// Quantities that depend on more than the state of a body at one instant: on its mass, its shape, on what comes after.
/// Each with first and second derivatives; where the first is not defined, or one-sided, `doubt` says so.
namespace carom::editing_detail {

/// |v|, of the body's velocity or of its difference from another body's: ds = u.dv with u = v/|v|, du = (1 - u u^T) dv/|v|.
/// Not defined at 0.
RowReading readSpeed(const QuantityPlace& place);

/// E = 1/2 m v.v + 1/2 w.J w with J the inertia tensor in world axes, L = J w and theta the world rotation vector:
///   dE = m v.dv + L.dw + (L x w).theta + 1/2 v.v dm + 1/2 w.dJ w,  dJ the change of the tensor in the axes of the body.
RowReading readKineticEnergy(const QuantityPlace& place);

/// |P| of all contacts of the body at the event, P = m (v_after - v_before) = m d:  dP = u.(m dd + d dm) with u = d/|d|.
/// Not defined at 0.
RowReading readImpulse(const QuantityPlace& place);

/// How high the lowest point of the body is along up = -g/|g| (z without gravity), from the origin of the world:
///   h = up.x - s(n),  n = -R^T up,  s the reach of the shape (FarthestPoint), p = ds/dn the lowest point in its axes:
///   dh = up.dx + (R p x up).theta + (x + R p).dup - ds/dsize dsize,  dup = -(1 - up up^T) dg/|g|.
/// One-sided where several points are equally low.
RowReading readHeight(const QuantityPlace& place);

}  // namespace carom::editing_detail
