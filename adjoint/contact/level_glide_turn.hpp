// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "adjoint/contact/turn_series.hpp"

namespace carom::adjoint_detail {

/// How a ball turns that slides on a level face, where its slip s = s0 y, y = 1 - t/T, goes along a line: the turn E over
/// [0, t] at the angular velocity a + b t, and the integrals of E^T, of t E^T and of (x + y log y) E^T d, x = t/T. The last
/// is what the slope of the face, which is 0, does to the slip across its direction d (11.18 of docs/equations.md).
struct LevelGlideTurn {
  Mat3 E = Mat3::Identity(), M0 = Mat3::Zero(), M1 = Mat3::Zero();
  Vec3 bend = Vec3::Zero();

  /// `t`: at most T, the end of the slip.
  LevelGlideTurn(const Vec3& a, const Vec3& b, const Vec3& d, double t, double T);

  static constexpr std::size_t kTerms = kTurnTerms + 2;
  /// Of the terms of a series in the last integral.
  using Weights = std::array<double, kTerms>;

 private:
  // The turn over a segment, the integrals of it and of it times the share of the segment, and that of its transpose
  // times d, weighted.
  struct Segment {
    Mat3 turn, K0, K1;
    Vec3 bent;
  };
  static Segment segment(const Vec3& wh, const Vec3& bh2, const Vec3& d, const Weights& weights);
  static Segment planarSegment(const Vec3& wh, const Vec3& bh2, const Vec3& d, const Weights& weights);
  void add(const Segment& s, double h, double now);
};

/// Shares of a level glide: of y log y and its integral, which is 0 at x = 0, with all their digits where x is small.
double bentSlip(double x);          ///< x + y log y
double bentSlipIntegral(double x);  ///< of that from 0 to x

}  // namespace carom::adjoint_detail
