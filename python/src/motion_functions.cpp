// SPDX-License-Identifier: MIT
#include "editing/motion_function.h"

#include <memory>
#include <stop_token>
#include <utility>
#include <vector>

#include "editing/check_motion_function.h"
#include "python/src/edit.hpp"

namespace carom::python {
namespace {

/// carom.Reading: what a function of the motion gives.
struct PyReading {
  double value = 0;
  std::vector<PySeed> seeds;
  nb::object seed_rates;
  bool second_order = false;
  std::string doubt, missing;
};

using OptionalWhen = std::optional<WhenArgument>;

/// Calls the function of Python with a motion of its own, which it may keep.
RowReading readingOf(const PyScene& scene, const nb::object& function, const Motion& motion) {
  const GilHeld held;
  const InCallback in;
  const PyMotion shown = motionOf(sceneWith(scene, *motion.scene), Motion(motion));
  const nb::object answer = calledBack(function, shown);
  PyReading reading;
  if (!nb::try_cast<PyReading>(answer, reading))
    throw nb::type_error("a function of the motion gives a carom.Reading(value, seeds)");
  RowReading row;
  row.value = reading.value;
  for (const PySeed& seed : reading.seeds) row.seeds.push_back(seedIn(*shown.content, seed));
  if (const SeedRates rates = seedRatesBy(reading.seed_rates))
    row.seed_rates = [rates](std::span<const BodyStateRate> of_states) {
      const InCallback in;
      return rates(of_states);
    };
  row.second_order = reading.second_order;
  row.doubt = reading.doubt;
  row.missing = reading.missing;
  return row;
}

MotionFunction motionFunction(const PyScene& scene, const std::string& name, const std::shared_ptr<nb::object>& function,
                              double scale, const OptionalWhen& until, const std::string& body) {
  MotionFunction made;
  made.name = name;
  made.read = [scene, function](const Motion& motion) { return readingOf(scene, *function, motion); };
  made.scale = scale;
  if (until) made.until = whenOf(*until);
  made.body = body;
  return made;
}

std::shared_ptr<nb::object> kept(const nb::object& function) {
  if (PyCallable_Check(function.ptr()) == 0) throw nb::type_error("expected a function of the motion");
  return sharedFunction(function);
}

/// The same for an edit, which calls it from now on.
MotionFunction motionFunction(const PyEdit& edit, const std::string& name, const nb::object& function, double scale,
                              const OptionalWhen& until, const std::string& body) {
  edit.content->functions.push_back(kept(function));
  return motionFunction(edit.content->scene, name, edit.content->functions.back(), scale, until, body);
}

PyEdit& required(PyEdit& self, const std::string& name, const nb::object& function, const WantedArgument& wanted,
                 double scale, const OptionalWhen& until, const std::string& body) {
  const OneAtATime::Use use(self.content->one, "the edit");
  self.content->edit.require(motionFunction(self, name, function, scale, until, body), wantedOf(wanted, "wanted"));
  return self;
}

PyEdit& minimised(PyEdit& self, const std::string& name, const nb::object& function, double change_weight, double scale,
                  const OptionalWhen& until, const std::string& body) {
  const OneAtATime::Use use(self.content->one, "the edit");
  self.content->edit.minimise(motionFunction(self, name, function, scale, until, body), change_weight);
  return self;
}

MotionFunctionCheck checked(const PyScene& scene, const nb::object& function, const std::vector<Control>& controls,
                            const std::string& name, std::optional<double> duration, double scale,
                            const OptionalWhen& until, const std::string& body) {
  const MotionFunction made = motionFunction(scene, name, kept(function), scale, until, body);
  const double seconds = duration.value_or(scene.document().duration);
  MotionFunctionCheck check;
  std::stop_source stop;
  runInterruptible(stop, [&] {
    SceneContent::Contacts contacts(*scene.content);
    check = checkMotionFunction(scene.scene(), *contacts, seconds, made, controls, stop.get_token());
  });
  return check;
}

std::string reprOfCheck(const MotionFunctionCheck& check) {
  std::string text = std::string("<MotionFunctionCheck ") + (check.passed ? "passed, " : "not passed, ") +
                     std::to_string(check.compared) + " derivatives compared";
  for (const std::string& finding : check.findings) text += "\n  " + finding;
  return text + ">";
}

constexpr const char* kCheckText =
    "Checks a function of the motion while you write it: compares the derivatives that it gives (Reading.seeds, and seed_rates "
    "if it has second_order) with central differences over changes of the controls; calls it twice on one motion; and compares "
    "its value on the whole motion with that on one that ends at `until`. Derivatives must agree to 1e-6 of their size. Where "
    "the impact sequence changes nearby, or differences are too inaccurate, nothing is compared, and the check does not pass: "
    "choose another scene. Raises InputError for invalid input, and what the function raises. Arguments as in Edit.require.";
constexpr const char* kRequireText =
    "Constrains a function of the motion to a value or a range, SI. function(motion) gives a Reading: its value and its "
    "derivative as seeds. It is called many times, from several threads, with motions of similar scenes, and must be "
    "deterministic; what it raises comes out of `solve`. scale: natural scale of the quantity. until: the latest time that it "
    "depends on, a time, s, or an impact or rest of `body`, without which it is not called (default: the end).";
constexpr const char* kMinimiseText =
    "Minimises function/scale + change_weight 1/2 sum (w z)^2 in place of the change alone; to maximise, negate the function. "
    "The function is as in `require`.";

void bindCheck(nb::module_& module) {
  const auto none = nb::none();
  nb::class_<MotionFunctionCheck>(module, "MotionFunctionCheck", "Outcome of check_motion_function.")
      .def_ro("passed", &MotionFunctionCheck::passed, "Everything could be compared, and agrees.")
      .def_ro("findings", &MotionFunctionCheck::findings,
              "What disagrees, and what could not be compared and why, a sentence each; empty if passed.")
      .def_ro("compared", &MotionFunctionCheck::compared, "Number of first and second derivatives that were compared.")
      .def_ro("not_compared", &MotionFunctionCheck::not_compared, "Number of those of which nothing is known.")
      .def_ro("gradient_error", &MotionFunctionCheck::gradient_error,
              "Largest difference of first derivatives, relative to their size.")
      .def_ro("hessian_error", &MotionFunctionCheck::hessian_error,
              "Largest difference of second derivatives, relative to their size.")
      .def("__repr__", &reprOfCheck);
  module.def("check_motion_function", &checked, nb::arg("scene"), nb::arg("function"), nb::arg("controls"), nb::kw_only(),
             nb::arg("name") = "function", nb::arg("duration") = none, nb::arg("scale") = 1.0, nb::arg("until") = none,
             nb::arg("body") = "",
             nb::sig("def check_motion_function(scene: Scene, function: collections.abc.Callable[[Motion], Reading], controls: "
                     "collections.abc.Sequence[Control], *, name: str = 'function', duration: float | None = None, scale: "
                     "float = 1.0, until: float | When | None = None, body: str = '') -> MotionFunctionCheck"),
             kCheckText);
}

}  // namespace

void bindMotionFunctions(nb::module_& module, nb::class_<PyEdit>& edit) {
  const auto none = nb::none();
  const auto self = nb::rv_policy::none;
  nb::class_<PyReading>(module, "Reading",
                        "A quantity read from a motion, with its derivative as a sum of seeds. doubt: why the derivative is "
                        "unreliable here, or missing. missing: why the quantity cannot be read from this motion. second_order: "
                        "second derivatives are given, by seed_rates as in `second_order`, or as those of constant weights.")
      .def("__init__",
           [](PyReading* made, double value, std::vector<PySeed> seeds, nb::object seed_rates, bool second_order,
              std::string doubt, std::string missing) {
             new (made) PyReading{value,        std::move(seeds), std::move(seed_rates), second_order,
                                  std::move(doubt), std::move(missing)};
           },
           nb::arg("value"), nb::arg("seeds"), nb::kw_only(), nb::arg("seed_rates") = none, nb::arg("second_order") = false,
           nb::arg("doubt") = "", nb::arg("missing") = "",
           nb::sig("def __init__(self, value: float, seeds: collections.abc.Sequence[Seed], *, seed_rates: "
                   "collections.abc.Callable[[list[BodyStateRate]], collections.abc.Sequence[Seed]] | None = None, "
                   "second_order: bool = False, doubt: str = '', missing: str = '') -> None"))
      .def_ro("value", &PyReading::value, "SI")
      .def_ro("seeds", &PyReading::seeds, "Its derivative, as a sum.")
      .def_ro("second_order", &PyReading::second_order, "Second derivatives are given.")
      .def_ro("doubt", &PyReading::doubt, "Why the derivative is unreliable; else empty.")
      .def_ro("missing", &PyReading::missing, "Why the quantity cannot be read; else empty.")
      .def("__repr__", [](const PyReading& of) { return "<Reading " + numberText(of.value) + ">"; });
  bindCheck(module);
  edit.def("require", &required, nb::arg("name"), nb::arg("function"), nb::arg("wanted").none(), nb::kw_only(),
           nb::arg("scale") = 1.0, nb::arg("until") = none, nb::arg("body") = "", self,
           nb::sig("def require(self, name: str, function: collections.abc.Callable[[Motion], Reading], wanted: float | "
                   "Wanted | tuple[float | None, float | None] | None, *, scale: float = 1.0, until: float | When | None = "
                   "None, body: str = '') -> Edit"),
           kRequireText)
      .def("minimise", &minimised, nb::arg("name"), nb::arg("function"), nb::kw_only(), nb::arg("change_weight") = 0.0,
           nb::arg("scale") = 1.0, nb::arg("until") = none, nb::arg("body") = "", self,
           nb::sig("def minimise(self, name: str, function: collections.abc.Callable[[Motion], Reading], *, change_weight: "
                   "float = 0.0, scale: float = 1.0, until: float | When | None = None, body: str = '') -> Edit"),
           kMinimiseText);
}

}  // namespace carom::python
