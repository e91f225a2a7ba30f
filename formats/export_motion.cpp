// SPDX-License-Identifier: MIT
#include "formats/export_motion.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "adjoint/errors.h"
#include "formats/export_blender.h"
#include "formats/export_csv.h"
#include "formats/export_svg.h"

namespace carom {
namespace {

using Exporter = void (*)(const std::string&, const Document&, const Motion&, const ExportOptions&);

void writeGltf(const std::string& path, const Document& document, const Motion& motion, const ExportOptions& options) {
  exportGltf(path, document, motion, options.gltf);
}
void writeBlender(const std::string& path, const Document& document, const Motion& motion,
                  const ExportOptions& options) {
  exportBlender(path, document, motion, options.gltf);
}
void writeCsv(const std::string& path, const Document& document, const Motion& motion, const ExportOptions& options) {
  exportCsv(path, document, motion, options.csv_rate);
}
void writeSvg(const std::string& path, const Document& document, const Motion& motion, const ExportOptions& options) {
  exportSvg(path, document, motion, options.before);
}

struct Format {
  const char* extension;
  Exporter write;
};
constexpr Format kFormats[] = {
    {".glb", writeGltf}, {".gltf", writeGltf}, {".py", writeBlender}, {".csv", writeCsv}, {".svg", writeSvg}};

}  // namespace

void exportMotion(const std::string& path, const Document& document, const Motion& motion,
                  const ExportOptions& options) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const Format& format : kFormats)
    if (extension == format.extension) return format.write(path, document, motion, options);
  std::string expected;
  for (const Format& format : kFormats) expected += std::string(expected.empty() ? "" : ", ") + format.extension;
  throw InputError(path, "found the extension '" + extension + "', expected one of " + expected);
}

std::vector<std::string> exportExtensions() {
  std::vector<std::string> out;
  for (const Format& format : kFormats) out.push_back(format.extension);
  return out;
}

}  // namespace carom
