// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editing/session.h"
#include "formats/base/document.h"
#include "formats/documents/step_lines.hpp"
#include "ode_bridge/ode_contacts.h"
#include "studio/workspace.h"

namespace carom::studio {

/// The scene that the studio shows: its document, where that came from, and the session that edits it.
class OpenScene {
 public:
  /// `path`: where it is saved, relative to the workspace; none: nowhere yet. Simulates the scene. Throws FormatError.
  OpenScene(OpenedFile file, const std::string& name, std::optional<std::string> path, SessionOptions options = {});

  /// Goes on with the steps that were made on it before. `file` has what was opened then, or saved last.
  OpenScene(OpenedFile file, const formats_detail::StepLines& steps, const std::string& name,
            std::optional<std::string> path);

  EditSession& session() { return *session_; }
  const EditSession& session() const { return *session_; }
  const Document& opened() const { return opened_; }  ///< as it was read
  const std::optional<std::string>& path() const { return path_; }
  /// A name for it where it has no file: "hat-copy.json" of "hat.json"; of a scene that began empty its own.
  std::string suggestedName() const;

  /// As it is now; with what is grabbed left out.
  Document document() const;
  /// Something differs from what was opened or saved last.
  bool isChanged() const;
  bool isSaved() const { return path_ && !isChanged(); }  ///< its file has it as it is
  /// What is written into a folder: the bytes that were saved last, or read at first, where nothing differs from them.
  std::string textIn(const std::string& folder) const;
  /// Its file is now this one.
  void wasSaved(const std::string& path, OpenedFile file);
  /// For an Autosave: the first line, and that of a gesture of the journal; these are asked for in order.
  std::string firstStepLine() const { return formats_detail::firstStepLine(*session_, document(), first_.file.text); }
  std::string stepLine(std::size_t gesture);
  /// The file as it was read or written last; none where it has none.
  std::optional<FileStamp> stamp() const;

  /// The document after edits (pointer, JSON value each). Bodies whose text stays are taken over to the bit, and so are
  /// controls and nails. Throws InputError that names the place in the document.
  SessionContent edited(const std::vector<std::pair<std::string, std::string>>& edits) const;
  /// The motion of a content, which is not taken over.
  std::shared_ptr<const Motion> simulated(const SessionContent& content);

 private:
  /// A file and the document that it holds, as we write it: people may have written the same in another way.
  struct Written {
    OpenedFile file;
    std::string document;
  };

  Document opened_;
  Written first_, last_;  // as it was opened, and as it was opened or saved last
  std::string kept_;      // of its last step line
  std::string name_;  // of the file that it was read from
  std::optional<std::string> path_;
  std::unique_ptr<OdeContacts> contacts_;
  std::unique_ptr<EditSession> session_;
};

/// Of a scene that begins empty.
inline constexpr const char* kEmptyScene = R"({
  "carom": 1,
  "duration": 2,
  "materials": { "wood": { "elasticity": 0.5, "friction": 0.4 } },
  "bodies": [
    { "name": "floor", "fixed": true, "material": "wood", "shape": { "plane": { "normal": [0, 0, 1] } } }
  ]
}
)";

/// What undo calls such edits: "velocity of 'hat'".
std::string nameOfEdits(const std::vector<std::pair<std::string, std::string>>& edits, const Scene& scene);

/// Where a number of a control stands in the document: "/bodies/2/velocity/0"; none: it has no place of its own there.
std::optional<std::string> pointerOf(const Control& control, const std::string& component, const Scene& scene);

}  // namespace carom::studio
