// SPDX-License-Identifier: MIT
#pragma once

/// Elementary functions that do not look at the processor. Those of the C library may: glibc takes versions with fused
/// multiply-add where there is one, and their last digit differs from that of the others. These are written in plain
/// IEEE arithmetic (+ - * / and square roots of doubles, rounded to nearest), so they have the same bits everywhere.
/// Square roots, fma, fmod, floor, round, ldexp and the like are exact or correctly rounded by any C library, and are
/// taken from there. docs/elementary.md has the methods and the proofs; errors are in units of the last place. Special
/// values are those of C's Annex F; errno is left alone.
namespace carom::elementary {

struct SineCosine {
  double sine, cosine;
};

double sin(double x);              ///< 0.55, of any argument
double cos(double x);              ///< 0.55, of any argument
SineCosine sincos(double x);       ///< the bits of sin and cos
double tan(double x);              ///< 2.6
double atan2(double y, double x);  ///< 0.6; 1 below 1e-307

double exp(double x);            ///< 0.53; below 1e-307, too
double log(double x);            ///< 0.53
double log10(double x);          ///< 0.51
double pow(double x, double y);  ///< 0.56; below 1e-307, too
double sinh(double x);           ///< 0.56
double cosh(double x);           ///< 0.56

double cbrt(double x);             ///< 0.51
double hypot(double x, double y);  ///< 0.51; 1 below 1e-307

}  // namespace carom::elementary
