// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"

namespace carom {

/// Gradient of Event::settles_at with respect to all scene parameters, s per unit of each: for a ball that bounces to
/// rest, or to rolling, on a flat face of a fixed body. With n the normal towards the ball, v its velocity just
/// before the event at t, e the coefficient of restitution, and G its gravity,
///   settles_at = t + 2 e / (1 - e) (n.v) / (n.G).
/// That is the same at every bounce of the cascade; derivatives are taken at the first, which loses the fewest
/// digits. Throws InputError for an invalid event, or one without settles_at; NotComputable if the body is not a
/// ball, or does not settle on a flat face of a fixed body, and otherwise as `adjoint`.
SceneGradient settlesAtGradient(DerivativeTape& tape, int event, Reliability* reliability = nullptr);

/// Its directional derivative. Throws the same, and as `tangent`.
double settlesAtRate(DerivativeTape& tape, const SceneTangent& direction, int event);

}  // namespace carom
