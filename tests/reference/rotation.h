// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "tests/reference/real.h"

namespace carom::reference {

/// Free rotation of a rigid body, for any moments of inertia.
///
/// With the constant world momentum L = l k (|k| = 1) its direction in principal axes, u = R^T k, obeys the quadratic
/// system u' = l u x (D u), D = diag(1/I). Orientation then needs one more number: split R(t) into a twist about u0 and
/// the swing S from u0 = u(0) to u(t),
///   R(t) = R(0) exp([psi u0]x) S^T,   psi' = l (u0 + u).(D u) / (1 + u0.u),   u.(D u) constant.
/// Taylor series of u and psi, restarted from R and k each segment so that errors do not add up along u.
class FreeRotation {
 public:
  FreeRotation(const RVec& inertia, const RMat& R, const RVec& L) : R_(R), L_(L) {
    for (int i = 0; i < 3; ++i) D_[i] = 1 / inertia[i];
    speed_ = norm(L);
  }

  bool sameAs(const FreeRotation& o) const {
    for (int i = 0; i < 3; ++i) {
      if (D_[i] != o.D_[i] || L_[i] != o.L_[i] || R_.column[i].at != o.R_.column[i].at) return false;
    }
    return true;
  }

  /// Principal axes to world, `elapsed` >= 0 after the start (small negative values are fine).
  RMat orientationAt(const Real& elapsed) {
    if (speed_ == 0) return R_;
    if (segments_.empty()) segments_.push_back(expand(0, R_));
    while (segments_.back().start + segments_.back().length < elapsed) {
      const Segment& last = segments_.back();
      segments_.push_back(expand(last.start + last.length, evaluate(last, last.length)));
    }
    std::size_t k = segments_.size() - 1;
    while (k > 0 && segments_[k].start > elapsed) --k;
    return evaluate(segments_[k], elapsed - segments_[k].start);
  }

  /// World angular velocity R D R^T L at orientation R.
  RVec spinAt(const RMat& R) const { return R * times(D_, transposeTimes(R, L_)); }

 private:
  // Half of ln(1/tolerance) to all of it: there a second of flight costs the fewest products of coefficients.
  static constexpr int kOrder = 36;
  static constexpr double kTolerance = 1e-32;

  struct Segment {
    Real start, length;
    RMat R;
    RVec u0;
    std::array<RVec, kOrder + 1> u;
    std::array<Real, kOrder + 1> psi;
  };

  Segment expand(const Real& start, const RMat& R) const {
    Segment s;
    s.start = start;
    s.R = orthonormal(R);
    s.u0 = s.u[0] = unit(transposeTimes(s.R, L_));
    const RVec rate{speed_ * (D_[2] - D_[1]), speed_ * (D_[0] - D_[2]), speed_ * (D_[1] - D_[0])};
    const RVec Du0 = times(D_, s.u0);
    const Real twice_energy = dot(s.u0, Du0);
    std::array<Real, kOrder + 1> minus_denominator, f;
    Real scratch;
    for (int k = 0; k <= kOrder; ++k) {
      minus_denominator[k] = -dot(s.u0, s.u[k]);
      f[k] = dot(Du0, s.u[k]);
      if (k == 0) minus_denominator[0] -= 1, f[0] += twice_energy;
      for (int j = 1; j <= k; ++j) addProduct(f[k], scratch, minus_denominator[j], f[k - j]);
      f[k] /= -minus_denominator[0];
      if (k == kOrder) break;
      RVec sum;
      for (int j = 0; j <= k; ++j) {
        const RVec &p = s.u[j], &q = s.u[k - j];
        for (int i = 0; i < 3; ++i) addProduct(sum[i], scratch, p[(i + 1) % 3], q[(i + 2) % 3]);
      }
      s.u[k + 1] = (Real(1) / (k + 1)) * times(rate, sum);
      s.psi[k + 1] = speed_ * f[k] / (k + 1);
    }
    s.length = stepOf(s);
    return s;
  }

  /// Step at which the last terms fall to the tolerance; the cap keeps u far from -u0.
  double stepOf(const Segment& s) const {
    const double spin = static_cast<double>(speed_ * std::max({D_[0], D_[1], D_[2]}));
    double step = 0.8 / spin;
    for (int k : {kOrder - 1, kOrder}) {
      Real largest = abs(s.psi[k]);
      for (int i = 0; i < 3; ++i) largest = std::max(largest, Real(abs(s.u[k][i])));
      if (largest == 0) continue;
      const double logarithm = (std::log(kTolerance) - static_cast<double>(log(largest))) / k;
      step = std::min(step, 0.9 * std::exp(logarithm));
    }
    return step;
  }

  /// Without this the swing of an R that is off by rounding doubles the error in every segment.
  static RMat orthonormal(const RMat& R) {
    RMat Q;
    Q.column[0] = unit(R.column[0]);
    Q.column[2] = unit(cross(R.column[0], R.column[1]));
    Q.column[1] = cross(Q.column[2], Q.column[0]);
    return Q;
  }

  static RMat evaluate(const Segment& s, const Real& t) {
    RVec u = s.u[kOrder];
    Real psi = s.psi[kOrder];
    for (int k = kOrder - 1; k >= 0; --k) u = t * u + s.u[k], psi = psi * t + s.psi[k];
    return s.R * (rotationAbout(s.u0, psi) * transpose(swing(s.u0, unit(u))));
  }

  RMat R_;
  RVec L_, D_;
  Real speed_;
  std::vector<Segment> segments_;
};

}  // namespace carom::reference
