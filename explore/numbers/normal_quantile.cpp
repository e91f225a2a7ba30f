// SPDX-License-Identifier: MIT
#include "explore/numbers/normal_quantile.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "adjoint/numeric/elementary.hpp"

namespace carom::explore_detail {
namespace {

constexpr double kCentre[8] = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                               1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                               3.3430575583588128105e4, 2.5090809287301226727e3};
constexpr double kUnderCentre[8] = {1,
                                    4.2313330701600911252e1,
                                    6.8718700749205790830e2,
                                    5.3941960214247511077e3,
                                    2.1213794301586595867e4,
                                    3.9307895800092710610e4,
                                    2.8729085735721942674e4,
                                    5.2264952788528545610e3};
constexpr double kSide[8] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                             3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                             2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr double kUnderSide[8] = {1,
                                  2.05319162663775882187e0,
                                  1.67638483018380384940e0,
                                  6.89767334985100004550e-1,
                                  1.48103976427480074590e-1,
                                  1.51986665636164571966e-2,
                                  5.47593808499534494600e-4,
                                  1.05075007164441684324e-9};
constexpr double kTail[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                             2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                             2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr double kUnderTail[8] = {1,
                                  5.99832206555887937690e-1,
                                  1.36929880922735805310e-1,
                                  1.48753612908506148525e-2,
                                  7.86869131145613259100e-4,
                                  1.84631831751005468180e-5,
                                  1.42151175831644588870e-7,
                                  2.04426310338993978564e-15};

double ratio(const double (&above)[8], const double (&below)[8], double r) {
  double a = above[7], b = below[7];
  for (int k = 6; k >= 0; --k) a = a * r + above[k], b = b * r + below[k];
  return a / b;
}

/// Of p <= 0.075, by p itself.
double lowerQuantile(double p) {
  const double r = std::sqrt(-elementary::log(p));
  return r <= 5 ? -ratio(kSide, kUnderSide, r - 1.6) : -ratio(kTail, kUnderTail, r - 5);
}

}  // namespace

double normalQuantile(double p) {
  if (p <= 0 || p >= 1)
    return p <= 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) return q * ratio(kCentre, kUnderCentre, 0.180625 - q * q);
  return q < 0 ? lowerQuantile(p) : -lowerQuantile(1 - p);
}

double normalProbability(double z) {
  if (std::isnan(z)) return z;
  if (z > 0) return 1 - normalProbability(-z);
  // Doubles above 0 are in the order of their bits: the largest p whose quantile is not above z, by bisection.
  std::uint64_t below = 0, above = std::bit_cast<std::uint64_t>(0.5);
  if (z == 0) return 0.5;
  while (above - below > 1) {
    const std::uint64_t middle = below + (above - below) / 2;
    (normalQuantile(std::bit_cast<double>(middle)) <= z ? below : above) = middle;
  }
  return std::bit_cast<double>(below);
}

}  // namespace carom::explore_detail
