// SPDX-License-Identifier: MIT
#include "editing/session.h"

#include <filesystem>

#include "adjoint/base/errors.h"
#include "formats/documents/journal_json.h"
#include "python/src/session.hpp"

namespace carom::python {
namespace {

MeasureFrom measureFrom(const std::string& word) {
  if (word == "grab") return MeasureFrom::grab;
  if (word == "start") return MeasureFrom::start;
  throw InputError("measure_from", "found '" + word + "', expected 'grab' or 'start'");
}

void makeSession(PySession* self, const PyScene& scene, std::optional<double> duration, const std::string& measure_from,
                 bool stay, double tolerance, int drag_simulations, double drag_seconds, double release_seconds) {
  SessionOptions options;
  options.measure_from = measureFrom(measure_from);
  if (stay) options.sequence = SequencePolicy::stay;
  options.tolerance = tolerance;
  options.drag_simulations = drag_simulations;
  options.drag_seconds = drag_seconds;
  options.release_seconds = release_seconds;
  options.unmet_nails_off = true;  // opened as it is: nothing moves by itself
  const Document& document = scene.document();
  const double seconds = duration.value_or(document.duration);
  PySession session;
  {
    const Computing free;
    session.content = std::make_shared<PySessionContent>(scene, seconds, document.controls, document.constraints, options);
  }
  new (self) PySession(std::move(session));
}

void varySession(const PySession& self, const nb::args& controls) {
  const std::vector<Control> more = controlsIn(controls);
  readFrom(self, [&](EditSession& session) {
    std::vector<Control> all = session.controls();
    all.insert(all.end(), more.begin(), more.end());
    session.setControls(std::move(all));
  });
}

PyScene sceneOf(const PySession& self) {
  return readFrom(self, [&](EditSession& session) {
    const Document& first = self.content->scene.document();
    Document document = documentOf(session, first.folder);
    document.name = first.name, document.notes = first.notes;
    return PyScene{std::make_shared<SceneContent>(std::move(document))};
  });
}

void writeJournalTo(const PySession& self, const std::filesystem::path& path) {
  readFrom(self, [&](EditSession& session) {
    JournalDocument document;
    document.journal = session.journal();
    document.folder = self.content->scene.document().folder;
    document.name = self.content->scene.document().name;
    saveJournal(path.string(), document);
  });
}

/// An attribute that is read from the session.
template <class Read>
void bindRead(nb::class_<PySession>& session, const char* name, Read read, const char* text) {
  session.def_prop_ro(name, [read](const PySession& self) { return readFrom(self, read); }, nb::rv_policy::copy, text);
}

void bindSessionState(nb::class_<PySession>& session) {
  session.def_prop_ro("scene", &sceneOf, nb::rv_policy::move, "The current scene, with controls and nails.")
      .def_prop_ro("last",
                   [](const PySession& self) {
                     return readFrom(self, [&](EditSession& of) { return PyUpdate{self.content->scene, of.last()}; });
                   },
                   nb::rv_policy::move, "Outcome of the last call.")
      .def_prop_ro("motion",
                   [](const PySession& self) {
                     return readFrom(self, [&](EditSession& of) {
                       return motionOf(sceneWith(self.content->scene, of.scene()), of.last().motion);
                     });
                   },
                   nb::rv_policy::move, "Of the current scene.");
  bindRead(session, "duration", [](EditSession& of) { return of.duration(); }, "s, of the motion");
  bindRead(session, "controls", [](EditSession& of) { return of.controls(); }, "Parameters that may vary.");
  bindRead(session, "numbers", [](EditSession& of) { return of.numbers(); }, "All control parameters with their values.");
  bindRead(session, "can_undo", [](EditSession& of) { return of.canUndo(); }, "There is a step to undo.");
  bindRead(session, "can_redo", [](EditSession& of) { return of.canRedo(); }, "There is a step to redo.");
  bindRead(session, "undo_name", [](EditSession& of) { return of.undoName(); },
           "Of the step to undo: \"drag of 'hat' at 0.6 s\"; empty: none.");
  bindRead(session, "redo_name", [](EditSession& of) { return of.redoName(); }, "Of the step to redo.");
  bindRead(session, "undo_depth", [](EditSession& of) { return of.undoDepth(); }, "Number of steps, outside of a gesture.");
}

void bindSessionNumbers(nb::module_& module) {
  nb::class_<SessionNumber>(module, "SessionNumber", "A control parameter with its value in the scene.")
      .def_ro("name", &SessionNumber::name, "\"velocity.x of 'hat'\"")
      .def_ro("value", &SessionNumber::value, "SI")
      .def_ro("control", &SessionNumber::control, "Index of its Control.")
      .def_ro("component", &SessionNumber::component, "'x', 'radius', 'value'; of an orientation 'w', 'x', 'y' or 'z'.")
      .def_ro("varies", &SessionNumber::varies, "False: listed to complete its vector.")
      .def_ro("min", &SessionNumber::min, "Lower bound, SI.")
      .def_ro("max", &SessionNumber::max, "Upper bound, SI.")
      .def_ro("scale", &SessionNumber::scale, "Natural scale of a change, SI.")
      .def("__repr__",
           [](const SessionNumber& self) { return "<SessionNumber " + self.name + " = " + numberText(self.value) + ">"; });
}

constexpr const char* kSessionText =
    "Direct manipulation of a motion: a body is grabbed at some moment of its motion and dragged, and the controls follow. It "
    "begins with the controls and constraints of the scene; nails that are not met yet start switched off.\n\n"
    "    session = EditSession(scene)\n"
    "    session.vary(velocity('ball'))\n"
    "    session.grab('ball', 0.8)\n"
    "    update = session.drag_to((1.2, 0, 0.9))\n"
    "    session.release()\n\n"
    "measure_from: 'grab' keeps earlier gestures, 'start' measures changes from the start of the session. stay: no gesture "
    "changes the impact sequence. drag_simulations: work limit of one update. drag_seconds, release_seconds: time limits. One "
    "call at a time: another one meanwhile raises RuntimeError.";

}  // namespace

void bindSessions(nb::module_& module) {
  bindSessionUpdates(module);
  bindSessionNumbers(module);
  const SessionOptions defaults;
  nb::class_<PySession> session(module, "EditSession", kSessionText);
  session
      .def("__init__", &makeSession, nb::arg("scene"), nb::arg("duration") = nb::none(), nb::kw_only(),
           nb::arg("measure_from") = "grab", nb::arg("stay") = false, nb::arg("tolerance") = defaults.tolerance,
           nb::arg("drag_simulations") = defaults.drag_simulations,
           nb::arg("drag_seconds") = double(defaults.drag_seconds),
           nb::arg("release_seconds") = double(defaults.release_seconds))
      .def("vary", &varySession, nb::arg("controls"), nb::sig("def vary(self, *controls: Control) -> None"),
           "Adds controls. One undo step.")
      .def(
          "set_controls",
          [](const PySession& self, const std::vector<Control>& controls) {
            readFrom(self, [&](EditSession& of) { of.setControls(controls); });
          },
          nb::arg("controls"), "Replaces all controls. One undo step.")
      .def("write_journal", &writeJournalTo, nb::arg("path"),
           nb::sig("def write_journal(self, path: str | os.PathLike[str]) -> None"),
           "Writes all completed gestures; `carom replay` plays them again, to the same bits.")
      .def("__repr__", [](const PySession& self) {
        if (self.content->one.isInUse()) return std::string("<EditSession, in use>");
        return readFrom(self, [](EditSession& of) {
          return "<EditSession with " + std::to_string(of.controls().size()) + " controls and " +
                 std::to_string(of.nails().size()) + " nails" + (of.isGrabbed() ? ", grabbed>" : ">");
        });
      });
  bindSessionState(session);
  bindGestures(session);
  bindSessionNails(module, session);
  bindSessionContent(session);
  bindReplay(module);
}

}  // namespace carom::python
