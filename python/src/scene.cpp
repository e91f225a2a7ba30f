// SPDX-License-Identifier: MIT
#include "python/src/scene.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "adjoint/base/errors.h"
#include "formats/documents/scene_json.h"
#include "formats/gltf/read/import_gltf.h"
#include "python/src/arrays.hpp"

namespace carom::python {

SceneContent::Contacts::Contacts(const SceneContent& scene) : scene_(scene) {
  {
    const std::lock_guard lock(scene.guard_);
    auto& idle = scene.idle_;
    auto found = std::ranges::find(idle, std::this_thread::get_id(), &Idle::last_used_by);
    if (found == idle.end() && !idle.empty()) found = idle.end() - 1;
    if (found != idle.end()) {
      source_ = std::move(found->source);
      idle.erase(found);
    }
  }
  if (!source_) source_ = std::make_unique<OdeContacts>(scene.document.scene);
}

SceneContent::Contacts::~Contacts() {
  const std::lock_guard lock(scene_.guard_);
  scene_.idle_.push_back({std::move(source_), std::this_thread::get_id()});
}

PyScene sceneWith(const PyScene& original, const Scene& values) {
  Document document = original.document();
  document.scene = values;
  return {std::make_shared<SceneContent>(std::move(document))};
}

int bodyOf(const Scene& scene, const BodyName& body) {
  if (const auto* name = std::get_if<std::string>(&body)) return bodyIndex(scene, *name);
  const int index = std::get<int>(body);
  const auto count = static_cast<int>(scene.bodies.size());
  if (index < 0 || index >= count)
    throw InputError("body " + std::to_string(index), "expected an index from 0 to " + std::to_string(count - 1));
  return index;
}

namespace {

using Path = std::filesystem::path;
using Names = std::vector<std::string>;

PyScene parsedScene(const nb::object& document, const std::string& name, const std::optional<Path>& folder) {
  const std::string text = nb::cast<std::string>(nb::module_::import_("carom.document").attr("to_text")(document));
  const std::string absolute = folder ? std::filesystem::absolute(*folder).string() : "";
  const Computing free;
  return {std::make_shared<SceneContent>(parseDocument(text, name, absolute), text)};
}

PyScene readScene(const Path& path) {
  const Computing free;
  Document document = readDocument(path.string());
  document.folder = std::filesystem::absolute(document.folder.empty() ? "." : document.folder).string();  // wherever it is used
  std::ifstream in(path, std::ios::binary);
  return {std::make_shared<SceneContent>(std::move(document), std::string(std::istreambuf_iterator<char>(in), {}))};
}

void writeScene(const PyScene& self, const Path& path) {
  const Computing free;
  saveDocument(path.string(), self.document());
}

std::string textOf(const PyScene& self) {
  const Computing free;
  return self.content->text ? *self.content->text : writeDocument(self.document());
}

nb::object dictOf(const PyScene& self) { return nb::module_::import_("json").attr("loads")(textOf(self)); }

template <class Named>
nb::tuple namesOf(const std::vector<Named>& all) {
  nb::list names;
  for (const Named& one : all) names.append(one.name);
  return nb::tuple(names);
}

std::string reprOf(const PyScene& self) {
  const Document& document = self.document();
  std::string bodies;
  for (std::size_t i = 0; i < document.scene.bodies.size() && i < 6; ++i)
    bodies += (i > 0 ? ", '" : " '") + document.scene.bodies[i].name + "'";
  if (document.scene.bodies.size() > 6) bodies += " and " + std::to_string(document.scene.bodies.size() - 6) + " more";
  const std::string name = document.name.empty() ? "" : "'" + document.name + "', ";
  return "<Scene " + name + numberText(document.duration) + " s, bodies" + bodies + ">";
}

/// What it is pickled from: the text, and the folder of its mesh files.
std::pair<std::string, std::string> stateOf(const PyScene& self) { return {textOf(self), self.document().folder}; }

void restore(PyScene& self, const std::pair<std::string, std::string>& state) {
  const Computing free;
  new (&self) PyScene{std::make_shared<SceneContent>(parseDocument(state.first, "scene", state.second), state.first)};
}

nb::tuple importedScene(const Path& path) {
  Imported imported = [&] {
    const Computing free;
    return importGltf(path.string());
  }();
  return nb::make_tuple(PyScene{std::make_shared<SceneContent>(std::move(imported.document))}, imported.report);
}

void bindReading(nb::class_<PyScene>& scene) {
  scene
      .def("__init__",
           [](PyScene* self, const nb::object& document, const std::string& name, const std::optional<Path>& folder) {
             new (self) PyScene(parsedScene(document, name, folder));
           },
           nb::arg("document"), nb::kw_only(), nb::arg("name") = "scene", nb::arg("folder") = nb::none(),
           nb::sig("def __init__(self, document: collections.abc.Mapping[str, typing.Any] | str, *, name: str = 'scene', "
                   "folder: str | os.PathLike[str] | None = None) -> None"),
           "A scene from a dict or a JSON text, docs/scenes.md has every member. `name` stands for the file in errors; "
           "`folder` is what names of mesh files are relative to. Raises FormatError.")
      .def_static("read", &readScene, nb::arg("path"),
                  nb::sig("def read(path: str | os.PathLike[str]) -> Scene"), "The scene of a file. Raises FormatError.")
      .def("write", &writeScene, nb::arg("path"),
           nb::sig("def write(self, path: str | os.PathLike[str]) -> None"),
           "Writes the document, atomically; names of mesh files become relative to the folder of `path`. Raises "
           "FormatError.")
      .def("to_text", &textOf, "The document as JSON text; every number reads back exactly.")
      .def("to_dict", &dictOf, nb::sig("def to_dict(self) -> dict[str, typing.Any]"), "The document as a dict.");
}

}  // namespace

void bindScene(nb::module_& module) {
  nb::class_<PyScene> scene(module, "Scene",
                            "A scene with its duration, controls and constraints. Immutable; safe in several threads.");
  bindReading(scene);
  scene.def_prop_ro("name", [](const PyScene& self) { return self.document().name; }, "For readers; affects no result.")
      .def_prop_ro("duration", [](const PyScene& self) { return self.document().duration; }, "s")
      .def_prop_ro("gravity", [](const PyScene& self) { return view(self.scene().gravity); }, "m/s^2")
      .def_prop_ro("bodies", [](const PyScene& self) { return namesOf(self.scene().bodies); },
                   nb::sig("def bodies(self, /) -> tuple[str, ...]"), "Names, in the order of the scene.")
      .def_prop_ro("materials", [](const PyScene& self) { return namesOf(self.scene().materials); },
                   nb::sig("def materials(self, /) -> tuple[str, ...]"), "Names, in the order of the scene.")
      .def_prop_ro("repairs",
                   [](const PyScene& self) {
                     std::vector<std::pair<std::string, std::string>> all;
                     for (const FileRepair& repair : self.document().repairs) all.emplace_back(repair.file, repair.what);
                     return all;
                   },
                   "What was changed of mesh files as they were read: (file, what).")
      .def("__eq__", [](const PyScene& a, const PyScene& b) { return a.content == b.content; }, nb::is_operator(),
           nb::sig("def __eq__(self, other: object, /) -> bool"), "The same scene, not one with the same values.")
      .def("__hash__", [](const PyScene& self) { return std::hash<const void*>()(self.content.get()); })
      .def("__getstate__", &stateOf)
      .def("__setstate__", &restore)
      .def("__repr__", &reprOf);

  nb::class_<ImportReport>(module, "ImportReport", "What an import changed or ignored.")
      .def_ro("warnings", &ImportReport::warnings, "A sentence each, with the name of the node or material.")
      .def_ro("joints", &ImportReport::joints, "Names of the nodes that have one; joints are not simulated.")
      .def_ro("triggers", &ImportReport::triggers, "Names of the nodes that are one; triggers are not simulated.")
      .def("__repr__", [](const ImportReport& self) {
        return "<ImportReport: " + std::to_string(self.warnings.size()) + " warnings, " +
               std::to_string(self.joints.size()) + " joints, " + std::to_string(self.triggers.size()) + " triggers>";
      });
  module.def("import_gltf", &importedScene, nb::arg("path"),
             nb::sig("def import_gltf(path: str | os.PathLike[str]) -> tuple[Scene, ImportReport]"),
             "The scene of a .gltf or .glb file with physics, and what was changed or ignored. Raises FormatError.");
}

}  // namespace carom::python
