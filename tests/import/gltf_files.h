// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/export/export_motion.h"
#include "formats/gltf/read/import_gltf.h"

namespace carom::import_tests {

/// The sample files of this folder.
std::string samplePath(const std::string& name);
/// They, and those under CAROM_GLTF_SAMPLES when that is set.
std::vector<std::string> allFiles();

/// A path in a folder of this test, which is emptied when the test asks for its first path.
std::string temporaryPath(const std::string& name);
std::string contentOf(const std::string& path);
std::string writeTemporary(const std::string& name, const std::string& content);

nlohmann::json jsonOf(const std::string& path);
/// Writes a document and imports it.
Imported importJson(const nlohmann::json& document);

/// A document with a floor "floor" (plane) and a moving ball "ball" (0.1 m, 1 kg, 2 m up): nodes 0 and 1.
nlohmann::json plainDocument();
/// Extension KHR_physics_rigid_bodies of a node, made where it is missing.
nlohmann::json& physicsOf(nlohmann::json& document, int node);
/// Of plainDocument(): its shapes, its first material, the ball's motion.
nlohmann::json& shapesOf(nlohmann::json& document);
nlohmann::json& materialOf(nlohmann::json& document);
nlohmann::json& ballMotion(nlohmann::json& document);

const Body& bodyIn(const Imported& imported, const std::string& name);

/// The document as binary glTF; its first buffer becomes the binary chunk.
std::string binaryOf(nlohmann::json document, const std::string& buffer);

/// Takes all members `extras` out.
void stripExtras(nlohmann::json& value);

/// Writes a document as glTF with a motion of 0.1 s in free flight, whatever may be in the way.
void exportFreeFlight(const std::string& path, const Document& document, const GltfOptions& options = {});

/// The message of the error that a function throws; fails the test when it throws none.
std::string messageOf(const std::function<void()>& function);

/// Whether any of the warnings has all the words.
bool hasWarning(const ImportReport& report, const std::vector<std::string>& words);
std::string listOf(const ImportReport& report);

}  // namespace carom::import_tests
