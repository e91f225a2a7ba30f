// SPDX-License-Identifier: MIT
#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/constraint.h"
#include "editing/wanted.h"
#include "python/src/arrays.hpp"
#include "python/src/edit.hpp"

namespace carom::python {
namespace {

std::string reprOfWhen(const When& when) { return "<When " + whenText(when) + ">"; }

std::string reprOfWanted(const Wanted& wanted) {
  if (!std::isnan(wanted.value)) return "<Wanted " + numberText(wanted.value) + ">";
  if (std::isnan(wanted.min) && std::isnan(wanted.max)) return "<Wanted: free>";
  return "<Wanted" + (std::isnan(wanted.min) ? "" : " at least " + numberText(wanted.min)) +
         (std::isnan(wanted.max) ? "" : " at most " + numberText(wanted.max)) + ">";
}

double numberOf(double value, const char* where) {
  if (std::isnan(value)) throw InputError(where, "found nan, expected a number; None leaves a component free");
  return value;
}

Region::Keep keepOf(const std::string& word) {
  if (word == "ball") return Region::Keep::ball;
  if (word == "shape") return Region::Keep::shape;
  throw InputError("keep", "found '" + word + "', expected 'ball' or 'shape'");
}

void makeRegion(Region* self, std::optional<double> sphere, const std::optional<ArrayLike>& box,
                const std::optional<ArrayLike>& position, const std::optional<ArrayLike>& orientation,
                const Interval& during, std::optional<double> margin, const std::string& keep) {
  if (sphere.has_value() == box.has_value()) throw InputError("sphere", "expected exactly one of sphere and box");
  Region region;
  if (sphere) region.shape = Sphere{*sphere};
  else region.shape = Box{vectorOf(*box, "box")};
  if (position) region.position = vectorOf(*position, "position");
  if (orientation) region.orientation = quaternionOf(*orientation, "orientation");
  region.during = during;
  region.margin = margin;
  region.keep = keepOf(keep);
  new (self) Region(std::move(region));
}

void bindRegion(nb::module_& module) {
  const auto none = nb::none();
  nb::class_<Region>(module, "Region",
                     "A region that a body stays out of (Nail.avoid) or within (Nail.inside) during a time interval: at "
                     "every moment, not only at samples.\n\n"
                     "sphere: its radius, m; or box: its 3 edge lengths, m. position: of its centre, m, world. "
                     "orientation: its axes to world, w, x, y, z. during: first and last second (default: the whole "
                     "motion). keep: 'ball', a ball about the centre of mass of the body, whose radius is `margin` "
                     "(default: the bounding radius); or 'shape', its exact shape at a distance of `margin` (default: 0).")
      .def("__init__", &makeRegion, nb::kw_only(), nb::arg("sphere") = none, nb::arg("box") = none,
           nb::arg("position") = none, nb::arg("orientation") = none, nb::arg("during") = none,
           nb::arg("margin") = none, nb::arg("keep") = "ball")
      .def("__repr__", [](const Region& self) {
        return std::string("<Region: ") + (std::holds_alternative<Sphere>(self.shape) ? "sphere>" : "box>");
      });
}

}  // namespace

Wanted wantedOf(const WantedArgument& argument, const char* where) {
  if (!argument) return Wanted(any);
  if (const auto* value = std::get_if<double>(&*argument)) return Wanted(numberOf(*value, where));
  if (const auto* wanted = std::get_if<Wanted>(&*argument)) return *wanted;
  const auto& [min, max] = std::get<std::pair<std::optional<double>, std::optional<double>>>(*argument);
  const auto bound = [&](const std::optional<double>& value) -> TargetNumber {
    if (!value) return any;
    return numberOf(*value, where);
  };
  return Wanted(bound(min), bound(max));
}

std::string whenText(const When& when) {
  if (when.rest) return "at rest";
  if (when.span) return "between " + numberText(when.span->first) + " and " + numberText(when.span->second) + " s";
  if (when.isTime()) return numberText(when.time) + " s";
  return "impact " + std::to_string(when.impact) + (when.with.empty() ? "" : " with '" + when.with + "'");
}

When whenOf(const WhenArgument& argument) {
  if (const auto* time = std::get_if<double>(&argument)) return When(*time);
  return std::get<When>(argument);
}

void bindMoments(nb::module_& module) {
  nb::class_<When>(module, "When", "When a constraint holds; nth_impact, between and at_rest make them.")
      .def("__repr__", &reprOfWhen);
  nb::class_<Wanted>(module, "Wanted", "A range for one component of a nail; within, at_least and at_most make them.")
      .def("__repr__", &reprOfWanted);
  nb::class_<ImpactOf>(module, "ImpactOf",
                       "The n-th impact of a body (1 = first), counting only those with `with_` if it is not empty.")
      .def("__init__",
           [](ImpactOf* self, const std::string& body, int n, const std::string& with) {
             new (self) ImpactOf{body, n, with};
           },
           nb::arg("body"), nb::arg("n") = 1, nb::arg("with_") = "")
      .def("__repr__", [](const ImpactOf& self) {
        return "<ImpactOf '" + self.body + "', " + std::to_string(self.n) + (self.with.empty() ? ">" : ", with '" + self.with + "'>");
      });
  bindRegion(module);
  module.def("nth_impact", [](int n, const std::string& with) { return nthImpact(n, with); }, nb::arg("n"), nb::arg("with_") = "",
             "Just before the n-th impact of the body (1 = first), with the body `with_` or with any.");
  module.def("between", [](double from, double to) { return between(from, to); }, nb::arg("from_"), nb::arg("to"),
             "At some time in the interval, s, which the edit chooses.");
  module.def("at_rest", &atRest, "When the body has come to rest, and stays so to the end of the motion.");
  module.def("within", [](double min, double max) { return within(numberOf(min, "min"), numberOf(max, "max")); },
             nb::arg("min"), nb::arg("max"), "At least `min` and at most `max`, SI.");
  module.def("at_least", [](double min) { return atLeast(numberOf(min, "min")); }, nb::arg("min"), "At least this, SI.");
  module.def("at_most", [](double max) { return atMost(numberOf(max, "max")); }, nb::arg("max"), "At most this, SI.");
}

}  // namespace carom::python
