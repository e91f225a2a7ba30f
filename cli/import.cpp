// SPDX-License-Identifier: MIT
// carom import: a scene document from a glTF file with physics.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "formats/answers/status_json.hpp"
#include "formats/documents/save_with_meshes.h"
#include "formats/gltf/read/import_gltf.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

struct ImportArguments {
  std::string input, output;
  std::optional<double> duration;
  std::string as;
  ImportOptions meshes;
};

/// What the scene is like as a whole, which no node says.
void addOverlap(Imported& imported) {
  try {
    const OdeContacts contacts(imported.document.scene);
    for (const StartOverlap& overlap : contacts.overlaps())
      imported.report.warnings.push_back(describeOverlapAtStart(imported.document.scene, overlap));
  } catch (const InputError& error) {
    imported.report.warnings.push_back(std::string("the scene cannot be simulated: ") + error.what());
  }
}

/// Writes the document; the files of meshes beside it.
std::vector<std::string> saveImported(Output& out, const std::string& path, const Document& document) {
  if (!isStandard(path)) return saveWithMeshes(path, document);
  try {
    saveSceneTo(out, path, document);
  } catch (const FormatError& error) {
    throw FormatError(error.file(), error.where(), error.message() + "; with the name of a file after -o it has them");
  }
  return {};
}

ImportOptions::As asOf(const std::string& word) {
  using As = ImportOptions::As;
  return word == "hull" ? As::hull : word == "mesh" ? As::mesh : word == "box" ? As::box : word == "sphere" ? As::sphere : As::nothing;
}

Exit importScene(const ImportArguments& options, Output& out) {
  if (options.as.empty() && (options.meshes.density || !options.meshes.fixed.empty()))
    throw UsageError(std::string(options.meshes.density ? "--density" : "--fixed") + " needs --as: it is for meshes without physics");
  ImportOptions meshes_as = options.meshes;
  meshes_as.as = asOf(options.as);
  std::error_code error;
  if (std::filesystem::equivalent(options.input, options.output, error))
    throw UsageError("-o " + options.output + ": found the file that is read, expected another one");
  if (isStandard(options.output)) out.reserveForContent();
  requireOutput(options.output);
  Imported imported = [&] {
    const Progress progress(out, "reading");
    return importFrom(options.input, meshes_as);
  }();
  if (options.duration) imported.document.duration = *options.duration;
  const std::vector<std::string> meshes = saveImported(out, options.output, imported.document);
  addOverlap(imported);
  for (const std::string& warning : imported.report.warnings) out.warn(warning);
  if (out.json()) {
    out.document(importJson(options.output, imported, meshes));
    return Exit::done;
  }
  const Scene& scene = imported.document.scene;
  std::string details =
      counted(scene.bodies.size(), "body", "bodies") + ", " + counted(scene.materials.size(), "material");
  if (!meshes.empty()) details += ", " + counted(meshes.size(), "mesh file");
  sayWritten(out, options.output, " (" + details + ")");
  return Exit::done;
}

Action declareImport(CLI::App& app) {
  const auto options = std::make_shared<ImportArguments>();
  app.add_option("file", options->input, "The file to read: .glb or .gltf; - for standard input")
      ->required()
      ->type_name("M.glb");
  addOutput(app, options->output, "The scene document to write; - for standard output", "S.json")->required();
  app.add_option("--duration", options->duration, "Seconds to simulate (default: as in the file, else 1)")
      ->check(positiveNumber())
      ->type_name("T");
  app.add_option("--as", options->as, "Take the meshes of a file without physics as bodies: hull, mesh, box or sphere")
      ->check(CLI::IsMember({"hull", "mesh", "box", "sphere"}))
      ->type_name("SHAPE");
  app.add_option("--density", options->meshes.density, "Of these bodies, kg/m^3 (default: 1000)")->check(positiveNumber())->type_name("D");
  app.add_option("--fixed", options->meshes.fixed, "Node that is a fixed body, with all below it; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  return [options](Output& out) { return importScene(*options, out); };
}

}  // namespace

const Command kImportCommand{
    "import", "Read a glTF file with rigid bodies as a scene document",
    "Reads KHR_physics_rigid_bodies with KHR_implicit_shapes, or OMI_physics_body with OMI_physics_shape,\n"
    "and OMI_physics_gravity, and converts y up to z up. A file without physics is read with --as: each\n"
    "node with a mesh becomes a body. Nodes with motion become moving bodies of all colliders below them, other colliders fixed\n"
    "bodies. Convex hulls and meshes are written beside the document, in S-meshes/. Unsupported content\n"
    "(joints, triggers and more) is listed on standard error and in the answer of --json. A file\n"
    "written by carom export is read without loss, with its edit.\n"
    "\n"
    "Examples:\n"
    "  carom import course.glb -o course.json\n"
    "  carom import course.gltf -o course.json --duration 3 --json\n"
    "  carom import room.glb -o room.json --as hull --fixed Floor --fixed Walls --density 600",
    declareImport};

}  // namespace carom::cli
