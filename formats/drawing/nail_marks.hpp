// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom::formats_detail {

/// Where a nailed place may lie: in its axes between two corners, which are equal in components with a target and
/// infinite where nothing is asked.
struct AllowedBox {
  Vec3 low, high;
  Vec3 origin = Vec3::Zero();    ///< of its axes, m, world
  Quat axes = Quat::Identity();  ///< to world
};

/// A constraint as it is drawn.
struct NailMark {
  int body = -1;
  std::string label;                  ///< such as "book at 1.2 s"
  Vec3 target = Vec3::Zero();         ///< nailed place, NaN where free; where the body is, when no place is nailed
  bool nails_position = false;        ///< of the body or one of its points
  std::optional<Vec3> place;          ///< the nailed place, free components from the motion; none where it has none
  std::optional<AllowedBox> allowed;  ///< where a component of the place has a range, or its axes are another body's
  std::optional<Quat> orientation;    ///< nailed, to world
  std::optional<Vec3> pose_origin;    ///< where the nailed pose is drawn: the target, free components from the motion
};

/// The nails of a document, seen with a motion: at some time of a span means the one at which it is most nearly met.
/// One that has no place (its impact or its time does not come, and no position is nailed) is left out.
std::vector<NailMark> nailsOf(const Document& document, const Motion& motion);

/// A region as it is drawn.
struct RegionMark {
  Region::Side side;
  Shape shape;
  Vec3 position;
  Quat orientation;
  std::string label;  ///< such as "ball stays out, 1 to 2 s"
};
std::vector<RegionMark> regionsOf(const Document& document);

}  // namespace carom::formats_detail
