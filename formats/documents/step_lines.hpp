// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "editing/session.h"
#include "editing/session_history.h"
#include "formats/documents/journal_json.h"

/// A session as JSON Lines, to which one is appended after each gesture: the first has the journal without gestures,
/// each other one a gesture and what it left, so that the session comes back without being played. Internal to the
/// project.
namespace carom::formats_detail {

/// The member by which the first line is known.
inline constexpr const char* kStepsMember = "carom_steps";

/// The first line, with its end: of a session that has just begun, in its document. `opened`: text that this was read
/// from.
std::string firstStepLine(const EditSession& session, const Document& document, std::string_view opened);
/// The line of a scene that was saved as this text.
std::string savedLine(std::string_view text);
/// The line of where the session can be talked to.
std::string addressLine(std::string_view address);
/// The line of one gesture of the journal, with its end. `before`: what the line before left, as this sets it; what is
/// the same is not written again.
std::string stepLine(const EditSession& session, std::size_t gesture, const Document& now, std::string& before);

/// What lines tell.
struct StepLines {
  JournalDocument journal;  ///< with all gestures
  SessionHistory history;   ///< to go on from
  std::string opened;       ///< text that the scene was read from
  std::string saved;        ///< text that it was saved as last, else the same
  std::string address;      ///< where the session could be talked to; empty: nobody knows
  std::size_t bytes = 0;    ///< of whole lines: what comes after them was torn
};
bool areStepLines(std::string_view text);
/// Throws FormatError. A last line that was torn is left out.
StepLines readStepLines(std::string_view text, const std::string& name, const std::string& folder);

}  // namespace carom::formats_detail
