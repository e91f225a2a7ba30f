// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// The disc with which a round cap stands on a face that reaches beyond it: all of it carries, where the marks of its rim, which
/// stand for it, span a square within it.
struct FlatDisc {
  Vec3 center = Vec3::Zero();  ///< m, world
  double radius = 0;           ///< m

  /// Where `contacts` are all marks of one rim, and nothing else.
  static std::optional<FlatDisc> of(const Motion& motion, const std::vector<const Contact*>& contacts);

  /// From the border to what is above `point`, m; below 0 outside.
  double roomAround(const Vec3& point, const Vec3& normal) const;
  /// The point of the border next to what is above `point`.
  Vec3 borderAt(const Vec3& point, const Vec3& normal) const;
};

}  // namespace carom::adjoint_detail
