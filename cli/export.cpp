// SPDX-License-Identifier: MIT
// carom export: the motion in the formats of other programs.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "formats/answers/status_json.hpp"
#include "formats/base/write_file.hpp"
#include "formats/export/export_motion.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

struct ExportArguments {
  std::string scene, output, format, before, keys;
  std::optional<double> frames_per_second, tolerance;
  GltfOptions gltf;  // camera, light, ghosts and nails
  MotionArguments motion;
};

/// The words of --format: the extensions without their dots.
std::vector<std::string> formats() {
  std::vector<std::string> words = exportExtensions();
  for (std::string& word : words) word.erase(0, 1);
  return words;
}

/// The word that is given, or else the one that the name of the file ends with.
std::string formatOf(const ExportArguments& options) {
  if (!options.format.empty()) return options.format;
  const std::vector<std::string> known = exportExtensions();
  const std::string list = joined(known), extension = extensionOf(options.output);
  if (isStandard(options.output)) throw UsageError("-o - needs --format, one of " + list);
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw UsageError("-o " + options.output + ": found the extension '" + extension + "', expected one of " + list);
  return extension.substr(1);
}

/// Options that the chosen format does not have would be lost in silence.
void requireSense(const ExportArguments& options, const std::string& format) {
  if (isStandard(options.scene) && isStandard(options.before))
    throw UsageError("--before -: standard input is read once, for the scene");
  if (!options.before.empty() && format != "svg") throw UsageError("--before is only for .svg");
  if (options.frames_per_second && format == "svg") throw UsageError("--fps is only for .glb, .gltf, .py and .csv");
  if (options.keys == "cubic" && format == "py")
    throw UsageError("--keys cubic is only for .glb and .gltf: Blender drops the tangents of cubic keys");
  if (options.keys == "cubic" && options.tolerance) throw UsageError("--tolerance needs --keys linear");
  if (format == "glb" || format == "gltf" || format == "py") return;
  const std::pair<const char*, bool> given[] = {{"--keys", !options.keys.empty()},
                                                {"--tolerance", options.tolerance.has_value()},
                                                {"--camera", options.gltf.camera},
                                                {"--light", options.gltf.light.has_value()},
                                                {"--ghosts", options.gltf.ghosts.has_value()},
                                                {"--nails", options.gltf.nails}};
  for (const auto& [name, is_given] : given)
    if (is_given) throw UsageError(std::string(name) + " is only for .glb, .gltf and .py");
}

/// Keeps standard output for the file, where it is to go there.
void reserveOutput(const ExportArguments& options, const std::string& format, Output& out) {
  if (!isStandard(options.output)) return;
  if (format == "glb" && isTerminal(Stream::out))
    throw UsageError("-o -: found a terminal, which a binary .glb file would upset, expected a file or a pipe");
  out.reserveForContent();
}

/// What stands above a picture.
std::string titleOf(const ExportArguments& options, const Document& document) {
  if (!isStandard(options.output)) return std::filesystem::path(options.output).stem().string();
  if (!document.name.empty()) return document.name;
  return isStandard(options.scene) ? "motion" : std::filesystem::path(options.scene).stem().string();
}

/// Writes the file; how many bytes it has.
std::size_t writeExport(const ExportArguments& options, const std::string& format, const Loaded& loaded,
                        const Motion& motion, const ExportOptions& export_options, Output& out) {
  const Progress progress(out, "writing " + format);
  const std::string name = isStandard(options.output) ? "<stdout>" : options.output;
  return inFile(name, [&] {
    std::string bytes =
        motionText(format, titleOf(options, loaded.document), loaded.document, motion, export_options);
    const std::size_t size = bytes.size();
    if (isStandard(options.output))
      out.content(std::move(bytes));
    else
      writeFile(options.output, bytes);
    return size;
  });
}

Exit exportScene(const ExportArguments& options, Output& out) {
  const std::string format = formatOf(options);
  requireSense(options, format);
  reserveOutput(options, format, out);
  requireOutput(options.output);
  Loaded loaded(out, options.scene, options.motion);
  warnOfOverlaps(out, loaded);
  const Motion motion = loaded.simulate(out);
  requireNotStopped(motion);
  ExportOptions export_options;
  export_options.gltf = options.gltf;
  GltfOptions& gltf = export_options.gltf;
  if (options.keys == "cubic") gltf.keys = GltfKeys::cubic;
  gltf.frames_per_second = options.frames_per_second.value_or(gltf.frames_per_second);
  gltf.tolerance = options.tolerance.value_or(gltf.tolerance);
  export_options.csv_rate = options.frames_per_second.value_or(export_options.csv_rate);
  std::optional<Motion> before;
  if (!options.before.empty()) {
    Loaded earlier(out, options.before, {false, options.motion.step_limit});
    before = earlier.simulate(out);
    requireNotStopped(*before);
    export_options.before = &*before;
  }
  const std::size_t bytes = writeExport(options, format, loaded, motion, export_options, out);
  warnIfEnded(out, motion);
  if (out.json())
    out.document(exportJson(options.output, bytes, motion));
  else
    sayWritten(out, options.output,
               " (" + out.number(motion.end) + " s, " + counted(motion.impacts, "impact") + ", " +
                   std::to_string(bytes) + " bytes)");
  return Exit::done;
}

Action declareExport(CLI::App& app) {
  const auto options = std::make_shared<ExportArguments>();
  addScene(app, options->scene);
  addOutput(app, options->output, "The file to write: .glb, .gltf, .py, .csv or .svg; - for standard output", "FILE")
      ->required();
  app.add_option("--format", options->format, "What to write, where the name of the file does not say it")
      ->check(CLI::IsMember(formats()))
      ->type_name("FORMAT");
  app.add_option("--fps", options->frames_per_second, "Frames a second (24), or rows (.csv: 60)")
      ->check(positiveNumber())
      ->type_name("N");
  app.add_option("--keys", options->keys, "How a .glb or .gltf is keyed: linear (the default) or cubic")
      ->check(CLI::IsMember({"linear", "cubic"}))
      ->type_name("KIND");
  app.add_option("--tolerance", options->tolerance, "Metres that linear keys may be off between keys (0.0001)")
      ->check(positiveNumber())
      ->type_name("M");
  app.add_flag("--camera", options->gltf.camera, "A camera that sees the whole motion (.glb, .gltf, .py)");
  app.add_option("--light", options->gltf.light, "A sun of so many lux, 2000 if none are given (.glb, .gltf, .py)")
      ->expected(0, 1)
      ->default_str("2000")
      ->check(positiveNumber())
      ->type_name("LUX");
  app.add_option("--ghosts", options->gltf.ghosts,
                 "Translucent copies of moving bodies every S seconds (.glb, .gltf, .py)")
      ->check(positiveNumber())
      ->type_name("S");
  app.add_flag("--nails", options->gltf.nails, "Marks of nails and regions (.glb, .gltf, .py)");
  app.add_option("--before", options->before, "Draw the motion of this scene behind it (.svg); - for standard input")
      ->type_name("OLD.json");
  addMotion(app, options->motion);
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
    "  carom export edited.json -o both.svg --before scene.json\n"
    "  carom export scene.json --format csv -o - | head",
    declareExport};

}  // namespace carom::cli
