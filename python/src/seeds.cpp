// SPDX-License-Identifier: MIT
#include "adjoint/base/errors.h"
#include "python/src/arrays.hpp"
#include "python/src/derivatives.hpp"

namespace carom::python {
namespace {

using Weights = std::optional<ArrayLike>;

Vec3 weightsOf(const Weights& given, const char* where) { return given ? vectorOf(*given, where) : Vec3(Vec3::Zero()); }

Eigen::VectorXd sizesOf(const Weights& given) {
  if (!given) return {};
  return columnOf(*given, "size");
}

void makeSeed(PySeed* self, const BodyName& body, std::optional<double> at, const std::optional<EventName>& before,
              const std::optional<EventName>& after, const Weights& position, const Weights& orientation,
              const Weights& velocity, const Weights& angular_velocity, const Weights& center_of_mass, double time,
              double mass, const Weights& inertia, const Weights& size, const Weights& gravity) {
  if (int(at.has_value()) + int(before.has_value()) + int(after.has_value()) != 1)
    throw InputError("at", "expected exactly one of at, before and after");
  StateSeed seed;
  seed.position = weightsOf(position, "position");
  seed.orientation = weightsOf(orientation, "orientation");
  seed.velocity = weightsOf(velocity, "velocity");
  seed.angular_velocity = weightsOf(angular_velocity, "angular_velocity");
  seed.center_of_mass = weightsOf(center_of_mass, "center_of_mass");
  seed.time = time;
  seed.mass = mass;
  if (inertia) seed.inertia = matrixOf(*inertia, "inertia");
  seed.size = sizesOf(size);
  seed.gravity = weightsOf(gravity, "gravity");
  new (self) PySeed{body, {at, before, after}, seed};
}

std::string eventText(const EventName& event) {
  const auto* index = std::get_if<int>(&event);
  return "event " + std::to_string(index ? *index : std::get<PyEvent>(event).index);
}

std::string reprOfSeed(const PySeed& self) {
  const auto* name = std::get_if<std::string>(&self.body);
  const std::string body = name ? "'" + *name + "'" : "body " + std::to_string(std::get<int>(self.body));
  const PyInstant& instant = self.instant;
  const std::string when = instant.at ? "at " + numberText(*instant.at) + " s"
                           : instant.before ? "before " + eventText(*instant.before)
                                            : "after " + eventText(*instant.after);
  return "<Seed of " + body + " " + when + ">";
}

constexpr const char* kSeedText =
    "A linear functional of the state of a body: weights of its position, orientation (as a world rotation vector), "
    "velocity, angular velocity and centre of mass, 3 numbers each.\n\n"
    "The state is read at a fixed time (`at`, s), or just `before` or `after` an event, given as an Event or its index: "
    "then the time varies with the scene parameters, and `time` is its weight. Further weights: of scene parameters on "
    "which a functional depends directly, `mass`, `inertia` (3, 3), `size` (one per dimension of the shape), `gravity`.";

}  // namespace

Instant instantIn(const MotionContent& motion, const PyInstant& instant) {
  if (int(instant.at.has_value()) + int(instant.before.has_value()) + int(instant.after.has_value()) != 1)
    throw InputError("t", "expected exactly one of t, before and after");
  if (instant.at) return Instant::at(*instant.at);
  const EventName& named = instant.before ? *instant.before : *instant.after;
  const int event = eventOf(motion, named), count = static_cast<int>(motion.motion.events.size());
  if (event < 0 || event >= count)  // an Instant without an event is one at a time
    throw InputError("event " + std::to_string(event), "expected an index from 0 to " + std::to_string(count - 1));
  return instant.before ? Instant::before(event) : Instant::after(event);
}

StateSeed seedIn(const MotionContent& motion, const PySeed& seed) {
  StateSeed weights = seed.weights;
  weights.body = bodyOf(*motion.motion.scene, seed.body);
  weights.at = instantIn(motion, seed.instant);
  return weights;
}

std::vector<StateSeed> seedsIn(const MotionContent& motion, const SeedsArgument& seeds) {
  if (const auto* one = std::get_if<PySeed>(&seeds)) return {seedIn(motion, *one)};
  std::vector<StateSeed> all;
  for (const PySeed& seed : std::get<std::vector<PySeed>>(seeds)) all.push_back(seedIn(motion, seed));
  return all;
}

void bindSeeds(nb::module_& module) {
  const auto none = nb::none();
  nb::class_<PySeed>(module, "Seed", kSeedText)
      .def("__init__", &makeSeed, nb::arg("body"), nb::arg("at") = none, nb::kw_only(), nb::arg("before") = none,
           nb::arg("after") = none, nb::arg("position") = none, nb::arg("orientation") = none,
           nb::arg("velocity") = none, nb::arg("angular_velocity") = none, nb::arg("center_of_mass") = none,
           nb::arg("time") = 0.0, nb::arg("mass") = 0.0, nb::arg("inertia") = none, nb::arg("size") = none,
           nb::arg("gravity") = none)
      .def("__repr__", &reprOfSeed);
}

}  // namespace carom::python
