// SPDX-License-Identifier: MIT
#include "adjoint/numeric/elementary.hpp"

// The C library's names for the functions of adjoint/numeric/elementary.hpp. A program that exports them (cli/CMakeLists.txt) is
// where the loader looks first: Ipopt, MUMPS, LAPACK, ODE and qhull, and our own reading and writing, then compute with
// them, too, and an edit does not depend on what the C library thinks of the processor. docs/elementary.md tells more.
// No header of the C library here: it would declare them with attributes that differ by version.
#define CAROM_EXPORTED extern "C" __attribute__((visibility("default")))

CAROM_EXPORTED double sin(double x) noexcept { return carom::elementary::sin(x); }
CAROM_EXPORTED double cos(double x) noexcept { return carom::elementary::cos(x); }
CAROM_EXPORTED double tan(double x) noexcept { return carom::elementary::tan(x); }
CAROM_EXPORTED void sincos(double x, double* sine, double* cosine) noexcept {
  const auto both = carom::elementary::sincos(x);
  *sine = both.sine, *cosine = both.cosine;
}
CAROM_EXPORTED double atan2(double y, double x) noexcept { return carom::elementary::atan2(y, x); }
CAROM_EXPORTED double exp(double x) noexcept { return carom::elementary::exp(x); }
CAROM_EXPORTED double log(double x) noexcept { return carom::elementary::log(x); }
CAROM_EXPORTED double log10(double x) noexcept { return carom::elementary::log10(x); }
CAROM_EXPORTED double pow(double x, double y) noexcept { return carom::elementary::pow(x, y); }
CAROM_EXPORTED double sinh(double x) noexcept { return carom::elementary::sinh(x); }
CAROM_EXPORTED double cosh(double x) noexcept { return carom::elementary::cosh(x); }
CAROM_EXPORTED double cbrt(double x) noexcept { return carom::elementary::cbrt(x); }
CAROM_EXPORTED double hypot(double x, double y) noexcept { return carom::elementary::hypot(x, y); }
