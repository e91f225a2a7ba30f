// SPDX-License-Identifier: MIT
#include "editing/problem/rows/region_way.hpp"

#include <algorithm>
#include <cmath>


namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

void keepLower(PlaceOnWay& best, const PlaceOnWay& candidate) {
  if (candidate.value < best.value) best = candidate;
}

// Where a distance y(s) -> sum of gradients may be least: the ends, and where the derivative vanishes.
template <int N>
std::vector<double> stationary(const Polynomial<N>& p, double lo, double hi) {
  std::vector<double> times = rootsIn<N - 1>(derivativeOf<N>(p), lo, hi);
  times.insert(times.begin(), hi);
  times.push_back(lo);
  return times;
}

PlaceOnWay leastToSphere(const Stretch& stretch, double radius, double margin, double side) {
  PlaceOnWay best;
  for (double s : stationary<4>(stretch.squaredDistance(), stretch.lo, stretch.hi)) {
    const Vec3 y = stretch.placeAt(s);
    const double distance = y.norm();
    const Vec3 out = distance > 0 ? Vec3(y / distance) : stretch.velocityAt(s).unitOrthogonal();
    const double bend = distance > 0 ? side / distance : 0;
    keepLower(best, {side * (distance - radius) - margin, s, side * out, bend});
  }
  return best;
}

// Face 2 k is that on the side of +e_k, face 2 k + 1 that of -e_k; distance to it, positive outside.
Polynomial<2> faceDistance(const Stretch& stretch, const Vec3& half, int face) {
  const double sign = face % 2 == 0 ? 1 : -1;
  Polynomial<2> d = stretch.y[static_cast<std::size_t>(face / 2)];
  for (double& c : d) c *= sign;
  d[0] -= half[face / 2];
  return d;
}
Vec3 faceNormal(int face) { return (face % 2 == 0 ? 1 : -1) * Vec3::Unit(face / 2); }

PlaceOnWay leastToFace(const Stretch& stretch, const Vec3& half, double margin, int face) {
  const Polynomial<2> d = faceDistance(stretch, half, face);
  PlaceOnWay best;
  for (double s : stationary<2>(d, stretch.lo, stretch.hi))
    keepLower(best, {-valueAt<2>(d, s) - margin, s, -faceNormal(face)});
  return best;
}

// The upper envelope of the distances to the six faces is least at an end, at the vertex of one of them, or where two
// of them cross; there its derivative is the mean of theirs that is stationary in time.
PlaceOnWay leastToBox(const Stretch& stretch, const Vec3& half, double margin) {
  std::array<Polynomial<2>, 6> d;
  for (int f = 0; f < 6; ++f) d[static_cast<std::size_t>(f)] = faceDistance(stretch, half, f);
  const auto highest = [&](double s) {
    int best = 0;
    for (int f = 1; f < 6; ++f)
      if (valueAt<2>(d[static_cast<std::size_t>(f)], s) > valueAt<2>(d[static_cast<std::size_t>(best)], s)) best = f;
    return best;
  };
  PlaceOnWay best;
  const auto tryAt = [&](double s) {
    const int face = highest(s);
    keepLower(best, {valueAt<2>(d[static_cast<std::size_t>(face)], s) - margin, s, faceNormal(face)});
  };
  for (std::size_t f = 0; f < 6; ++f)
    for (double s : stationary<2>(d[f], stretch.lo, stretch.hi)) tryAt(s);
  for (std::size_t f = 0; f < 6; ++f)
    for (std::size_t g = f + 1; g < 6; ++g) {
      Polynomial<2> difference;
      for (std::size_t k = 0; k < 3; ++k) difference[k] = d[f][k] - d[g][k];
      for (double s : rootsIn<2>(difference, stretch.lo, stretch.hi)) {
        const double value = std::max(valueAt<2>(d[f], s), valueAt<2>(d[g], s));
        const auto top = static_cast<std::size_t>(highest(s));
        if (valueAt<2>(d[top], s) > value) continue;
        const double rate_f = valueAt<1>(derivativeOf<2>(d[f]), s), rate_g = valueAt<1>(derivativeOf<2>(d[g]), s);
        if (!(rate_f * rate_g < 0)) continue;  // the envelope goes on falling, or rising
        const double weight = rate_g / (rate_g - rate_f);
        const PlaceOnWay crossing{
            value - margin, s,
            weight * faceNormal(static_cast<int>(f)) + (1 - weight) * faceNormal(static_cast<int>(g)), 0,
            faceNormal(static_cast<int>(f)) - faceNormal(static_cast<int>(g))};
        // the ends of the other candidates may fall on the same time with one face alone
        if (crossing.value <= best.value) best = crossing;
      }
    }
  return best;
}

}  // namespace

Vec3 accelerationAt(const Arc& arc, double t) {
  return arc.isStraight() ? arc.acceleration() : arc.rateAt(t, arc.stateAt(t)).v;
}

PlaceOnWay least(const Stretch& stretch, const BoundRegion& bound, int component) {
  const bool avoid = bound.region.side == Region::Side::avoid;
  if (const auto* sphere = std::get_if<Sphere>(&bound.region.shape))
    return leastToSphere(stretch, sphere->radius, bound.margin, avoid ? 1 : -1);
  const Vec3 half = 0.5 * std::get<Box>(bound.region.shape).size;
  return avoid ? leastToBox(stretch, half, bound.margin) : leastToFace(stretch, half, bound.margin, component);
}

Stretch stretchAround(const Arc& arc, const Region& region, double at, double from, double to) {
  Stretch stretch;
  stretch.R = region.orientation.normalized().toRotationMatrix();
  stretch.start = at;
  stretch.lo = from - at, stretch.hi = to - at;
  const Vec3 y = stretch.R.transpose() * (arc.positionAt(at) - region.position),
             v = stretch.R.transpose() * arc.velocityAt(at), g = stretch.R.transpose() * accelerationAt(arc, at);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    stretch.y[k] = {y[i], v[i], 0.5 * g[i]};
  }
  return stretch;
}

}  // namespace carom::editing_detail
