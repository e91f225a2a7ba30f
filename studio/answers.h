// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editing/session.h"
#include "studio/limits.h"
#include "studio/workspace.h"

/// Messages to a page as texts of JSON objects, version 1 of the protocol; frames.h has those that are binary.
namespace carom::studio {

class OpenScene;

/// The same message as the answer to a command: with its number, where it has one (above 0).
std::string answering(std::int64_t id, std::string message);

/// The first answer to hello.
std::string welcomeMessage(const std::string& session, const std::string& folder, std::size_t recovered,
                           const Limits& limits);

/// What the session is at. `scene` null: none is open. `recovered`: steps that came back with it.
std::string stateMessage(std::int64_t rev, const OpenScene* scene, const std::string& held_by, std::size_t recovered);

/// What is wrong with a command.
struct Problem {
  std::string code;     ///< word of the protocol: "input", "busy", ...
  std::string message;  ///< a sentence
  std::string pointer;  ///< place in the message or the document; empty: none
  std::string file;     ///< that it is about; empty: none
};
std::string errorMessage(const Problem& problem);
/// Of an exception that a command ended with.
Problem problemOf(const std::exception& error);

std::string savedMessage(const std::string& path, std::int64_t rev);
std::string filesMessage(const std::string& path, const std::vector<ListedFile>& files);
std::string progressMessage(const std::string& sentence);
/// Something that a person has to know, and that no command asked for.
std::string noticeMessage(const std::string& sentence);

/// A scene of the gallery.
struct GalleryScene {
  std::string path, name, notes;  ///< in the folder of the gallery; for people
  std::string picture;            ///< its address; empty: none
};
std::string galleryMessage(const std::vector<GalleryScene>& scenes);

/// What is told of a motion besides itself: members for motionFrame.
struct MotionNews {
  std::int64_t rev = 0;
  std::int64_t gesture = 0, seq = -1;  ///< that it came of; 0: none, below 0: none
  bool more = false;                   ///< it goes on towards the same target
  bool freed = false;                  ///< the throw of what is held may vary since it was taken hold of
  const SessionUpdate* update = nullptr;
  const Motion* before = nullptr;  ///< that its changes are counted from; null: unknown
};
std::string motionMembers(const MotionNews& news);

}  // namespace carom::studio
