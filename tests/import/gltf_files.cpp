// SPDX-License-Identifier: MIT
#include "tests/import/gltf_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "adjoint/base/errors.h"
#include "adjoint/motion/motion.h"
#include "examples/support/project_file.h"

namespace carom::import_tests {

namespace fs = std::filesystem;
using nlohmann::json;

std::string samplePath(const std::string& name) { return projectFile("tests/import/data/") + name; }

std::vector<std::string> allFiles() {
  std::vector<std::string> files;
  std::vector<std::string> folders{projectFile("tests/import/data")};
#ifdef CAROM_GLTF_SAMPLES
  folders.emplace_back(CAROM_GLTF_SAMPLES);
#endif
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
        files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::string temporaryPath(const std::string& name) {
  static std::string last;
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string test = std::string(info->test_suite_name()) + "-" + info->name();
  std::replace(test.begin(), test.end(), '/', '-');  // tests with parameters have it in their names
  const std::string folder = testing::TempDir() + "carom-import-" + test;
  if (last != test) fs::remove_all(folder);
  last = test;
  fs::create_directories(folder);
  return folder + "/" + name;
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in.good()) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string writeTemporary(const std::string& name, const std::string& content) {
  const std::string path = temporaryPath(name);
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

json jsonOf(const std::string& path) { return json::parse(contentOf(path)); }

Imported importJson(const json& document) { return importGltf(writeTemporary("document.gltf", document.dump())); }

json plainDocument() {
  return json::parse(R"({
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_implicit_shapes", "KHR_physics_rigid_bodies"],
    "extensions": {
      "KHR_implicit_shapes": {"shapes": [{"type": "plane", "plane": {}}, {"type": "sphere", "sphere": {"radius": 0.1}}]},
      "KHR_physics_rigid_bodies": {"physicsMaterials": [
        {"name": "m", "staticFriction": 0.4, "dynamicFriction": 0.4, "restitution": 0.5}]}},
    "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [
      {"name": "floor", "extensions": {"KHR_physics_rigid_bodies": {
        "collider": {"geometry": {"shape": 0}, "physicsMaterial": 0}}}},
      {"name": "ball", "translation": [0, 2, 0], "extensions": {"KHR_physics_rigid_bodies": {
        "motion": {"mass": 1}, "collider": {"geometry": {"shape": 1}, "physicsMaterial": 0}}}}]
  })");
}

json& physicsOf(json& document, int node) {
  return document["nodes"][static_cast<std::size_t>(node)]["extensions"]["KHR_physics_rigid_bodies"];
}
json& shapesOf(json& document) { return document["extensions"]["KHR_implicit_shapes"]["shapes"]; }
json& materialOf(json& document) { return document["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"][0]; }
json& ballMotion(json& document) { return physicsOf(document, 1)["motion"]; }

const Body& bodyIn(const Imported& imported, const std::string& name) {
  const Scene& scene = imported.document.scene;
  return scene.bodies[static_cast<std::size_t>(bodyIndex(scene, name))];
}

namespace {

std::string word(std::size_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xffu);
  return bytes;
}

std::string chunk(const char* type, std::string content, char filler) {
  while (content.size() % 4 != 0) content += filler;
  return word(content.size()) + std::string(type, 4) + content;
}

}  // namespace

std::string binaryOf(json document, const std::string& buffer) {
  document["buffers"][0].erase("uri");
  const std::string chunks = chunk("JSON", document.dump(), ' ') + chunk("BIN\0", buffer, '\0');
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

void stripExtras(json& value) {
  if (value.is_object()) value.erase("extras");
  if (value.is_structured())
    for (json& item : value) stripExtras(item);
}

void exportFreeFlight(const std::string& path, const Document& document, const GltfOptions& options) {
  const Scene& scene = document.scene;
  Motion motion;
  motion.scene = std::make_shared<const Scene>(scene);
  auto models = std::make_shared<std::vector<BodyModel>>();
  for (const Body& body : scene.bodies) models->push_back(modelOf(body));
  motion.models = models;
  motion.plan = makePlan(scene);
  motion.duration = motion.end = 0.1;
  motion.world_lines.resize(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    motion.world_lines[i].arcs.emplace_back((*models)[i], motion.plan.bodies[i].tier, scene.gravity, 0.0,
                                            startState(scene.bodies[i], (*models)[i]));
    motion.world_lines[i].arcs.back().extendTo(motion.end);
  }
  exportMotion(path, document, motion, {options});
}

std::string messageOf(const std::function<void()>& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool hasWarning(const ImportReport& report, const std::vector<std::string>& words) {
  return std::any_of(report.warnings.begin(), report.warnings.end(), [&](const std::string& warning) {
    return std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return warning.find(word) != std::string::npos; });
  });
}

std::string listOf(const ImportReport& report) {
  std::string text = std::to_string(report.warnings.size()) + " warnings";
  for (const std::string& warning : report.warnings) text += "\n  " + warning;
  return text;
}

}  // namespace carom::import_tests
