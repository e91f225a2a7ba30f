// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/derivative/tangent.h"
#include "adjoint/second_order/second_order.h"
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
/// One of them or a list.
using SeedsArgument = std::variant<PySeed, std::vector<PySeed>>;
std::vector<StateSeed> seedsIn(const MotionContent& motion, const SeedsArgument& seeds);

/// carom.BodyStateRate.
struct PyStateRate {
  BodyStateRate rate;
};

/// A function of Python that may be called and let go of by any thread.
std::shared_ptr<nb::object> sharedFunction(const nb::object& function);
/// Rates of the weights of seeds by a function of Python: from a list of BodyStateRate to a list of Seed.
SeedRates seedRatesBy(const nb::object& function);

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
void bindSecondOrder(nb::module_& module);
void bindDerivatives(nb::module_& module);

}  // namespace carom::python
