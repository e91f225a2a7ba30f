// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studio/protocol.h"
#include "studio/workspace.h"

namespace carom::studio {

/// A file that a page sends in parts.
struct UploadedFile {
  std::string name, bytes;
};
/// Bytes of such a file, at most.
inline constexpr std::size_t kLargestUpload = 64u << 20;

/// Adds a part. Throws InputError for one that is not the next, FileFailure for too many bytes.
void addPart(UploadedFile& file, const Upload& part);

/// What came of an import: files of the folder, and what differs from the file that was read.
struct ImportedFile {
  std::string path;                   ///< of the scene, or of the mesh
  bool mesh = false;                  ///< a mesh: no scene was made
  std::vector<std::string> warnings;  ///< a sentence each
};

/// Reads an OBJ or glTF file of the folder, or one that was uploaded, and writes a new scene with its meshes beside it, or the mesh that
/// was uploaded. Throws InputError, which begins with the name of the file, and leaves nothing then.
ImportedFile importFile(const Workspace& workspace, const Import& what, const std::optional<UploadedFile>& uploaded);

/// Removes what an import wrote.
void removeImported(const Workspace& workspace, const ImportedFile& imported);

}  // namespace carom::studio
