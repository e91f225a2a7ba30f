// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editing/session.h"
#include "formats/base/document.h"
#include "studio/limits.h"
#include "studio/workspace.h"

/// Messages to a page as texts of JSON objects, version 1 of the protocol; frames.h has those that are binary.
namespace carom::studio {

class OpenScene;
struct Findings;

/// The same message as the answer to a command: with its number, where it has one (above 0).
std::string answering(std::int64_t id, std::string message);

/// The first answer to hello.
std::string welcomeMessage(const std::string& session, const std::string& folder, std::size_t recovered,
                           const Limits& limits);

/// The state of the session. `scene` null: none is open. `recovered`: number of restored steps.
std::string stateMessage(std::int64_t rev, const OpenScene* scene, const std::string& held_by, std::size_t recovered);

/// The same of a motion that nobody edits: each constraint is a nail that is on. `before`: where numbers come from.
std::string stateOfMotion(const Document& document, const Motion& motion, const Scene& before);

/// What is wrong with a command.
struct Problem {
  std::string code;     ///< word of the protocol: "input", "busy", ...
  std::string message;  ///< a sentence
  std::string pointer;  ///< place in the message or the document; empty: none
  std::string file;     ///< that it is about; empty: none
  std::string body = {};                ///< that has no room; empty: none
  std::optional<Vec3> place = {};       ///< m, where it has
};
std::string errorMessage(const Problem& problem);
/// Of an exception that a command ended with.
Problem problemOf(const std::exception& error);

/// What would help, as far as it is known.
std::string whyMessage(const Findings& found, std::int64_t rev);
/// How many other motions there are, after their frames; and members of the frame of one of them.
std::string alternativesMessage(const Findings& found, std::int64_t rev);
std::string alternativeMembers(const Findings& found, std::size_t index, std::int64_t rev);
/// How far the search for a face that is up has come.
std::string faceUpMessage(const Findings& found, std::int64_t rev);
/// How far a path has come along a drawn curve.
std::string sketchMessage(const Findings& found, std::int64_t rev);
/// That no answer comes to such a question any more.
std::string cancelledMessage(const std::string& type, std::int64_t rev);

/// That so many bytes of a file are here.
std::string uploadedMessage(std::size_t bytes);
/// What came of an import.
struct ImportedFile;
std::string importedMessage(const ImportedFile& imported);
std::string savedMessage(const std::string& path, std::int64_t rev);
/// `recent`: the scenes of the workspace that were opened last.
std::string filesMessage(const std::string& path, const std::vector<ListedFile>& files,
                         const std::vector<std::string>& recent);
/// That the token is known here: HMAC-SHA256 of a nonce, in hex.
std::string proofMessage(const std::string& proof);
std::string progressMessage(const std::string& sentence);
/// An unsolicited notice for the user.
std::string noticeMessage(const std::string& sentence);

/// A scene of the gallery.
struct GalleryScene {
  std::string path, name, notes;  ///< in the folder of the gallery; texts of the document
  std::string picture;            ///< its address; empty: none
};
std::string galleryMessage(const std::vector<GalleryScene>& scenes);

/// Members for motionFrame in addition to the motion.
struct MotionNews {
  std::int64_t rev = 0;
  std::int64_t gesture = 0, seq = -1;  ///< that it came of; 0: none, below 0: none
  bool more = false;                   ///< it goes on towards the same target
  bool freed = false;                  ///< the throw of the held body may vary since it was grabbed
  const SessionUpdate* update = nullptr;
  const Motion* before = nullptr;  ///< that its changes are counted from; null: unknown
};
std::string motionMembers(const MotionNews& news);

}  // namespace carom::studio
