// SPDX-License-Identifier: MIT
#include "studio/imports.h"

#include <algorithm>
#include <filesystem>

#include "formats/documents/save_with_meshes.h"
#include "formats/documents/scene_json.h"
#include "formats/gltf/read/import_gltf.h"
#include "formats/json/json.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::studio {
namespace {

namespace fs = std::filesystem;

bool endsWith(const std::string& name, const char* ending) {
  std::string end = name.substr(name.size() - std::min(name.size(), std::string(ending).size()));
  std::ranges::transform(end, end.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return end == ending;
}

std::string joined(const std::string& folder, const std::string& name) { return folder.empty() ? name : folder + "/" + name; }

/// The name of an uploaded file without its ending, as a name in the folder: not hidden, and no way to another one.
std::string plainStem(const std::string& name) {
  std::string stem = fs::path(name).stem().string();
  std::ranges::replace_if(stem, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f || c == '/' || c == '\\'; }, '_');
  constexpr std::size_t kLongest = 100;
  std::size_t end = std::min(stem.size(), kLongest);
  while (end > 0 && end < stem.size() && (static_cast<unsigned char>(stem[end]) & 0xc0) == 0x80) --end;  // not within a letter
  stem.resize(end);
  return stem.empty() || stem.front() == '.' ? "imported" + stem : stem;
}

/// A name that no file of these endings in the folder has: "mug", "mug-2", ...
std::string freeStem(const Workspace& workspace, const std::string& folder, const std::string& stem, const std::vector<std::string>& endings) {
  std::vector<ListedFile> files = workspace.list(folder), meshes = workspace.list(folder, true);
  files.insert(files.end(), meshes.begin(), meshes.end());
  for (int n = 1;; ++n) {
    const std::string free = n == 1 ? stem : stem + "-" + std::to_string(n);
    const auto takes = [&](const ListedFile& file) {
      return std::ranges::any_of(endings, [&](const std::string& ending) { return file.name == free + ending; });
    };
    if (std::ranges::none_of(files, takes)) return free;
  }
}

/// A document with a body of that mesh, which is read and checked by it.
Document documentOf(const std::string& mesh, const std::string& folder) {
  const formats_detail::Json json = {{"carom", 1}, {"bodies", {{{"name", "mesh"}, {"shape", {{"mesh", {{"file", mesh}}}}}, {"density", 600}}}}};
  return parseDocument(formats_detail::compactText(json), "", folder);
}

std::vector<std::string> repairsOf(const Document& document, const std::string& name) {
  std::vector<std::string> sentences;
  for (const FileRepair& repair : document.repairs) sentences.push_back(name + " was repaired: " + repair.what);
  return sentences;
}

ImportedFile importMesh(const Workspace& workspace, const Import& what, const std::optional<UploadedFile>& uploaded) {
  ImportedFile imported{what.path, true, {}};
  if (!uploaded) {
    const fs::path path = workspace.meshPath(what.path);
    imported.warnings = repairsOf(documentOf(path.filename().string(), path.parent_path().string()), path.filename().string());
    return imported;
  }
  imported.path = freeStem(workspace, "", plainStem(uploaded->name), {".obj"}) + ".obj";
  workspace.saveMesh(imported.path, uploaded->bytes);
  try {
    imported.warnings = repairsOf(documentOf(imported.path, workspace.folder()), imported.path);
  } catch (const std::exception&) {
    removeImported(workspace, imported);
    throw;
  }
  return imported;
}

ImportOptions optionsOf(const Import& what) {
  using As = ImportOptions::As;
  ImportOptions options;
  options.as = what.as == "hull" ? As::hull : what.as == "mesh" ? As::mesh : what.as == "box" ? As::box : what.as == "sphere" ? As::sphere : As::nothing;
  return options;
}

ImportedFile importScene(const Workspace& workspace, const Import& what, const std::optional<UploadedFile>& uploaded) {
  const std::string name = uploaded ? uploaded->name : what.path;
  Imported read = uploaded ? parseGltfScene(uploaded->bytes, workspace.folder(), optionsOf(what)) : importGltf(workspace.meshPath(what.path), optionsOf(what));
  const OdeContacts contacts(read.document.scene);
  ImportedFile imported{"", false, std::move(read.report.warnings)};
  for (const StartOverlap& overlap : contacts.overlaps()) imported.warnings.push_back(describeOverlapAtStart(read.document.scene, overlap));
  const std::string folder = uploaded ? "" : fs::path(what.path).parent_path().string();
  imported.path = joined(folder, freeStem(workspace, folder, uploaded ? plainStem(name) : fs::path(name).stem().string(), {".json", "-meshes"}) + ".json");
  try {
    saveWithMeshes(joined(workspace.folder(), imported.path), read.document);
  } catch (const std::exception&) {
    removeImported(workspace, imported);
    throw;
  }
  return imported;
}

}  // namespace

void addPart(UploadedFile& file, const Upload& part) {
  if (part.at == 0) file = {part.name, ""};
  if (part.name != file.name || part.at != file.bytes.size())
    throw InputError("/at", "found " + std::to_string(part.at) + " of '" + part.name + "', expected " + std::to_string(file.bytes.size()) + " of '" + file.name + "'");
  if (file.bytes.size() + part.bytes.size() > kLargestUpload)
    throw FileFailure("too_large", "'" + part.name + "': found more than " + std::to_string(kLargestUpload) + " bytes");
  file.bytes += part.bytes;
}

ImportedFile importFile(const Workspace& workspace, const Import& what, const std::optional<UploadedFile>& uploaded) {
  const std::string name = uploaded ? uploaded->name : what.path;
  try {
    if (endsWith(name, ".obj")) return importMesh(workspace, what, uploaded);
    if (endsWith(name, ".gltf") || endsWith(name, ".glb")) return importScene(workspace, what, uploaded);
  } catch (const FileFailure&) {
    throw;
  } catch (const InputError& error) {
    const std::string said = error.what(), file = fs::path(name).filename().string();
    throw InputError(said.find(file) != std::string::npos ? said : "'" + file + "': " + said);
  }
  throw InputError("'" + name + "': found another ending, expected .obj, .gltf or .glb");
}

void removeImported(const Workspace& workspace, const ImportedFile& imported) {
  std::error_code ignored;
  const fs::path path = joined(workspace.folder(), imported.path);
  fs::remove(path, ignored);
  if (!imported.mesh) fs::remove_all(path.parent_path() / (path.stem().string() + "-meshes"), ignored);
}

}  // namespace carom::studio
