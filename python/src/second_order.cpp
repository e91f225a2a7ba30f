// SPDX-License-Identifier: MIT
#include "adjoint/second_order/second_order.h"

#include "adjoint/derivative/adjoint.h"
#include "python/src/arrays.hpp"
#include "python/src/derivatives.hpp"

namespace carom::python {
namespace {

/// carom.ReadingDirection.
struct PyReadingDirection {
  PyTangent scene;
  Eigen::VectorXd time;
};

/// carom.SecondOrder.
struct PySecondOrder {
  PyGradient gradient;
  std::vector<PyGradient> gradient_rates;
  std::vector<Eigen::VectorXd> time_rates;
};

using DirectionArgument = std::variant<PyTangent, PyReadingDirection>;

ReadingDirection directionOf(const DirectionArgument& argument) {
  if (const auto* scene = std::get_if<PyTangent>(&argument)) return {scene->values, {}};
  const auto& both = std::get<PyReadingDirection>(argument);
  return {both.scene.values, both.time};
}

PySecondOrder secondOrderOf(const PyMotion& motion, const SeedsArgument& seeds,
                            const std::vector<DirectionArgument>& directions, const nb::object& seed_rates) {
  const std::vector<StateSeed> resolved = seedsIn(*motion.content, seeds);
  std::vector<ReadingDirection> along;
  for (const DirectionArgument& direction : directions) along.push_back(directionOf(direction));
  const SeedRates rates = seedRatesBy(seed_rates);
  const auto& scene = motion.motion().scene;
  const Computing free;
  return motion.content->withTape([&](DerivativeTape& tape) {
    Reliability found;
    SceneGradient gradient = adjoint(tape, resolved, &found);
    const PyReliability reliability(found, *scene);  // the rates pass through the same events
    SecondOrder second = secondOrder(tape, resolved, rates, along);
    PySecondOrder out{{scene, std::move(gradient), reliability}, {}, std::move(second.time_rates)};
    for (SceneGradient& rate : second.gradient_rates) out.gradient_rates.push_back({scene, std::move(rate), reliability});
    return out;
  });
}

std::vector<ReadOnly<-1>> timeRatesOf(const PySecondOrder& self) {
  std::vector<ReadOnly<-1>> all;
  for (const Eigen::VectorXd& rates : self.time_rates) all.push_back(copied<ReadOnly<-1>>(rates));
  return all;
}

constexpr const char* kSecondOrderText =
    "Exact second derivatives, forward over reverse: those of the gradient of the seeded functional along each direction, a "
    "SceneTangent, or a ReadingDirection if the times of seeds vary as well. seed_rates(rates) gives the rates of the weights "
    "of the seeds for the rates of the states that they read: from a list of BodyStateRate, one per seed, to a list of Seed, "
    "of which only the weights count; None: constant weights. It must not differentiate the same motion. The matrix over all "
    "scene parameters is symmetric except for orientations (docs/equations.md, section 9).\n\n"
    "Raises InputError as `adjoint`, NotComputable if has_second_order(motion) is False.";

}  // namespace

std::shared_ptr<nb::object> sharedFunction(const nb::object& function) {
  return {new nb::object(function), [](nb::object* kept) {
            const GilHeld held;
            delete kept;
          }};
}

SeedRates seedRatesBy(const nb::object& function) {
  if (function.is_none()) return {};
  if (PyCallable_Check(function.ptr()) == 0) throw nb::type_error("seed_rates: expected a function of rates of states");
  return [kept = sharedFunction(function)](std::span<const BodyStateRate> rates) {
    const GilHeld held;
    std::vector<PyStateRate> shown;
    for (const BodyStateRate& rate : rates) shown.push_back({rate});
    std::vector<PySeed> seeds;
    if (!nb::try_cast<std::vector<PySeed>>(calledBack(*kept, shown), seeds))
      throw nb::type_error("seed_rates gives a list of carom.Seed, one for each rate");
    std::vector<StateSeed> weights;
    for (const PySeed& seed : seeds) weights.push_back(seed.weights);
    return weights;
  };
}

void bindSecondOrder(nb::module_& module) {
  nb::class_<PyReadingDirection>(module, "ReadingDirection",
                                 "A direction of change of what is read: the scene, and the times of seeds at fixed times, s, "
                                 "one per seed (0 for those at events; None: constant).")
      .def("__init__",
           [](PyReadingDirection* self, const PyTangent& scene, const std::optional<ArrayLike>& time) {
             new (self) PyReadingDirection{scene, time ? columnOf(*time, "time") : Eigen::VectorXd()};
           },
           nb::arg("scene"), nb::arg("time") = nb::none())
      .def("__repr__", [](const PyReadingDirection& self) {
        return std::string("<ReadingDirection ") + (self.time.size() > 0 ? "with times>" : "at constant times>");
      });
  nb::class_<PySecondOrder>(module, "SecondOrder", "Directional derivatives of the gradient of a functional.")
      .def_prop_ro("gradient", [](const PySecondOrder& self) { return self.gradient; }, nb::rv_policy::move,
                   "That of `adjoint`.")
      .def_prop_ro("gradient_rates", [](const PySecondOrder& self) { return self.gradient_rates; }, nb::rv_policy::move,
                   "Its derivative along each direction; their reliability is that of the gradient.")
      .def_prop_ro("time_rates", &timeRatesOf, kOwnArray,
                   "For each direction an array: the derivative of d(functional)/d(time) of each seed; 0 for those at events.")
      .def("__repr__", [](const PySecondOrder& self) {
        return "<SecondOrder along " + std::to_string(self.gradient_rates.size()) + " directions>";
      });
  module.def("has_second_order",
             [](const PyMotion& motion) {
               const Computing free;
               return hasSecondOrder(motion.motion());
             },
             nb::arg("motion"),
             "Whether second derivatives are implemented for all of a motion. They are not where a body begins to tip, slides "
             "with friction without rotating, or moves on corners, edges or faces.");
  module.def("second_order", &secondOrderOf, nb::arg("motion"), nb::arg("seeds"), nb::arg("directions"), nb::kw_only(),
             nb::arg("seed_rates") = nb::none(),
             nb::sig("def second_order(motion: Motion, seeds: Seed | collections.abc.Sequence[Seed], directions: "
                     "collections.abc.Sequence[SceneTangent | ReadingDirection], *, seed_rates: "
                     "collections.abc.Callable[[list[BodyStateRate]], collections.abc.Sequence[Seed]] | None = None) -> "
                     "SecondOrder"),
             kSecondOrderText);
}

}  // namespace carom::python
