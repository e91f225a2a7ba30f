// SPDX-License-Identifier: MIT
#pragma once

namespace carom::adjoint_detail {

/// Values at the ends a and b of an interval, by which regula falsi draws its chord: that of an end that stays twice is halved
/// (Illinois).
struct IllinoisEnds {
  double a, b;

  IllinoisEnds(double at_a, double at_b) : a(at_a), b(at_b) {}
  void moveA(double value) {
    a = value;
    if (moved_ == 1) b *= 0.5;
    moved_ = 1;
  }
  void moveB(double value) {
    b = value;
    if (moved_ == -1) a *= 0.5;
    moved_ = -1;
  }

 private:
  int moved_ = 0;
};

}  // namespace carom::adjoint_detail
