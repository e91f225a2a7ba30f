// SPDX-License-Identifier: MIT
#include "cli/streams.h"

#include <iostream>

#include "cli/loading.h"
#include "formats/base/read_file.hpp"
#include "formats/base/write_file.hpp"
#include "formats/documents/scene_json.h"
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/step_lines.hpp"
#include "formats/mesh/mesh_file.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

constexpr const char* kInput = "<stdin>";
constexpr const char* kOutput = "<stdout>";
constexpr const char* kHere = ".";  // the folder that file names are relative to

std::string readInput(std::size_t limit) { return readStream(std::cin, kInput, limit); }

}  // namespace

bool isStandard(const std::string& path) { return path == "-"; }

std::string nameOfInput(const std::string& path) { return isStandard(path) ? kInput : path; }

Document readSceneFrom(const std::string& path) {
  if (!isStandard(path)) return readDocument(path);
  return parseDocument(readInput(kLargestDocument), kInput, kHere);
}

JournalDocument readJournalFrom(const std::string& path) {
  const bool standard = isStandard(path);
  const std::string text = standard ? readInput(kLargestJournal) : readFile(path, "a journal", kLargestJournal);
  const std::string name = standard ? kInput : path, folder = standard ? kHere : folderOf(path);
  if (areStepLines(text)) return readStepLines(text, name, folder).journal;
  return parseJournal(text, name, folder);
}

Imported importFrom(const std::string& path, const ImportOptions& options) {
  if (!isStandard(path)) return importGltf(path, options);
  return inFile(kInput, [&] { return parseGltfScene(readInput(kLargestMeshFile), kHere, options); });
}

void requireOutput(const std::string& path) {
  if (!isStandard(path)) inFile(path, [&] { requireWritable(path); });
}

void saveSceneTo(Output& out, const std::string& path, const Document& document) {
  if (isStandard(path))
    out.content(inFile(kOutput, [&] { return writeDocumentIn(kHere, document); }));
  else
    saveDocument(path, document);
}

void sayWritten(Output& out, const std::string& path, const std::string& details) {
  if (!isStandard(path)) out.text() << "Written: " << path << details << '\n';
}

}  // namespace carom::cli
