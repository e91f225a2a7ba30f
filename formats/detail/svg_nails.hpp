#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/motion.h"
#include "formats/document.h"

namespace carom {

/// A constraint as it is drawn.
struct Nail {
  int body = -1;
  std::string label;                ///< such as "book at 1.2 s"
  Vec3 target = Vec3::Zero();       ///< nailed position, NaN where free; where the body is, when no position is nailed
  bool nails_position = false;      ///< of the body or one of its points
  std::optional<Quat> orientation;  ///< nailed
  std::optional<Vec3> pose_origin;  ///< where the nailed pose is drawn: the target, free components from the motion
};

/// The nails of a document, seen with a motion. One that has no place (its impact or its time does not come, and no
/// position is nailed) is left out.
std::vector<Nail> nailsOf(const Document& document, const Motion& motion);

}  // namespace carom
