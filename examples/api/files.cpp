// SPDX-License-Identifier: MIT
// Documents in and out: a scene with an edit, its motion as glTF and back, and what is wrong with a file that is not one.
#include <cstdio>
#include <filesystem>

#include "adjoint/simulate/simulate.h"
#include "examples/support/project_file.h"
#include "formats/documents/save_with_meshes.h"
#include "formats/documents/scene_json.h"
#include "formats/export/export_motion.h"
#include "formats/gltf/read/import_gltf.h"
#include "formats/mesh/mesh_file.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;
namespace fs = std::filesystem;

int main() {
  const fs::path folder = fs::temp_directory_path() / "carom-example-files";
  fs::create_directories(folder);
  const Document document = readDocument(projectFile("examples/scenes/book-on-shelf.json"));
  OdeContacts contacts(document.scene);
  const Motion motion = simulate(document.scene, contacts, document.duration);

  ExportOptions options;
  GltfOptions& gltf = options.gltf;
  gltf.keys = GltfKeys::cubic;
  gltf.camera = true;
  exportMotion((folder / "motion.glb").string(), document, motion, options);

  const Imported imported = importGltf((folder / "motion.glb").string());
  const ImportReport& report = imported.report;
  std::printf("%zu bodies and %zu constraints came back, with %zu warnings\n", imported.document.scene.bodies.size(),
              imported.document.constraints.size(), report.warnings.size());
  for (const FileRepair& repair : imported.document.repairs)
    std::printf("%s: %s\n", repair.file.c_str(), repair.what.c_str());
  const ImportOptions drawn{.as = ImportOptions::As::hull, .density = 700, .fixed = {"floor"}};  // of files without physics
  try {
    importGltf((folder / "motion.glb").string(), drawn);
  } catch (const FormatError& error) {
    std::printf("%s\n", error.message().c_str());
  }
  const auto meshes = saveWithMeshes((folder / "again.json").string(), imported.document);
  std::printf("%zu mesh files beside the document\n", meshes.size());

  try {
    const TriangleSoup soup = readMeshFile((folder / "again.json").string());
    std::printf("%zu triangles\n", soup.triangles.size());
  } catch (const FormatError& error) {
    std::printf("%s\n", error.message().c_str());
  }
  fs::remove_all(folder);
}
