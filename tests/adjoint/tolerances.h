// SPDX-License-Identifier: MIT
#pragma once

namespace carom::test {

/// Of what is compared with closed forms: relative, at least of 1.
inline constexpr double kState = 1e-12, kDerivative = 1e-9;

}  // namespace carom::test
