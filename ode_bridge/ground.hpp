// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "ode_bridge/broad_phase.hpp"
#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// The fixed bodies that touch the fixed one of a pair: with it they are one ground.
struct GroundBeside {
  bool of_a = false;                         ///< beside the first of the pair
  std::span<const Placed* const> bodies = {};  ///< most often none
};

/// The fixed bodies of a scene, and which of them touch: by the boxes that they stand in, so it may name too many.
class Ground {
 public:
  /// A fixed body; one without a box is a half space { p : normal . p <= offset }.
  struct Standing {
    int body = -1;
    bool half_space = false;
    Bounds box{};
    Vec3 normal = Vec3::UnitZ();
    double offset = 0;
    Placed placed;
  };

  /// Of a scene of `count` bodies.
  void begin(std::size_t count, std::vector<Standing> standing);
  /// Those that touch a fixed body, in increasing order.
  std::span<const int> beside(int body) const;
  /// A fixed body; null for one that is not.
  const Placed* placedOf(int body) const;
  /// Beside the fixed one of bodies a and b.
  GroundBeside besideOf(int a, int b) const;

 private:
  struct Touched {
    std::vector<int> bodies;
    std::vector<const Placed*> placed;
  };
  std::vector<Standing> standing_;
  std::vector<int> at_;            // of each body in standing_, or -1
  std::vector<int> entry_;         // of each body in touched_; -1: it touches none
  std::vector<Touched> touched_;
};

}  // namespace carom::ode_bridge_detail
