#pragma once

#include <array>
#include <string>

#include "adjoint/scene.h"

namespace carom {

/// An sRGB colour, components in [0, 1].
struct Colour {
  double r = 0, g = 0, b = 0;

  std::string hex() const;               ///< "#rrggbb"
  std::array<double, 3> linear() const;  ///< linear light, as glTF wants it
  Colour mixedWith(const Colour& other, double share) const;
};

/// The colour of a body in pictures and 3-D exports: moving bodies take distinct colours in their order (told apart by
/// colour-blind people as well, for the first eight), fixed ones take greys.
Colour bodyColour(const Scene& scene, int body);

}  // namespace carom
