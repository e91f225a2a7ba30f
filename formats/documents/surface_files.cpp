// SPDX-License-Identifier: MIT
#include "formats/documents/surface_files.hpp"

#include <filesystem>
#include <system_error>

#include "formats/base/in_file.hpp"
#include "formats/mesh/mesh_file.h"
#include "formats/mesh/repair/mesh_repair.hpp"
#include "ode_bridge/convex_hull.h"

namespace carom::formats_detail {
namespace {

namespace fs = std::filesystem;

RepairedSurface readMesh(const std::string& path, bool solid) {
  return inFile(path, [&] {
    const TriangleSoup soup = readMeshFile(path);
    RepairedSurface found = surfaceOf(soup, solid);
    found.repairs.insert(found.repairs.begin(), soup.repairs.begin(), soup.repairs.end());
    return found;
  });
}

RepairedSurface readHull(const std::string& path) {
  return inFile(path, [&] { return RepairedSurface{convexHull(readPointsFile(path)), {}}; });
}

/// Without "..", "." and links as far as the path exists.
fs::path shortest(const fs::path& path) {
  std::error_code error;
  const fs::path found = fs::weakly_canonical(path, error);
  return error ? path.lexically_normal() : found;
}

fs::path folderOrHere(const std::string& folder) { return folder.empty() ? fs::path(".") : fs::path(folder); }

}  // namespace

std::shared_ptr<const Surface> SurfaceFiles::find(const std::string& file, const std::string& where, bool convex) {
  if (folder_.empty())
    throw InputError(where, "found a file in a document that has no folder, expected a document read from a file");
  for (const char c : file)  // a message that names the file stays on its line
    if (static_cast<unsigned char>(c) < ' ')
      throw InputError(where, std::string("found ") + (c == 0 ? "a zero byte" : "a control character") +
                                  ", expected the name of a file");
  const fs::path path = fs::path(folder_) / file;
  const std::string key = shortest(path).string();
  // "a/.." is not always nothing: `a` may be a link.
  const fs::path normal = path.lexically_normal();
  const std::string shown = (shortest(normal) == key ? normal : path).string();
  const Known known{key, convex, !convex && solid_};
  if (const auto found = known_.find(known); found != known_.end()) return found->second;
  try {
    const RepairedSurface read = convex ? readHull(shown) : readMesh(shown, solid_);
    for (const std::string& repair : read.repairs) repairs_.push_back({shown, repair});
    return known_[known] = read.surface;
  } catch (const InputError& error) {
    throw InputError(where, error.what());
  }
}

std::string rebased(const std::string& file, const std::string& from, const std::string& to) {
  const fs::path name(file);
  const fs::path before = shortest(folderOrHere(from)), after = shortest(folderOrHere(to));
  if (name.is_absolute() || before == after) return file;
  const fs::path target = before / name;
  const fs::path place = shortest(target.parent_path()) / target.filename();
  const fs::path relative = place.lexically_relative(after);
  return (relative.empty() ? place : relative).generic_string();
}

}  // namespace carom::formats_detail
