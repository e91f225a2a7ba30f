// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adjoint/base/errors.h"

namespace carom::studio {

/// Two ways to tell that a file is another than it was.
struct FileStamp {
  std::int64_t seconds = 0, nanoseconds = 0;  ///< when it was changed last, since 1970
  std::uint64_t bytes = 0;                    ///< its size
  std::uint64_t hash = 0;                     ///< of its content
  /// The same content, whenever it was written.
  bool sameContent(const FileStamp& other) const { return bytes == other.bytes && hash == other.hash; }
};

/// A file as it was read.
struct OpenedFile {
  std::string text;    ///< the whole of it
  FileStamp stamp;     ///< when it was read
  std::string folder;  ///< that names in it are relative to, as a path of this machine
};

/// One entry of a folder.
struct ListedFile {
  std::string path;           ///< relative to the folder of the workspace
  std::string name;           ///< the last part of it
  bool folder = false;        ///< else a scene or a mesh
  std::uint64_t bytes = 0;    ///< of a file
  std::int64_t modified = 0;  ///< s since 1970
  bool mesh = false;          ///< an OBJ or glTF file
};

/// A file that is not as it is thought to be: somebody else wrote it, or it is there where a new one was to be.
class FileConflict : public InputError {
 public:
  using InputError::InputError;
};

/// A file that cannot be read or written, though its name is a good one.
class FileFailure : public InputError {
 public:
  FileFailure(const char* the_code, const std::string& message) : InputError(message), code(the_code) {}
  const char* const code;  ///< word of the protocol: "io", "too_large"
};

/// The files below one folder, by relative names. A name may not leave the folder: no "..", no NUL, no links, whatever
/// they point to. Each part of a name is opened from the handle of the folder before it, so that nothing can be
/// exchanged in between. Functions throw InputError that begins with the name.
class Workspace {
 public:
  /// Throws InputError for what is no folder.
  explicit Workspace(const std::string& folder);
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  const std::string& folder() const { return folder_; }  ///< absolute

  /// Folders and scene documents of a folder, by name; "" is the folder itself. Names that begin with a dot and links
  /// are left out. `meshes`: mesh files in place of scenes.
  std::vector<ListedFile> list(const std::string& path, bool meshes = false) const;
  /// Reads a scene document (.json).
  OpenedFile open(const std::string& path) const;
  /// A mesh file (.obj, .gltf, .glb) as a path of this machine.
  std::string meshPath(const std::string& path) const;
  /// Writes a new mesh file (.obj) whole or not at all. Throws FileConflict where there is one.
  void saveMesh(const std::string& path, std::string_view bytes) const;
  /// The folder of a file, as a path of this machine.
  std::string folderOf(const std::string& path) const;

  /// Writes a scene document (.json) whole or not at all, durably, and gives what it is then. Throws FileConflict where
  /// the file is not the one of `known`: with other content, or there at all where that is none; unless `replace`.
  FileStamp save(const std::string& path, std::string_view text, const std::optional<FileStamp>& known,
                 bool replace) const;

 private:
  FileStamp write(const std::string& path, std::string_view text, const std::optional<FileStamp>& known, bool replace) const;

  std::string folder_;
  int root_ = -1;
};

}  // namespace carom::studio
