// SPDX-License-Identifier: MIT
#include "python/src/motion.hpp"

#include <filesystem>

#include "adjoint/base/errors.h"
#include "formats/export/export_motion.h"
#include "python/src/arrays.hpp"

namespace carom::python {
namespace {

using OtherBody = std::optional<BodyName>;

std::string seconds(double time) { return numberText(time) + " s"; }

std::string reprOfMotion(const PyMotion& self) {
  const Motion& motion = self.motion();
  std::string text = "<Motion " + seconds(motion.end);
  if (motion.status != MotionStatus::complete) text += " of " + seconds(motion.duration);
  text += ", " + std::to_string(motion.impacts) + (motion.impacts == 1 ? " impact, " : " impacts, ") + nameOf(motion.status);
  return text + (motion.status != MotionStatus::complete ? ": " + motion.message : "") + ">";
}

void refusePickle(const PyMotion&) {
  throw nb::type_error("a motion is not pickled: pickle its scene and simulate that again, which gives the same bits");
}

std::optional<PyEvent> foundImpact(const PyMotion& self, const BodyName& body, int n, const OtherBody& with) {
  const Motion& motion = self.motion();
  if (n < 1) throw InputError("n", "found " + std::to_string(n) + ", expected 1 or more");
  const int other = with ? bodyOf(*motion.scene, *with) : -1;
  const int index = bodyOf(*motion.scene, body);
  const std::optional<int> found = [&] {
    const Computing free;
    return motion.findImpact(index, n, other);
  }();
  return found ? std::optional(PyEvent{self.content, *found}) : std::nullopt;
}

std::string signatureOf(const PyMotion& self, std::optional<std::size_t> count) {
  const Computing free;
  return self.motion().signature(count.value_or(static_cast<std::size_t>(-1)));
}

void exportTo(const PyMotion& self, const std::filesystem::path& path, const std::optional<PyMotion>& before,
              double frames_per_second, double rate, bool camera, std::optional<double> light,
              std::optional<double> ghosts, bool nails) {
  ExportOptions options;
  options.gltf.frames_per_second = frames_per_second;
  options.gltf.camera = camera;
  options.gltf.light = light;
  options.gltf.ghosts = ghosts;
  options.gltf.nails = nails;
  options.csv_rate = rate;
  if (before) options.before = &before->motion();
  const Computing free;
  exportMotion(path.string(), self.scene.document(), self.motion(), options);
}

nb::bytes textIn(const PyMotion& self, const std::string& format, const std::optional<PyMotion>& before) {
  ExportOptions options;
  if (before) options.before = &before->motion();
  const std::string text = [&] {
    const Computing free;
    return motionText(format, self.scene.document().name, self.scene.document(), self.motion(), options);
  }();
  return nb::bytes(text.data(), text.size());
}

/// What a notebook shows.
std::string pictureOf(const PyMotion& self) {
  const Computing free;
  return motionText("svg", self.scene.document().name, self.scene.document(), self.motion());
}

void bindOutcome(nb::class_<PyMotion>& motion) {
  motion.def_prop_ro("scene", [](const PyMotion& self) { return self.scene; }, "The simulated scene.")
      .def_prop_ro("status", [](const PyMotion& self) { return nameOf(self.motion().status); },
                   "Why it ends where it does: 'complete', 'impact_limit', 'cascade', 'unresolved_impact', "
                   "'unresolved_contact', 'not_computable', 'step_limit' or 'stopped'.")
      .def_prop_ro("message", [](const PyMotion& self) { return self.motion().message; },
                   "One sentence on the status.")
      .def_prop_ro("duration", [](const PyMotion& self) { return self.motion().duration; }, "s, as requested")
      .def_prop_ro("end", [](const PyMotion& self) { return self.motion().end; },
                   "s, known up to here; the duration if it is complete.")
      .def_prop_ro("impacts", [](const PyMotion& self) { return self.motion().impacts; },
                   "Number of reported impacts: those that are not too low.")
      .def_prop_ro("event_count", [](const PyMotion& self) { return self.motion().event_count; },
                   "Number of all events, recorded or not.")
      .def_prop_ro("steps", [](const PyMotion& self) { return self.motion().steps; }, "Work done, in counted steps.")
      .def_prop_ro("has_events", [](const PyMotion& self) { return self.motion().has_events; },
                   "False: paths alone, which cannot be differentiated.")
      .def_prop_ro("lowest_bounce", [](const PyMotion& self) { return self.motion().lowest_bounce; },
                   "m, in force; 0: no persistent contact.");
}

}  // namespace

void bindMotion(nb::module_& module) {
  nb::class_<PyMotion> motion(module, "Motion",
                              "A simulated motion: world-lines of bodies, joined by events. Immutable; safe in several "
                              "threads. The recorded trajectory doubles as the AD tape.");
  bindOutcome(motion);
  bindEvents(module, motion);
  bindPersistentContacts(module, motion);
  bindSamples(module, motion);
  motion
      .def("find_impact", &foundImpact, nb::arg("body"), nb::arg("n"), nb::arg("with_") = nb::none(),
           "The n-th reported impact of a body (1 = first), counting only those with the body `with_` if it is given; "
           "None if there are fewer.")
      .def("signature", &signatureOf, nb::arg("count") = nb::none(),
           "The impact sequence as text: bodies, features and modes of the first `count` events. Derivatives relate only "
           "motions with equal signatures.")
      .def("describe_events", [](const PyMotion& self) {
             const Computing free;
             return self.motion().describeEvents();
           },
           "The events as text, without impacts too low to be reported.")
      .def("export", &exportTo, nb::arg("path"), nb::kw_only(), nb::arg("before") = nb::none(),
           nb::arg("frames_per_second") = 24.0, nb::arg("rate") = 60.0, nb::arg("camera") = false,
           nb::arg("light") = nb::none(), nb::arg("ghosts") = nb::none(), nb::arg("nails") = false,
           nb::sig("def export(self, path: str | os.PathLike[str], *, before: Motion | None = None, frames_per_second: float "
                   "= 24.0, rate: float = 60.0, camera: bool = False, light: float | None = None, ghosts: float | None = "
                   "None, nails: bool = False) -> None"),
           "Writes the motion in the format that the extension names: .glb, .gltf, .py (for Blender), .csv (`rate` rows "
           "per second) or .svg (`before` is drawn dashed). Of the first three: light in lux, ghosts: seconds between "
           "translucent copies, nails: marks of the constraints. Raises InputError.")
      .def("text", &textIn, nb::arg("format"), nb::kw_only(), nb::arg("before") = nb::none(),
           "The bytes of a file of a format, 'glb', 'gltf', 'py', 'csv' or 'svg', as `export` writes it.")
      .def("_repr_svg_", &pictureOf, "What a notebook shows: a picture of the motion.")
      .def("__getstate__", &refusePickle, nb::sig("def __getstate__(self) -> typing.NoReturn"))
      .def("__repr__", &reprOfMotion);
}

}  // namespace carom::python
