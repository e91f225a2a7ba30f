// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/shape.h"

namespace carom::shapes {

/// Mass properties of a closed surface at scale s, with the rate by s: V = s^3 V_1, c = s c_1, I = s^2 I_1.
/// Throws InputError, naming `kind`, when the surface is missing or open.
SolidProperties scaledProperties(const Surface* surface, double scale, const char* kind);

/// Rates of all of these as the scale changes at `rate`.
SolidProperties scaledPropertiesRate(const Surface* surface, double scale, double rate, const char* kind);

/// Largest distance of a vertex from the origin, times s.
double scaledRadius(const Surface* surface, double scale);

}  // namespace carom::shapes
