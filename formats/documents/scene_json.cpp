// SPDX-License-Identifier: MIT
#include "formats/documents/scene_json.h"

#include <filesystem>

#include "formats/base/in_file.hpp"
#include "formats/base/read_file.hpp"
#include "formats/base/write_file.hpp"
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/surface_files.hpp"
#include "formats/json/json.hpp"
#include "formats/shapes/rows.hpp"

namespace carom {

using namespace formats_detail;

std::string formats_detail::folderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string formats_detail::movedSchema(const std::string& schema, const std::string& from, const std::string& to) {
  const bool address = schema.find(':') != std::string::npos;  // https://..., file:///..., urn:...
  return schema.empty() || address ? schema : rebased(schema, from, to);
}

void formats_detail::moveFiles(Scene& scene, const std::string& from, const std::string& to) {
  for (Body& body : scene.bodies)
    for (const shapes::SurfaceUse& use : shapes::surfacesOf(body.shape))
      if (!use.file.empty()) use.file = rebased(use.file, from, to);
}

Document formats_detail::readDocument(const Json& json, const std::string& folder) {
  Document document;
  document.folder = folder;
  document.schema = textOr(json, "$schema");
  document.name = textOr(json, "name");
  document.notes = textOr(json, "notes");
  SurfaceFiles files(folder);
  document.scene = readScene(json, files);
  document.repairs = files.repairs();
  validate(document.scene);
  document.duration = json.value<double>("duration", document.duration);
  document.controls = readControls(json, document.scene);
  document.constraints = readConstraints(json, document.scene, document.duration);
  return document;
}

Document parseDocument(std::string_view text, const std::string& name, const std::string& folder) {
  return inFile(name, [&] {
    return formats_detail::readDocument(parseJson(text, DocumentKind::scene, kLargestDocument), folder);
  });
}

Document readDocument(const std::string& path) {
  return parseDocument(readFile(path, "a scene document", kLargestDocument), path, folderOf(path));
}

std::string writeDocumentIn(const std::string& folder, const Document& document) {
  Document moved = document;
  moved.schema = formats_detail::movedSchema(document.schema, document.folder, folder);
  moveFiles(moved.scene, document.folder, folder);
  moved.folder = folder;
  std::string text = writeDocument(moved);
  try {
    parseDocument(text, "", moved.folder);
  } catch (const FormatError& error) {
    throw InputError(error.where(), error.message());
  }
  return text;
}

void saveDocument(const std::string& path, const Document& document) {
  inFile(path, [&] { writeFileDurably(path, writeDocumentIn(formats_detail::folderOf(path), document)); });
}

}  // namespace carom
