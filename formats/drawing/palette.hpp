// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom::formats_detail {

/// An sRGB colour, components in [0, 1].
struct Colour {
  double r = 0, g = 0, b = 0;

  std::string hex() const;               ///< "#rrggbb"
  std::array<double, 3> linear() const;  ///< linear light, as glTF wants it
  Colour mixedWith(const Colour& other, double share) const;
};

/// The colours of moving bodies. Each is told apart from the others by colour-blind people as well, and has a contrast of
/// at least 3 to 1 to white.
std::vector<Colour> bodyColours();

/// The colour of a body in 3-D exports: moving bodies take distinct colours in their order, fixed ones take greys.
Colour bodyColour(const Scene& scene, int body);

}  // namespace carom::formats_detail
