// SPDX-License-Identifier: MIT
#include "formats/base/turn_from_z.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace carom::formats_detail {
namespace {

/// The Householder reflection that takes the components of a vector from `first` on to one of them.
struct Reflection {
  int first;
  Vec3 essential = Vec3::Zero();  // after a 1 at `first`
  double tau = 0;

  Reflection(const Vec3& x, int the_first) : first(the_first) {
    double tail = 0;
    for (int i = 2; i > first; --i) tail += x[i] * x[i];
    if (tail <= std::numeric_limits<double>::min()) return;
    const double length = std::sqrt(x[first] * x[first] + tail);
    const double beta = x[first] >= 0 ? -length : length;
    for (int i = first + 1; i < 3; ++i) essential[i] = x[i] / (x[first] - beta);
    tau = (beta - x[first]) / beta;
  }

  void apply(Vec3& x) const {
    double sum = 0;
    for (int i = first + 1; i < 3; ++i) sum += essential[i] * x[i];
    sum += x[first];
    x[first] -= tau * sum;
    for (int i = first + 1; i < 3; ++i) x[i] -= tau * essential[i] * sum;
  }
};

/// Orthogonal to two unit vectors that are nearly parallel: the last column of Q in their pivoted QR decomposition.
Vec3 orthogonalTo(Vec3 a, Vec3 b) {
  const double scale = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  a /= scale, b /= scale;
  if (b.norm() > a.norm()) std::swap(a, b);
  const Reflection first(a, 0);
  first.apply(b);
  const Reflection second(b, 1);
  Vec3 axis = Vec3::UnitZ();
  second.apply(axis);
  first.apply(axis);
  return axis;
}

}  // namespace

Quat turnFromZ(const Vec3& direction) {
  const Vec3 z = Vec3::UnitZ(), to = direction.normalized();
  const double cosine = to.dot(z);
  Quat turn;
  if (cosine < -1 + Eigen::NumTraits<double>::dummy_precision()) {
    const double squared = (1 + std::max(cosine, -1.0)) * 0.5;  // of the cosine of the half angle
    turn.w() = std::sqrt(squared);
    turn.vec() = orthogonalTo(z, to) * std::sqrt(1 - squared);
    return turn;
  }
  const double twice = std::sqrt((1 + cosine) * 2);  // the cosine of the half angle
  turn.vec() = z.cross(to) * (1 / twice);
  turn.w() = twice * 0.5;
  return turn;
}

}  // namespace carom::formats_detail
