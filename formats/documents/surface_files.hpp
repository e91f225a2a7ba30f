// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "adjoint/scene/surface.h"

namespace carom::formats_detail {

/// The surfaces of the mesh files that one document names: each file is read once, and bodies share its surface.
class SurfaceFiles {
 public:
  /// File names are relative to `folder`; an empty one stands for a document that may name no files.
  explicit SurfaceFiles(std::string folder) : folder_(std::move(folder)) {}
  virtual ~SurfaceFiles() = default;

  /// Throw InputError at `where` that names the file and the place in it.
  virtual std::shared_ptr<const Surface> mesh(const std::string& file, const std::string& where);
  virtual std::shared_ptr<const Surface> hull(const std::string& file, const std::string& where);

 private:
  using Surfaces = std::map<std::string, std::shared_ptr<const Surface>>;  // by the path in its shortest form
  using Read = std::shared_ptr<const Surface> (*)(const std::string& path);
  std::shared_ptr<const Surface> find(Surfaces& known, Read read, const std::string& file, const std::string& where);

  std::string folder_;
  Surfaces meshes_, hulls_;
};

/// The name, relative to `to`, of the file that `file` names relative to `from` (empty: the current folder). A name
/// stays as it was where the folders are the same or it is absolute.
std::string rebased(const std::string& file, const std::string& from, const std::string& to);

}  // namespace carom::formats_detail
