// SPDX-License-Identifier: MIT
#include "formats/documents/surface_files.hpp"

#include <charconv>
#include <filesystem>
#include <system_error>

#include "formats/base/in_file.hpp"
#include "formats/mesh/mesh_file.h"
#include "ode_bridge/convex_hull.h"

namespace carom::formats_detail {
namespace {

namespace fs = std::filesystem;

/// " (line 7)" for the place "triangle 3" of a file that has lines.
std::string lineOf(const TriangleSoup& soup, const std::string& where) {
  constexpr std::string_view kTriangle = "triangle ";
  if (where.rfind(kTriangle, 0) != 0) return {};
  std::size_t index = soup.lines.size();
  std::from_chars(where.data() + kTriangle.size(), where.data() + where.size(), index);
  return index < soup.lines.size() ? " (line " + std::to_string(soup.lines[index]) + ")" : "";
}

std::shared_ptr<const Surface> readMesh(const std::string& path) {
  const TriangleSoup soup = readMeshFile(path);
  try {
    return meshSurface(soup.vertices, soup.triangles);
  } catch (const InputError& error) {
    throw FormatError(path, error.where() + lineOf(soup, error.where()), error.message());
  }
}

std::shared_ptr<const Surface> readHull(const std::string& path) {
  return inFile(path, [&] { return convexHull(readPointsFile(path)); });
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
  if (const auto found = known_.find({key, convex}); found != known_.end()) return found->second;
  try {
    return known_[{key, convex}] = convex ? readHull(shown) : readMesh(shown);
  } catch (const InputError& error) {
    known_.erase({key, convex});
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
