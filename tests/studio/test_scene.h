// SPDX-License-Identifier: MIT
#pragma once

/// A ball that bounces on a floor once, and may be thrown otherwise; beside it a ball that nothing moves.
namespace carom::studio {

inline constexpr const char* kTestScene = R"({
  "carom": 1,
  "name": "A bounce",
  "duration": 1.2,
  "materials": { "felt": { "elasticity": 0.6, "friction": 0.3 } },
  "bodies": [
    { "name": "floor", "fixed": true, "material": "felt", "shape": { "plane": { "normal": [0, 0, 1] } } },
    { "name": "ball", "material": "felt", "mass": 0.2, "shape": { "sphere": { "radius": 0.1 } },
      "position": [0, 0, 1], "velocity": [1.5, 0, 1] },
    { "name": "other", "material": "felt", "mass": 0.2, "shape": { "sphere": { "radius": 0.1 } },
      "position": [0, 3, 1] }
  ],
  "controls": [ { "vary": "velocity", "body": "ball", "max": 20, "min": -20 } ]
}
)";

}  // namespace carom::studio
