// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/derivative/tangent.h"
#include "python/src/motion.hpp"

namespace carom::python {

/// When a state is read: exactly one of the three is given.
struct PyInstant {
  std::optional<double> at;
  std::optional<EventName> before, after;
};
/// The instant in a motion. Throws InputError unless one is given, and for events of another motion.
Instant instantIn(const MotionContent& motion, const PyInstant& instant);

/// carom.Seed: weights of a state; body and instant are looked up in the motion that it is used with.
struct PySeed {
  BodyName body;
  PyInstant instant;
  StateSeed weights;
};
StateSeed seedIn(const MotionContent& motion, const PySeed& seed);

/// carom.Reliability, with names in place of indices.
struct PyReliability {
  PyReliability(const Reliability& of, const Scene& scene);
  Reliability reliability;
  std::vector<std::string> unreliable_for;  ///< parameters that are excepted
};

/// carom.SceneGradient and carom.SceneTangent.
struct PyGradient {
  std::shared_ptr<const Scene> scene;
  SceneGradient values;
  PyReliability reliability;
};
struct PyTangent {
  PyScene scene;
  SceneTangent values;
};

void bindSeeds(nb::module_& module);
void bindReliability(nb::module_& module);
void bindSceneDerivatives(nb::module_& module);
void bindDerivatives(nb::module_& module);

}  // namespace carom::python
