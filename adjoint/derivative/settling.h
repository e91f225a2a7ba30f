// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"

namespace carom {

/// How Event::settles_at varies with the scene, s a unit of each number: of a ball that bounces to rest, or to roll, on
/// a flat face of a fixed body. With n the normal towards the ball, v its velocity just before the event at t, e the
/// elasticity, and G its gravity,
///   settles_at = t + 2 e / (1 - e) (n.v) / (n.G).
/// That is the same at every bounce of the cascade; derivatives are those of the first, which loses the fewest digits.
/// Throws InputError for an event that the motion does not have, or that nothing settles at; NotComputable where the
/// body is no ball, or the face is none, or not fixed, and otherwise as `adjoint`.
SceneGradient settlesAtGradient(DerivativeTape& tape, int event, Reliability* reliability = nullptr);

/// Its rate along a direction. Throws the same, and as `tangent`.
double settlesAtRate(DerivativeTape& tape, const SceneTangent& direction, int event);

}  // namespace carom
