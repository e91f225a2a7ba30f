// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "formats/documents/step_lines.hpp"

namespace carom::studio {

/// The steps of a scene on the disk, in a file beside it: ".hat.json.steps". Each is on disk before it is reported,
/// or waits for the next one if writing fails. Failures are reported as sentences and end nothing. The file is
/// created with the first step, and belongs to one program at a time.
class Autosave {
 public:
  /// Of the scene that is saved in this folder under this name.
  Autosave(const std::string& folder, const std::string& name);
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// The steps that are there; none where there are none, or none that can be read.
  std::optional<formats_detail::StepLines> find();
  /// Goes on with those that were found.
  void goOn(const formats_detail::StepLines& found);
  /// Begins anew with this line, once there is a step.
  void begin(std::string first_line);
  /// Those that were found are kept under another name, which it gives.
  std::string setAside();

  void append(const std::string& line);
  /// The scene is now saved under this name in the same folder.
  void rename(const std::string& name);
  /// They are done with: saved, or not wanted any more.
  void forget();

  std::string folder() const;  ///< of the file
  /// What has gone wrong since the last call; empty: nothing.
  std::string takeProblem();

 private:
  bool open(bool create);
  void say(const std::string& what, int error);

  std::string path_, name_;
  int file_ = -1;
  std::size_t size_ = 0;   // of whole lines
  std::string waiting_;    // lines that are not on the disk yet
  std::string problem_;    // that was not told
  bool failing_ = false;   // and was told
};

}  // namespace carom::studio
