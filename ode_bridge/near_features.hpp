// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// A feature of a solid.
struct FeatureName {
  Family family;
  int index;
};

/// The few features of a piece that pass near a point.
struct NearFeatures {
  static constexpr int kMost = 64;
  int count = 0;
  std::array<FeatureName, kMost> all;

  void add(Family family, int index) {
    if (count < kMost) all[static_cast<std::size_t>(count++)] = {family, index};
  }
  const FeatureName* begin() const { return all.data(); }
  const FeatureName* end() const { return all.data() + count; }
};

/// Features that come within `distance` of p, in the solid's axes. Every one of a ball, a capsule or a half space.
NearFeatures featuresNear(const Solid& solid, const Piece& piece, const Vec3& p, double distance);

/// How far p, taken to lie in the plane of a face, is outside of it, m: negative inside.
double outsideFace(const Solid& solid, const SolidFace& face, const Vec3& p);

}  // namespace carom::ode_bridge_detail
