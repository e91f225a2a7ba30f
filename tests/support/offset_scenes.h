// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <vector>

#include "adjoint/motion/plan.h"
#include "adjoint/scene/scene.h"

namespace carom::test {

/// One body, most with a centre of mass or principal axes that are not its shape's, thrown at a tilted floor: a shape,
/// a way of writing a body, or a kind of change of its inertia tensor. What touches the floor are swept points
/// (swept_points.h); shapes that have none fly. A new way adds one row.
struct OffsetScene {
  const char* name;
  Scene (*scene)();  ///< bodies: the thrown one, then the floor
  double duration;
  Tier tier, derivative_tier;
  bool products;
};
std::ostream& operator<<(std::ostream& out, const OffsetScene& row);
const std::vector<OffsetScene>& offsetScenes();

/// The same with the floor as first body.
Scene floorFirst(Scene scene);

}  // namespace carom::test
