// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "adjoint/scene/surface.h"
#include "formats/base/document.h"

namespace carom::formats_detail {

/// The surfaces of the mesh files that one document names: each file is read once, and bodies share its surface.
class SurfaceFiles {
 public:
  /// File names are relative to `folder`; an empty one stands for a document that may name no files.
  explicit SurfaceFiles(std::string folder) : folder_(std::move(folder)) {}
  virtual ~SurfaceFiles() = default;

  /// The triangles of a file, repaired where they must be, or the convex hull of its vertices. Throws InputError at
  /// `where` that names the file and the place in it.
  virtual std::shared_ptr<const Surface> find(const std::string& file, const std::string& where, bool convex);

  /// Whether meshes are now those of a body whose mass is that of their volume, so that they must close.
  void readSolids(bool solid) { solid_ = solid; }

  /// Of all files, in the order in which they were read.
  const std::vector<FileRepair>& repairs() const { return repairs_; }

 private:
  std::string folder_;
  std::vector<FileRepair> repairs_;
  bool solid_ = false;
  // by the path in its shortest form, and whether it is a hull, and a solid
  using Known = std::tuple<std::string, bool, bool>;
  std::map<Known, std::shared_ptr<const Surface>> known_;
};

/// The name, relative to `to`, of the file that `file` names relative to `from` (empty: the current folder). A name
/// stays as it was where the folders are the same or it is absolute.
std::string rebased(const std::string& file, const std::string& from, const std::string& to);

}  // namespace carom::formats_detail
