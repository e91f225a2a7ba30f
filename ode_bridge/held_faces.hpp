// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "ode_bridge/gaps.hpp"
#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// The planes along which two bodies stay in contact, and the pairs of their pieces that such a plane keeps apart: what
/// is on the outer side of it, and stays there, cannot meet what is on its inner side. Pieces are asked for as they are
/// met, so that of a large mesh only those near the contact are looked at.
class HeldFaces {
 public:
  /// Bodies a and b are placed as they are when the contact begins, or later.
  HeldFaces(const Placed& a, const Placed& b, std::span<const FeaturePair> held);

  /// Whether these pieces, of a and of b, cannot meet as long as the contact lasts.
  bool keepApart(int piece_a, int piece_b) const;

 private:
  struct Side {
    Placed body;
    Family family;
    int feature;
  };
  struct Plane {
    Side a, b;
    Vec3 n;        // from b to a
    double level;  // along n, seen from the origin of b
    double room;   // for rounding
  };
  static bool holds(const Side& side, int piece);
  static bool staysBeyond(const Side& side, int piece, const Vec3& n, double level, double room);

  std::vector<Plane> planes_;
};

}  // namespace carom::ode_bridge_detail
