// SPDX-License-Identifier: MIT
#include "formats/drawing/motion_extent.hpp"

#include <algorithm>

#include "adjoint/base/arguments.hpp"

namespace carom::formats_detail {

using namespace adjoint_detail;

std::size_t movingCount(const Scene& scene) {
  const auto moves = [](const Body& body) { return !body.fixed; };
  return static_cast<std::size_t>(std::count_if(scene.bodies.begin(), scene.bodies.end(), moves));
}

double arcEnd(const Motion& motion, int body, int k) {
  const auto& arcs = motion.world_lines[checkedIndex("arcEnd", "body", body, motion.world_lines.size())].arcs;
  checkedIndex("arcEnd", "arc", k, arcs.size());
  return k + 1 < static_cast<int>(arcs.size()) ? arcs[k + 1].start() : motion.end;
}

Vec3 centreAt(const Motion& motion, int body, double t) {
  checkedIndex("centreAt", "body", body, motion.world_lines.size());
  return motion.world_lines[body].arcs[motion.arcAt(body, t)].positionAt(t);
}

Extent pathExtent(const Motion& motion, int body) {
  Extent extent;
  const auto& arcs = motion.world_lines[checkedIndex("pathExtent", "body", body, motion.world_lines.size())].arcs;
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k) {
    const Arc& arc = arcs[k];
    const double end = arcEnd(motion, body, k);
    extent.extend(arc.positionAt(arc.start()));
    extent.extend(arc.positionAt(end));
    if (arc.accelerationVariation() > 0)  // round a bend: near enough for a picture
      for (int i = 1; i < 200; ++i) extent.extend(arc.positionAt(arc.start() + (end - arc.start()) * i / 200));
    const Vec3 v = arc.velocityAt(arc.start());
    for (int axis = 0; axis < 3; ++axis) {
      const double turn = arc.start() - v[axis] / arc.acceleration()[axis];  // not finite without acceleration
      if (turn > arc.start() && turn < end) extent.extend(arc.positionAt(turn));
    }
  }
  return extent;
}

Extent motionExtent(const Motion& motion) {
  Extent all;
  const auto& bodies = motion.scene->bodies;
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
    if (bodies[body].fixed) continue;
    Extent extent = pathExtent(motion, body);
    const Vec3 margin = Vec3::Constant(radiusAbout(bodies[body].shape, (*motion.models)[body].center));
    all.extend(Extent(extent.min() - margin, extent.max() + margin));
  }
  return all.isEmpty() ? Extent(Vec3::Constant(-0.5), Vec3::Constant(0.5)) : all;
}

}  // namespace carom::formats_detail
