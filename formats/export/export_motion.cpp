// SPDX-License-Identifier: MIT
#include "formats/export/export_motion.h"

#include <filesystem>

#include "adjoint/base/errors.h"
#include "formats/base/short_text.hpp"
#include "formats/base/write_file.hpp"
#include "formats/export/export_blender.h"
#include "formats/export/export_csv.h"
#include "formats/svg/export_svg.h"

namespace carom {

using namespace formats_detail;

namespace {

struct Exported {
  const std::string& title;
  const Document& document;
  const Motion& motion;
  const ExportOptions& options;
};

std::string glb(const Exported& e) { return gltfText(e.document, e.motion, e.options.gltf, true); }
std::string gltf(const Exported& e) { return gltfText(e.document, e.motion, e.options.gltf, false); }
std::string blender(const Exported& e) { return blenderText(e.document, e.motion, e.options.gltf); }
std::string csv(const Exported& e) { return csvText(e.motion, e.options.csv_rate); }
std::string svg(const Exported& e) { return svgText(e.title, e.document, e.motion, e.options.before); }

struct Format {
  const char* extension;
  std::string (*text)(const Exported&);
};
constexpr Format kFormats[] = {{".glb", glb}, {".gltf", gltf}, {".py", blender}, {".csv", csv}, {".svg", svg}};

const Format* findFormat(const std::string& extension) {
  for (const Format& format : kFormats)
    if (extension == format.extension) return &format;
  return nullptr;
}

}  // namespace

void exportMotion(const std::string& path, const Document& document, const Motion& motion,
                  const ExportOptions& options) {
  const std::string extension = extensionOf(path);
  const Format* const format = findFormat(extension);
  if (format == nullptr)
    throw InputError(path, "found the extension '" + extension + "', expected one of " + joined(exportExtensions()));
  const std::string title = std::filesystem::path(path).stem().string();
  writeFile(path, format->text({title, document, motion, options}));
}

std::string motionText(const std::string& format, const std::string& title, const Document& document,
                       const Motion& motion, const ExportOptions& options) {
  const Format* const found = findFormat("." + format);
  if (found == nullptr) {
    std::vector<std::string> words = exportExtensions();
    for (std::string& word : words) word.erase(0, 1);
    throw InputError("format", "found '" + format + "', expected one of " + joined(words));
  }
  return found->text({title, document, motion, options});
}

std::vector<std::string> exportExtensions() {
  std::vector<std::string> out;
  for (const Format& format : kFormats) out.push_back(format.extension);
  return out;
}

}  // namespace carom
