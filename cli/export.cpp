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
#include "studio/motion_page.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

struct ExportArguments {
  std::string scene, output, format, before, keys;
  std::optional<double> frames_per_second, tolerance;
  GltfOptions gltf;  // camera, light, ghosts and nails
  MotionArguments motion;
};

constexpr const char* kPage = "html";  // made of the page of the studio, which the library of formats does not have

/// What files may end with.
std::vector<std::string> extensions() {
  std::vector<std::string> all = exportExtensions();
  all.push_back(std::string(".") + kPage);
  return all;
}

/// The words of --format: the extensions without their dots.
std::vector<std::string> formats() {
  std::vector<std::string> words = extensions();
  for (std::string& word : words) word.erase(0, 1);
  return words;
}

/// The word that is given, or else the one that the name of the file ends with.
std::string formatOf(const ExportArguments& options) {
  if (!options.format.empty()) return options.format;
  const std::vector<std::string> known = extensions();
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
  const bool shown = format == "svg" || format == kPage;
  if (!options.before.empty() && !shown) throw UsageError("--before is only for .svg and .html");
  if (options.frames_per_second && shown) throw UsageError("--fps is only for .glb, .gltf, .py and .csv");
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

/// The motion before, of a document of its own.
struct Earlier {
  Document document;
  Motion motion;
};

std::string pageText(const ExportArguments& options, const Document& document, const Motion& motion,
                     const std::optional<Earlier>& earlier) {
  const studio::PageFiles files(studio::studioFolder());
  std::optional<studio::ShownMotion> before;
  if (earlier) before.emplace(studio::ShownMotion{earlier->document, earlier->motion});
  const std::string title = document.name.empty() ? titleOf(options, document) : document.name;
  return studio::motionPage(files, title, {document, motion}, before ? &*before : nullptr);
}

/// Writes the file; how many bytes it has.
std::size_t writeExport(const ExportArguments& options, const std::string& format, const Loaded& loaded,
                        const Motion& motion, const std::optional<Earlier>& earlier,
                        const ExportOptions& export_options, Output& out) {
  const Progress progress(out, "writing " + format);
  const std::string name = isStandard(options.output) ? "<stdout>" : options.output;
  return inFile(name, [&] {
    std::string bytes =
        format == kPage ? pageText(options, loaded.document, motion, earlier)
                        : motionText(format, titleOf(options, loaded.document), loaded.document, motion, export_options);
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
  std::optional<Earlier> earlier;
  if (!options.before.empty()) {
    Loaded before(out, options.before, {.step_limit = options.motion.step_limit});
    Motion its_motion = before.simulate(out);
    requireNotStopped(its_motion);
    earlier.emplace(Earlier{std::move(before.document), std::move(its_motion)});
    export_options.before = &earlier->motion;
  }
  const std::size_t bytes = writeExport(options, format, loaded, motion, earlier, export_options, out);
  warnIfEnded(out, motion);
  if (out.json())
    out.document(exportJson(options.output, bytes, motion));
  else
    sayWritten(out, options.output,
               " (" + out.number(motion.end) + " s, " + counted(motion.impacts, "impact") + ", " +
                   std::to_string(bytes) + " bytes)");
  return exitOf(motion);
}

Action declareExport(CLI::App& app) {
  const auto options = std::make_shared<ExportArguments>();
  addScene(app, options->scene);
  addOutput(app, options->output, "The file to write: .glb, .gltf, .py, .csv, .svg or .html; - for standard output", "FILE")
      ->required();
  app.add_option("--format", options->format, "Format, if the name of the file does not determine it")
      ->check(CLI::IsMember(formats()))
      ->type_name("FORMAT");
  app.add_option("--fps", options->frames_per_second, "Frames per second (default: 24), or rows (.csv, default: 60)")
      ->check(positiveNumber())
      ->type_name("N");
  app.add_option("--keys", options->keys, "Interpolation of a .glb or .gltf: linear or cubic (default: linear)")
      ->check(CLI::IsMember({"linear", "cubic"}))
      ->type_name("KIND");
  app.add_option("--tolerance", options->tolerance, "Largest error between linear keys in metres (default: 0.0001)")
      ->check(positiveNumber())
      ->type_name("M");
  app.add_flag("--camera", options->gltf.camera, "Add a camera that frames the whole motion (.glb, .gltf, .py)");
  app.add_option("--light", options->gltf.light, "Add a directional light of LUX lux (.glb, .gltf, .py; default: 2000)")
      ->expected(0, 1)
      ->default_str("2000")
      ->check(positiveNumber())
      ->type_name("LUX");
  app.add_option("--ghosts", options->gltf.ghosts,
                 "Add translucent copies of moving bodies every S seconds (.glb, .gltf, .py)")
      ->check(positiveNumber())
      ->type_name("S");
  app.add_flag("--nails", options->gltf.nails, "Add marks of nails and regions (.glb, .gltf, .py)");
  app.add_option("--before", options->before, "Draw the motion of this scene behind it (.svg, .html); - for standard input")
      ->type_name("OLD.json");
  addMotion(app, options->motion);
  return [options](Output& out) { return exportScene(*options, out); };
}

}  // namespace

const Command kExportCommand{
    "export", "Write the motion as glTF, a table, a picture or a page",
    "  .glb, .gltf  scene and motion, for Blender, three.js and any other glTF reader: linear keys\n"
    "               at every frame, every impact and between, within 0.1 mm. --keys cubic has one key\n"
    "               per impact: exact and small, but not for Blender\n"
    "  .py          a script that opens the same in Blender with frame rate, frame range and camera set:\n"
    "               blender --python motion.py\n"
    "  .csv         a row for every moving body 60 times a second, and before and after each impact\n"
    "  .svg         side and top view with paths, positions, impacts and nails, at most 500 kB: thousands\n"
    "               of impacts become dots, crowds of bodies a density map\n"
    "  .html        one file that plays the motion in any browser, without a network: view, time line,\n"
    "               ghosts, impacts, nails and numbers, as in carom studio\n"
    "A motion that ends early is written as far as it goes, with a warning and the exit code 5.\n"
    "\n"
    "Examples:\n"
    "  carom export scene.json -o motion.glb\n"
    "  carom export scene.json -o motion.py --camera --light --ghosts 0.1 --nails\n"
    "  carom export edited.json -o both.svg --before scene.json\n"
    "  carom export edited.json -o motion.html --before scene.json\n"
    "  carom export scene.json --format csv -o - | head",
    declareExport};

}  // namespace carom::cli
