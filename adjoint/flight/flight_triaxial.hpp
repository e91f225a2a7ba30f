// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "adjoint/base/types.h"
#include "adjoint/flight/flight_elliptic.hpp"
#include "adjoint/flight/rotation_sensitivity.h"

namespace carom::adjoint_detail {

template <class S>
struct RotationStretch;

/// Torque-free rotation with three different moments: Taylor segments at first, which are the cheapest to read, and the
/// closed form (flight_elliptic.hpp) after them, where more segments would cost more than it does. With l = |L| the
/// direction of L in principal axes, u = R^T L / l, obeys a quadratic system, and R is a twist about u(0) followed by
/// the swing S from u(0) to u:
///   u' = l u x (D u),  psi' = l (u(0) + u).(D u) / (1 + u(0).u),  R = R(0) exp([psi u(0)]x) S^T,  D = diag(1/I).
/// Coefficients come from the recurrences of Cauchy products; the step is chosen from the last coefficients (Jorba and
/// Zou, Experimental Mathematics 14(1), 2005) and rounded to a short binary number, so that segment times add without
/// error. Every segment starts again from u = R^T L / l, moved onto the energy of the start: rounding would otherwise
/// change the energy in a random walk and the phase, which sums it up, far more. Where the closed form is singular the
/// segments go on. The orientation at a time depends on the start alone, not on the times asked for before.
class TriaxialRotation {
 public:
  static constexpr int kOrder = 20;
  static constexpr std::size_t kSegments = 2;  // before the closed form
  /// Where there is no closed form, and of a derivative: some 1e5 radians, in 70 MB.
  static constexpr std::size_t kMostSegments = 100'000;

  void begin(const Vec3& inverse_inertia, const Quat& q, const Vec3& L);
  /// Makes [0, elapsed] available. Throws NotComputable where that takes more than kMostSegments; then what was reached
  /// stays available.
  void extendTo(double elapsed);
  /// Up to here the rotation is available.
  double availableUntil() const;
  std::size_t series() const { return segments_.size(); }
  Quat orientationAt(double elapsed) const;
  /// Sensitivity over [0, elapsed]: in closed form (variation_pass.hpp), and where that is singular by Taylor series of
  /// the variational equations, see flight_triaxial_sensitivity.cpp. `products`: dtheta_dproducts too.
  RotationSensitivity sensitivityAt(double elapsed, bool products = false) const;
  /// [0, elapsed] for its variations in closed form; none where that is singular or `times` as near to it as first
  /// derivatives may be, or the turn small.
  std::optional<RotationStretch<double>> stretchOver(double elapsed, double times = 1) const;

 private:
  struct Segment {
    double start = 0, length = 0;
    Quat q = Quat::Identity();                            // at the start
    std::array<std::array<double, 4>, kOrder + 1> u_psi;  // coefficients of u and psi
  };
  Segment makeSegment(double start, const Quat& q) const;
  Vec3 restoreEnergy(Quat& q) const;
  static Quat orientationIn(const Segment& segment, double h);
  const Segment& segmentAt(double elapsed) const;
  double endOfSegments() const { return segments_.back().start + segments_.back().length; }
  Vec3 bodyMomentumAt(double elapsed) const;
  Vec3 squaresOver(double elapsed, const Vec3& start) const;
  RotationSensitivity closedSensitivity(const RotationStretch<double>& stretch, bool products) const;
  RotationSensitivity sensitivityOver(double elapsed, bool products) const;
  template <int N>
  RotationSensitivity segmentSensitivity(const Segment& segment, double& h) const;

  Vec3 D_ = Vec3::Zero(), L_ = Vec3::Zero();
  Quat q_ = Quat::Identity();
  Vec3 shifted_D_ = Vec3::Zero();  // D less its middle entry
  double energy_ = 0;              // u.(shifted D u)
  std::vector<Segment> segments_;
  std::optional<EllipticRotation> closed_form_;  // once a time after the segments is asked for
};

}  // namespace carom::adjoint_detail
