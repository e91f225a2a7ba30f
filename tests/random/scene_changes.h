// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "adjoint/motion/motion.h"
#include "tests/support/scenes.h"

/// Ways to write a scene that do not change its motion.
namespace carom::metamorphic {

/// A scene changed in a way that is undone by `back`, which takes states to those of the base. Times are of `clock` units.
struct Change {
  std::string name;
  Scene scene;
  std::function<BodyState(const BodyState&, double time)> back;
  double clock = 1;
  double size = 1;  ///< of its numbers: what their rounding is of
};

Change turned(const Scene& scene, test::Random& random);
Change moved(const Scene& scene, test::Random& random);  ///< by a kilometre
Change mirrored(const Scene& scene);                     ///< x to -x
/// Everything flies along with 30 m/s; what is fixed becomes kinematic. Planes cannot.
Change boosted(const Scene& scene, test::Random& random);
/// With units of length, time and mass that are so many times smaller.
Change inUnits(const Scene& scene, double length, double time, double mass);
/// Random ones.
Change inUnits(const Scene& scene, test::Random& random);
Change reordered(const Scene& scene, test::Random& random);
/// Bodies are added that nothing meets.
Change withFarBodies(const Scene& scene, test::Random& random);

enum class Kind { box, hull, mesh, compound };
Change boxesAs(Kind kind, const Scene& scene);
/// Blocks of 40 m, beyond which nothing gets, their tops where the planes are.
Change planesAs(Kind kind, const Scene& scene);

bool hasPlanes(const Scene& scene);

}  // namespace carom::metamorphic
