// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "editing/session_replay.h"
#include "formats/base/document.h"
#include "formats/base/format_error.h"

namespace carom {

/// A longer journal is refused before it is read.
inline constexpr std::size_t kLargestJournal = 64 * 1024 * 1024;  // bytes

/// A session as a document: version 1 of the format, formats/documents/journal.schema.json.
struct JournalDocument {
  SessionJournal journal;             ///< the gestures
  std::string folder;                 ///< to which file names in its scene are relative; empty: the current folder
  std::string name = {};              ///< of its scene
  std::string notes = {};             ///< of its scene
  std::string schema = {};            ///< member "$schema" of the journal
};

/// Reads a journal. Throws FormatError that names file, place, what was found and what was expected.
JournalDocument readJournal(const std::string& path);
/// The same for a text; see parseDocument.
JournalDocument parseJournal(std::string_view text, const std::string& name, const std::string& folder = "");

/// The journal as text; every number reads back exactly. Throws InputError for a scene that scene documents cannot
/// represent, and for a nail with two targets of one kind. An inertia matrix is rounded as in scene documents: read a
/// scene that has one from a document before its session begins.
std::string writeJournal(const JournalDocument& journal);

/// Writes the journal atomically. File names become relative to the folder of `path`.
void saveJournal(const std::string& path, const JournalDocument& journal);

/// The current scene, controls and nails of a session, as a document.
Document documentOf(const EditSession& session, const std::string& folder);

/// The answer of `carom replay --json`: file, same (whether every gesture gave the same bits), gestures {gesture,
/// body, reached, distance, nail_error, iterations, milliseconds, updates, slowest_milliseconds, message,
/// differences}, numbers {name, value} of the final scene, output (the file it was written to, or null).
std::string replayJson(const std::string& file, const SessionJournal& journal,
                       const std::vector<ReplayedGesture>& gestures, const EditSession& session,
                       const std::string& output);

}  // namespace carom
