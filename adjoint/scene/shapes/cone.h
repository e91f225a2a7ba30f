// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/shapes/kind_of.h"

namespace carom {

/// Round cone about z, its base at -height/2 and its apex at height/2; the centre of mass lies height/4 above the base.
struct Cone {
  double radius = 0.5;  ///< of the base, m
  double height = 1;    ///< m
  bool operator==(const Cone&) const = default;  ///< the same numbers
};

namespace shapes {
/// The row of the cone in the table of shapes.
ShapeKind kindRow(KindOf<Cone>);
}  // namespace shapes

}  // namespace carom
