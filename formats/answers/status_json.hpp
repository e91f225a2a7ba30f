// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"
#include "formats/gltf/read/import_gltf.h"

namespace carom::formats_detail {

class JsonWriter;

/// The member repairs {file, what}: of mesh files that the document names.
void writeRepairs(JsonWriter& out, const Document& document);

/// The answer of every command that could not do its work: {"error": {"message", "file", "pointer"}}. `file` and
/// `pointer` (a JSON pointer into the file) are empty where the error has no such place.
std::string errorJson(const std::string& message, const std::string& file, const std::string& pointer);

/// The answer of `carom validate --json` for a document that is valid: valid, file, bodies, controls, constraints
/// (how many there are), repairs {file, what}, message.
std::string validateJson(const std::string& file, const Document& document, const std::string& message);

/// The answer of `carom export --json`: file, bytes, and the status, message and end of the motion that was written.
std::string exportJson(const std::string& file, std::size_t bytes, const Motion& motion);

/// The answer of `carom import --json`: file, bodies, materials, controls, constraints (how many there are), meshes
/// (the files beside the document), joints and triggers (names of nodes), and warnings.
std::string importJson(const std::string& file, const Imported& imported, const std::vector<std::string>& meshes);

/// What `carom info` says of the program itself.
struct ProgramInfo {
  /// A library that the program is built with.
  struct Library {
    std::string name;     ///< as it is called
    std::string version;  ///< as it says itself
  };
  std::string version;               ///< of carom
  std::string build;                 ///< "Release", "Debug", ...
  std::string compiler;              ///< name and version
  std::vector<Library> libraries;    ///< of the build
  int scene_format = 1;              ///< version of scene documents
  std::vector<std::string> exports;  ///< extensions
};
/// The answer of `carom info --json` without a scene.
std::string programJson(const ProgramInfo& info);

}  // namespace carom::formats_detail
