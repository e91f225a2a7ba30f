// SPDX-License-Identifier: MIT
#include "editing/session_replay.h"

#include <filesystem>

#include "formats/documents/journal_json.h"
#include "python/src/session.hpp"

namespace carom::python {
namespace {

/// carom.SessionReplay, with what it keeps by reference.
class ReplayContent {
 public:
  explicit ReplayContent(JournalDocument of)
      : document(std::move(of)),
        scene{std::make_shared<SceneContent>(initial(document))},
        contacts(*scene.content),
        replay(document.journal, *contacts) {}

  const JournalDocument document;
  const PyScene scene;  ///< initial
  SceneContent::Contacts contacts;
  SessionReplay replay;
  std::size_t next = 0;  ///< gesture
  OneAtATime one;

 private:
  static Document initial(const JournalDocument& of) {
    Document document;
    document.scene = of.journal.scene;
    document.duration = of.journal.duration;
    document.controls = of.journal.controls;
    document.constraints = of.journal.nails;
    document.folder = of.folder, document.name = of.name, document.notes = of.notes;
    return document;
  }
};

struct PyReplay {
  std::shared_ptr<ReplayContent> content;
};

/// carom.ReplayedGesture.
struct PyReplayed {
  std::string kind, body;
  PyUpdate update;
  int updates = 0;
  double slowest_milliseconds = 0;
  std::vector<std::string> differences;
};

PyReplay readReplay(const std::filesystem::path& path) {
  const Computing free;
  JournalDocument document = readJournal(path.string());
  document.folder = std::filesystem::absolute(document.folder.empty() ? "." : document.folder).string();
  return {std::make_shared<ReplayContent>(std::move(document))};
}

/// Reads or plays, alone and without the GIL.
template <class Use>
auto withReplay(const PyReplay& self, Use use) {
  const OneAtATime::Use alone(self.content->one, "the replay");
  const Computing free;
  return use(*self.content);
}

PyReplayed playNext(const PyReplay& self) {
  InCallback::refuse();
  if (withReplay(self, [](ReplayContent& of) { return of.replay.done(); })) throw nb::stop_iteration();
  return withReplay(self, [](ReplayContent& of) {
    const SessionGesture& gesture = of.document.journal.gestures[of.next];
    ReplayedGesture played = of.replay.next();
    ++of.next;
    return PyReplayed{nameOf(gesture.kind), gesture.body, PyUpdate{of.scene, std::move(played.update)}, played.updates,
                      played.slowest_milliseconds, std::move(played.differences)};
  });
}

PyScene sceneOfReplay(const PyReplay& self) {
  return withReplay(self, [](ReplayContent& of) {
    Document document = documentOf(of.replay.session(), of.document.folder);
    document.name = of.document.name, document.notes = of.document.notes;
    return PyScene{std::make_shared<SceneContent>(std::move(document))};
  });
}

PyMotion motionOfReplay(const PyReplay& self) {
  return withReplay(self, [](ReplayContent& of) {
    const EditSession& session = of.replay.session();
    return motionOf(sceneWith(of.scene, session.scene()), session.last().motion);
  });
}

std::string reprOfReplayed(const PyReplayed& self) {
  const std::string same = self.differences.empty() ? "the same bits" : self.differences.front();
  return "<ReplayedGesture " + self.kind + (self.body.empty() ? "" : " of '" + self.body + "'") + ": " + same + ">";
}

}  // namespace

void bindReplay(nb::module_& module) {
  nb::class_<PyReplayed>(module, "ReplayedGesture", "Outcome of one replayed gesture.")
      .def_ro("kind", &PyReplayed::kind, "'drag', 'nail', 'undo', ...")
      .def_ro("body", &PyReplayed::body, "Of a drag; else empty.")
      .def_ro("update", &PyReplayed::update, "At its end.")
      .def_ro("updates", &PyReplayed::updates, "Number of calls of drag_to, slide_to and dwell.")
      .def_ro("slowest_milliseconds", &PyReplayed::slowest_milliseconds, "Wall time, of them.")
      .def_ro("differences", &PyReplayed::differences, "From the outcome in the journal; empty: the same bits.")
      .def("__repr__", &reprOfReplayed);
  nb::class_<PyReplay>(module, "SessionReplay",
                       "Replays the journal of a session (EditSession.write_journal), gesture by gesture: an iterator of "
                       "ReplayedGesture. Without time limits: updates ended by a time-out or a stop end at the same point, "
                       "and the same journal gives the same bits.")
      .def_static("read", &readReplay, nb::arg("path"),
                  nb::sig("def read(path: str | os.PathLike[str]) -> SessionReplay"),
                  "The replay of a file, before its first gesture. Raises FormatError, and InputError for an invalid journal.")
      .def("__iter__", [](const nb::object& self) { return self; },
           nb::sig("def __iter__(self) -> collections.abc.Iterator[ReplayedGesture]"))
      .def("__next__", &playNext, nb::sig("def __next__(self) -> ReplayedGesture"))
      .def_prop_ro("done", [](const PyReplay& self) { return withReplay(self, [](ReplayContent& of) { return of.replay.done(); }); },
                   "All gestures were replayed.")
      .def_prop_ro("scene", &sceneOfReplay, nb::rv_policy::move, "After the gestures so far, with controls and nails.")
      .def_prop_ro("motion", &motionOfReplay, nb::rv_policy::move, "Of that scene.")
      .def("__repr__", [](const PyReplay& self) {
        return "<SessionReplay of " + std::to_string(self.content->document.journal.gestures.size()) + " gestures>";
      });
}

}  // namespace carom::python
