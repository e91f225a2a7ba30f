// SPDX-License-Identifier: MIT
// A document with surfaces made in memory -> the document and mesh files beside it.
#include "formats/documents/save_with_meshes.h"

#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "formats/base/in_file.hpp"
#include "formats/base/write_file.hpp"
#include "formats/documents/scene_json.h"
#include "formats/documents/surface_files.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"

namespace carom {

using namespace formats_detail;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewPoints = 32;  // of a hull, written in the document itself

/// Wavefront OBJ: vertices with all their digits, faces counted from 1.
std::string objText(const Surface& surface) {
  std::string text;
  for (const Vec3& v : surface.vertices)
    text += "v " + numberText(v.x()) + " " + numberText(v.y()) + " " + numberText(v.z()) + "\n";
  for (const Surface::Face& face : surface.faces) {
    text += "f";
    for (int i = 0; i < face.count; ++i)
      text += " " + std::to_string(surface.corners[static_cast<std::size_t>(face.first + i)] + 1);
    text += "\n";
  }
  return text;
}

/// Letters, digits, '-' and '_' of a name; what every file system takes.
std::string fileStem(const std::string& name) {
  std::string stem;
  for (const char c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
    stem += plain ? c : '_';
  }
  constexpr std::size_t kLongest = 60;
  return stem.empty() ? "mesh" : stem.substr(0, kLongest);
}

/// Letters of both cases are one where file systems do not tell them apart.
std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

class MeshFiles {
 public:
  /// For a document at `path` with files relative to `from`.
  MeshFiles(const std::string& path, const std::string& from)
      : from_(from), folder_(fs::path(path).parent_path()), sub_(fs::path(path).stem().string() + "-meshes") {}

  /// Names the files of a shape relative to the document's new folder.
  void name(Shape& shape, const std::string& body) {
    for (const shapes::SurfaceUse& use : shapes::surfacesOf(shape)) {
      if (use.file.empty() && use.convex && use.surface.vertices.size() <= kFewPoints) continue;
      use.file = use.file.empty() ? fileOf(use.surface, body) : rebased(use.file, from_, folder_.string());
    }
  }

  void write() const {
    if (files_.empty()) return;
    const fs::path into = folder_ / sub_;
    std::error_code error;
    fs::create_directory(into, error);  // not the folders above it: a path that leads nowhere is an error
    if (error) throw FormatError(into.string(), "", "cannot make the folder: " + error.message());
    for (const auto& [surface, file] : files_) writeFileDurably((folder_ / file).string(), objText(*surface));
  }

  std::vector<std::string> names() const {
    std::set<std::string> sorted;
    for (const auto& [surface, file] : files_) sorted.insert(file);
    return {sorted.begin(), sorted.end()};
  }

 private:
  std::string fileOf(const Surface& surface, const std::string& body) {
    std::string& file = files_[&surface];
    if (!file.empty()) return file;
    const std::string stem = fileStem(body);
    std::string free = stem;
    for (int k = 2; !taken_.insert(lowerCase(free)).second; ++k) free = stem + "-" + std::to_string(k);
    return file = sub_ + "/" + free + ".obj";
  }

  std::string from_;
  fs::path folder_;
  std::string sub_;
  std::map<const Surface*, std::string> files_;
  std::set<std::string> taken_;
};

}  // namespace

std::vector<std::string> saveWithMeshes(const std::string& path, const Document& document) {
  Document named = document;
  named.folder = fs::path(path).parent_path().string();
  MeshFiles files(path, document.folder);
  for (Body& body : named.scene.bodies) files.name(body.shape, body.name);
  inFile(path, [&] { files.write(); });
  saveDocument(path, named);
  return files.names();
}

}  // namespace carom
