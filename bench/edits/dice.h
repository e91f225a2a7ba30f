// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::bench {

/// Random numbers written out (splitmix64 of Steele, Lea and Flood, 2014), because the distributions of the standard
/// library differ between implementations.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t index, std::uint64_t attempt) : state_(seed) {
    state_ = bits() ^ index;
    state_ = bits() ^ attempt;
  }

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  double logIn(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }
  bool chance(double p) { return in(0, 1) < p; }
  int integer(int low, int high) { return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1)); }
  Vec3 inCube(double half) {
    const double x = in(-half, half), y = in(-half, half), z = in(-half, half);
    return {x, y, z};
  }
  /// Each coordinate in its own range. Drawn from the last on: the tasks whose smallest changes are known were.
  Vec3 inBox(const Vec3& low, const Vec3& high) {
    Vec3 v;
    for (const int i : {2, 1, 0}) v[i] = in(low[i], high[i]);
    return v;
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = inCube(1);
      if (v.norm() <= 1 && v.norm() > 0.1) return v.normalized();
    }
  }
  Quat rotation() {
    for (;;) {
      const Vec3 v = inCube(1);
      const Quat q(in(-1, 1), v.x(), v.y(), v.z());
      if (q.norm() <= 1 && q.norm() > 0.1) return q.normalized();
    }
  }
  template <class T>
  const T& oneOf(const std::vector<T>& list) {
    return list[static_cast<std::size_t>(integer(0, static_cast<int>(list.size()) - 1))];
  }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i)
      std::swap(list[i - 1], list[static_cast<std::size_t>(integer(0, static_cast<int>(i) - 1))]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace carom::bench
