// SPDX-License-Identifier: MIT
#include "editing/motion_function.h"

#include <memory>
#include <utility>
#include <vector>

#include "python/src/edit.hpp"

namespace carom::python {
namespace {

/// carom.Reading: what a function of the motion gives.
struct PyReading {
  double value = 0;
  std::vector<PySeed> seeds;
  std::string doubt, missing;
};

using OptionalWhen = std::optional<WhenArgument>;

/// Kept by the solver's threads: whoever is the last to let go of it does so with the GIL.
std::shared_ptr<nb::object> shared(const nb::object& function) {
  return {new nb::object(function), [](nb::object* kept) {
            const nb::gil_scoped_acquire held;
            delete kept;
          }};
}

/// Calls the function of Python with a motion of its own, which it may keep.
RowReading readingOf(const PyScene& scene, const nb::object& function, const Motion& motion) {
  const nb::gil_scoped_acquire held;
  const InCallback in;
  const PyMotion shown = motionOf(sceneWith(scene, *motion.scene), Motion(motion));
  const nb::object answer = function(shown);
  PyReading reading;
  if (!nb::try_cast<PyReading>(answer, reading))
    throw nb::type_error("a function of the motion gives a carom.Reading(value, seeds)");
  RowReading row;
  row.value = reading.value;
  for (const PySeed& seed : reading.seeds) row.seeds.push_back(seedIn(*shown.content, seed));
  row.doubt = reading.doubt;
  row.missing = reading.missing;
  return row;
}

MotionFunction motionFunction(const PyEdit& edit, const std::string& name, const nb::object& function, double scale,
                              const OptionalWhen& until, const std::string& body) {
  if (PyCallable_Check(function.ptr()) == 0) throw nb::type_error("expected a function of the motion");
  MotionFunction made;
  made.name = name;
  const std::shared_ptr<nb::object> kept = shared(function);
  edit.content->functions.push_back(kept);
  made.read = [scene = edit.content->scene, kept](const Motion& motion) { return readingOf(scene, *kept, motion); };
  made.scale = scale;
  if (until) made.until = whenOf(*until);
  made.body = body;
  return made;
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

constexpr const char* kRequireText =
    "Constrains a function of the motion to a value or a range, SI. function(motion) gives a Reading: its value and its "
    "derivative as seeds. It is called many times, from several threads, with motions of similar scenes, and must be "
    "deterministic; what it raises comes out of `solve`. scale: natural scale of the quantity. until: the latest time that it "
    "depends on, a time, s, or an impact or rest of `body`, without which it is not called (default: the end).";
constexpr const char* kMinimiseText =
    "Minimises function/scale + change_weight 1/2 sum (w z)^2 in place of the change alone; to maximise, negate the function. "
    "The function is as in `require`.";

}  // namespace

void bindMotionFunctions(nb::module_& module, nb::class_<PyEdit>& edit) {
  const auto none = nb::none();
  const auto self = nb::rv_policy::none;
  nb::class_<PyReading>(module, "Reading",
                        "A quantity read from a motion, with its derivative as a sum of seeds. doubt: why the derivative is "
                        "unreliable here, or missing. missing: why the quantity cannot be read from this motion.")
      .def("__init__",
           [](PyReading* made, double value, std::vector<PySeed> seeds, std::string doubt, std::string missing) {
             new (made) PyReading{value, std::move(seeds), std::move(doubt), std::move(missing)};
           },
           nb::arg("value"), nb::arg("seeds"), nb::kw_only(), nb::arg("doubt") = "", nb::arg("missing") = "")
      .def("__repr__", [](const PyReading& of) { return "<Reading " + numberText(of.value) + ">"; });
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
