// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/output.h"
#include "formats/base/document.h"
#include "formats/documents/journal_json.h"
#include "formats/gltf/read/import_gltf.h"

/// Files by name, and "-" for standard input or output. File names in a document of either are relative to the current
/// folder; errors call them <stdin> and <stdout>.
namespace carom::cli {

bool isStandard(const std::string& path);

/// What to call an input in errors and answers.
std::string nameOfInput(const std::string& path);

Document readSceneFrom(const std::string& path);
JournalDocument readJournalFrom(const std::string& path);
Imported importFrom(const std::string& path, const ImportOptions& options = {});

/// Before the work: throws FormatError where the file cannot be written. Standard output can.
void requireOutput(const std::string& path);

/// Saves the document, or makes it the content of standard output.
void saveSceneTo(Output& out, const std::string& path, const Document& document);
/// For people, that a file was written. Of standard output there is nothing to say.
void sayWritten(Output& out, const std::string& path, const std::string& details = "");

}  // namespace carom::cli
