// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

/// Products of differences, worked out with 32 digits (wide.hpp) and rounded once.
namespace carom::adjoint_detail {

/// (a - o) x (b - o), m^2; error about a rounding of it, plus 1e-31 |a - o| |b - o|: of a sliver as good as of any
/// other triangle, where a plain cross product would turn the normal of one 1e-6 as high as it is long by 1e-10.
Vec3 crossProduct(const Vec3& o, const Vec3& a, const Vec3& b);

/// (a - o) . ((b - o) x (c - o)), m^3: six times the signed volume of a tetrahedron; error about a rounding of it, plus
/// 1e-30 |a - o| |b - o| |c - o|, so that of a needle as of a plate the sign is that of the exact value.
double tripleProduct(const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace carom::adjoint_detail
