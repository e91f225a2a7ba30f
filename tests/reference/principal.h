// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/real.h"

namespace carom::reference {

/// Principal moments of a symmetric matrix and the axes they belong to (columns, right-handed), by Jacobi's rotations.
/// A diagonal matrix keeps its order.
struct Principal {
  RVec moments;
  RMat axes = RMat::identity();
};

inline Principal principalOf(RMat J) {
  Principal p;
  for (int sweep = 0; sweep < 60; ++sweep) {
    Real off = 0;
    for (int i = 0; i < 3; ++i) {
      const int k = i, l = (i + 1) % 3;
      const Real& product = J.column[l][k];
      off = std::max(off, Real(abs(product)));
      if (product == 0) continue;
      const Real theta = (J.column[l][l] - J.column[k][k]) / (2 * product);
      const Real t = (theta < 0 ? Real(-1) : Real(1)) / (abs(theta) + sqrt(theta * theta + 1));
      const Real c = 1 / sqrt(t * t + 1), s = t * c;
      RMat G = RMat::identity();
      G.column[k][k] = G.column[l][l] = c;
      G.column[l][k] = s, G.column[k][l] = -s;
      J = transpose(G) * (J * G);
      p.axes = p.axes * G;
    }
    if (off == 0 || off < 1e-60) break;
  }
  for (int i = 0; i < 3; ++i) p.moments[i] = J.column[i][i];
  return p;
}

}  // namespace carom::reference
