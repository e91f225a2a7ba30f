// SPDX-License-Identifier: MIT
// carom export: the motion in the formats of other programs.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "formats/export_motion.h"
#include "formats/status_json.h"

namespace carom::cli {
namespace {

struct Options {
  std::string scene, output, before, keys;
  std::optional<double> frames_per_second, tolerance, light, ghosts;
  bool camera = false, nails = false, refuse_overlaps = false;
};

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Options that the chosen format does not have would be lost in silence.
void requireSense(const Options& options) {
  const std::string extension = extensionOf(options.output);
  const std::vector<std::string> known = exportExtensions();
  if (std::find(known.begin(), known.end(), extension) == known.end()) {
    std::string list;
    for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
    throw UsageError("-o " + options.output + ": found the extension '" + extension + "', expected one of " + list);
  }
  if (!options.before.empty() && extension != ".svg") throw UsageError("--before is only for .svg");
  if (options.frames_per_second && extension == ".svg")
    throw UsageError("--fps is only for .glb, .gltf, .py and .csv");
  if (options.keys == "cubic" && extension == ".py")
    throw UsageError("--keys cubic is only for .glb and .gltf: Blender drops the tangents of cubic keys");
  if (options.keys == "cubic" && options.tolerance) throw UsageError("--tolerance needs --keys linear");
  if (extension == ".glb" || extension == ".gltf" || extension == ".py") return;
  const std::pair<const char*, bool> given[] = {{"--keys", !options.keys.empty()},
                                                {"--tolerance", options.tolerance.has_value()},
                                                {"--camera", options.camera},
                                                {"--light", options.light.has_value()},
                                                {"--ghosts", options.ghosts.has_value()},
                                                {"--nails", options.nails}};
  for (const auto& [name, is_given] : given)
    if (is_given) throw UsageError(std::string(name) + " is only for .glb, .gltf and .py");
}

GltfOptions gltfOptionsOf(const Options& options) {
  GltfOptions out;
  if (options.keys == "cubic") out.keys = GltfKeys::cubic;
  out.frames_per_second = options.frames_per_second.value_or(out.frames_per_second);
  out.tolerance = options.tolerance.value_or(out.tolerance);
  out.camera = options.camera;
  out.light = options.light;
  out.ghosts = options.ghosts;
  out.nails = options.nails;
  return out;
}

Exit exportScene(const Options& options, Output& out) {
  requireSense(options);
  Loaded loaded(options.scene, options.refuse_overlaps);
  warnOfOverlaps(loaded);
  const Motion motion = loaded.simulate();
  ExportOptions export_options;
  export_options.gltf = gltfOptionsOf(options);
  export_options.csv_rate = options.frames_per_second.value_or(export_options.csv_rate);
  std::optional<Motion> before;
  if (!options.before.empty()) {
    Loaded earlier(options.before);
    before = earlier.simulate();
    export_options.before = &*before;
  }
  try {
    exportMotion(options.output, loaded.document, motion, export_options);
  } catch (const InputError& error) {
    throw FormatError(options.output, error.where() == options.output ? "" : error.where(), error.message());
  }
  warnIfEnded(motion);
  const auto bytes = static_cast<std::size_t>(std::filesystem::file_size(options.output));
  if (out.json()) {
    out.document(exportJson(options.output, bytes, motion));
  } else {
    out.text() << "Written: " << options.output << " (" << out.number(motion.end) << " s, "
               << counted(static_cast<long long>(motion.events.size()), "impact") << ", " << bytes << " bytes)\n";
  }
  return Exit::done;
}

Action declare(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  addScene(app, options->scene);
  app.add_option("-o,--output", options->output, "The file to write: .glb, .gltf, .py, .csv or .svg")
      ->required()
      ->type_name("FILE");
  app.add_option("--fps", options->frames_per_second, "Frames a second (24), or rows (.csv: 60)")
      ->check(positiveNumber())
      ->type_name("N");
  app.add_option("--keys", options->keys, "How a .glb or .gltf is keyed: linear (the default) or cubic")
      ->check(CLI::IsMember({"linear", "cubic"}))
      ->type_name("KIND");
  app.add_option("--tolerance", options->tolerance, "Metres that linear keys may be off between keys (0.0001)")
      ->check(positiveNumber())
      ->type_name("M");
  app.add_flag("--camera", options->camera, "A camera that sees the whole motion (.glb, .gltf, .py)");
  app.add_option("--light", options->light, "A sun of so many lux, 2000 if none are given (.glb, .gltf, .py)")
      ->expected(0, 1)
      ->default_str("2000")
      ->check(positiveNumber())
      ->type_name("LUX");
  app.add_option("--ghosts", options->ghosts, "Translucent copies of moving bodies every S seconds (.glb, .gltf, .py)")
      ->check(positiveNumber())
      ->type_name("S");
  app.add_flag("--nails", options->nails, "Marks of nails and regions (.glb, .gltf, .py)");
  app.add_option("--before", options->before, "Draw the motion of this scene behind it (.svg)")->type_name("OLD.json");
  addRefuseOverlaps(app, options->refuse_overlaps);
  return [options](Output& out) { return exportScene(*options, out); };
}

}  // namespace

const Command kExportCommand{
    "export", "Write the motion as glTF, as a table or as a picture",
    "  .glb, .gltf  scene and motion, for Blender, three.js and every other reader of glTF: linear keys\n"
    "               at every frame, every impact and between, right to 0.1 mm. --keys cubic has one key\n"
    "               an impact, which is exact and small, but not for Blender\n"
    "  .py          a script that opens the same in Blender with frame rate, frame range and camera set:\n"
    "               blender --python motion.py\n"
    "  .csv         a row for every moving body 60 times a second, and before and after each impact\n"
    "  .svg         side and top view with paths, positions, impacts and nails, at most 500 kB: thousands\n"
    "               of impacts become dots, crowds of bodies a shade\n"
    "\n"
    "Examples:\n"
    "  carom export scene.json -o motion.glb\n"
    "  carom export scene.json -o motion.py --camera --light --ghosts 0.1 --nails\n"
    "  carom export edited.json -o both.svg --before scene.json",
    declare};

}  // namespace carom::cli
