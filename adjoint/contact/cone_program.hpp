// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/contact/cone.hpp"

namespace carom::adjoint_detail {

/// The solution to rounding; where redundant contacts leave a choice of f, K f is that of every choice, whatever the
/// order of contacts. Throws NotComputable where none is found.
template <class T>
ConePointOf<T> solveConeProgram(const ConeProgramOf<T>& program);

}  // namespace carom::adjoint_detail
