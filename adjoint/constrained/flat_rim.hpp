// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/constrained/constrained_lanes.hpp"
#include "adjoint/motion/rim_geometry.hpp"

namespace carom::adjoint_detail {

/// A rim that lies flat on a face and tilts from there (11.26): with d its axis and N the normal of the face x = d x N goes like
///   x' = (omega x d) x N,
/// and what goes down of it is the point p = C + rho d x x'/|x'|. So p depends on how the body turns, where the lowest point of a
/// rim that is tilted depends on its pose alone.
class FlatRim {
 public:
  /// Of contact k at the pose `own`, as the body turns with `omega`; none where it is no rim on a face,
  /// or is tilted. Throws NotComputable where it begins to tilt from rest: the point goes by how the tilt accelerates.
  static std::optional<FlatRim> of(const ConstrainedScene& scene, const PersistentContact& contact, std::size_t k, const Pose& own, const Vec3& omega);

  /// Fills normal and arm of the contact, and its gap, with their rates by the columns of `inputs`; not the rates of normal and
  /// place in time, which have no limit there. `lanes`: the body is filled.
  void place(const ConstrainedLanes& lanes, const ConstrainedInputs& inputs, std::size_t k, int first, int count,
             ContactInstant<ConstrainedLanes::Number>& contact, ConstrainedLanes::Number& gap) const;

 private:
  V3<ConstrainedLanes::Number> point(const ConstrainedLanes& lanes, const ConstrainedInputs& inputs, std::size_t k, int first, int count) const;

  RimOnFace rim_;
  Pose face_;
  Eigen::Matrix3Xd sizes_;      // of the point by the dimensions of its body
  Eigen::RowVectorXd of_face_;  // of the gap by those of the other
};

}  // namespace carom::adjoint_detail
