// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/gltf/write/export_gltf.h"

namespace carom {

/// Options of all formats.
struct ExportOptions {
  GltfOptions gltf = {};           ///< .glb, .gltf and .py, a script for Blender
  double csv_rate = 60;            ///< rows per second
  const Motion* before = nullptr;  ///< drawn behind the motion in pictures
};

/// Writes a motion in the format that the extension of `path` names (.glb, .gltf, .py, .csv, .svg; capitals allowed).
/// The file is written atomically. Throws InputError naming the path.
void exportMotion(const std::string& path, const Document& document, const Motion& motion,
                  const ExportOptions& options = {});

/// The bytes of a file of a format: "glb", "gltf", "py", "csv" or "svg". `title` stands above a picture. Throws
/// InputError.
std::string motionText(const std::string& format, const std::string& title, const Document& document,
                       const Motion& motion, const ExportOptions& options = {});

/// The supported extensions, with their dots.
std::vector<std::string> exportExtensions();

}  // namespace carom
