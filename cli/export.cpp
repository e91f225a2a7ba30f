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
  std::string scene, output, before;
  std::string profile;
  std::optional<double> frames_per_second;
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
  const bool gltf = extension == ".glb" || extension == ".gltf";
  if (!options.profile.empty() && !gltf) throw UsageError("--profile is only for .glb and .gltf");
  if (!options.before.empty() && extension != ".svg") throw UsageError("--before is only for .svg");
  if (!options.frames_per_second) return;
  if (gltf && options.profile != "blender") throw UsageError("--fps needs --profile blender: a web key is exact");
  if (extension == ".svg") throw UsageError("--fps is only for .glb, .gltf and .csv");
}

Exit exportScene(const Options& options, Output& out) {
  requireSense(options);
  Loaded loaded(options.scene);
  const Motion motion = loaded.simulate();
  ExportOptions export_options;
  if (options.profile == "blender") export_options.gltf.profile = GltfProfile::blender;
  if (options.frames_per_second)
    export_options.gltf.frames_per_second = export_options.csv_rate = *options.frames_per_second;
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
  app.add_option("-o,--output", options->output, "The file to write: .glb, .gltf, .csv or .svg")
      ->required()
      ->type_name("FILE");
  app.add_option("--profile", options->profile, "How a .glb or .gltf is keyed: web (the default) or blender")
      ->check(CLI::IsMember({"web", "blender"}))
      ->type_name("NAME");
  app.add_option("--before", options->before, "Draw the motion of this scene behind it (.svg)")->type_name("OLD.json");
  app.add_option("--fps", options->frames_per_second, "Frames (blender) or rows (.csv) a second")
      ->check(positiveNumber())
      ->type_name("N");
  return [options](Output& out) { return exportScene(*options, out); };
}

}  // namespace

const Command kExportCommand{
    "export", "Write the motion as glTF, as a table or as a picture",
    "  .glb, .gltf  scene and motion. Profile web has one cubic key an impact, which is exact; profile\n"
    "               blender has linear keys at every frame (24 a second) and every impact, because\n"
    "               Blender drops cubic tangents\n"
    "  .csv         a row for every moving body 60 times a second, and before and after each impact\n"
    "  .svg         side and top view with paths, ghosts, impacts and targets\n"
    "\n"
    "Examples:\n"
    "  carom export scene.json -o motion.glb\n"
    "  carom export scene.json -o motion.glb --profile blender --fps 60\n"
    "  carom export edited.json -o both.svg --before scene.json",
    declare};

}  // namespace carom::cli
