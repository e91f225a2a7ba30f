// SPDX-License-Identifier: MIT
// Exported files as three.js plays them, with its own loader and mixer, and as Khronos' validator judges them. Both run
// in node: scripts/setup three. Where they are missing these tests are skipped, but not with CAROM_REQUIRE_THREE set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "formats/export/export_motion.h"
#include "formats/json/json_writer.hpp"
#include "tests/export/all_shapes.h"
#include "tests/export/hand_motion.h"
#include "tests/export/players.h"

namespace carom::export_tests {

using namespace formats_detail;

namespace {

using nlohmann::json;
using Runner = json (*)(const std::string& script, const std::string& words);

const std::string kFolder = projectFile("tests/three");
constexpr int kStepsAFrame = 4;
constexpr double kFloats = 2e-6;  // m and rad: what floats leave of numbers of some metres

bool isInstalled() {
  for (const char* package : {"three", "gltf-validator"})
    if (!std::filesystem::exists(kFolder + "/node_modules/" + package)) return false;
  return !outputOf("node --version 2>/dev/null").empty();
}

class Node : public testing::Test {
 protected:
  void SetUp() override {
    if (isInstalled()) return;
    if (std::getenv("CAROM_REQUIRE_THREE") != nullptr) FAIL() << "node or three.js is missing: scripts/setup three";
    GTEST_SKIP() << "node or three.js is missing: scripts/setup three";
  }

  static json run(const std::string& script, const std::string& words) {
    const std::string answer = outputOf("node " + quoted(kFolder + "/" + script) + " " + words);
    EXPECT_FALSE(answer.empty()) << script << " " << words;
    return answer.empty() ? json::object() : json::parse(answer);
  }
};

class ThreeJs : public Node, public testing::WithParamInterface<std::string> {};

void playsInThree(const Document& document, const Motion& motion, const GltfOptions& options, const PlayBounds& bounds,
                  Runner run) {
  const std::string path = temporaryPath("m.glb");
  exportMotion(path, document, motion, {options});
  const double step = 1 / (options.frames_per_second * kStepsAFrame);
  const auto count = static_cast<int>(std::floor(motion.end / step));
  const json answer = run("poses.mjs", quoted(path) + " " + numberText(step) + " " + std::to_string(count));
  expectPlays({answer.value("poses", json::object()), step, true, kStepsAFrame}, motion, bounds);
}

TEST_P(ThreeJs, PlaysLinearKeys) {
  const Document document = readDocument(projectFile("examples/scenes/") + GetParam() + ".json");
  const GltfOptions options;
  playsInThree(document, simulated(document), options, {kFloats, kFloats, options.tolerance + kFloats, 1e-3}, run);
}

TEST_P(ThreeJs, PlaysCubicKeys) {
  const Document document = readDocument(projectFile("examples/scenes/") + GetParam() + ".json");
  playsInThree(document, simulated(document), {GltfKeys::cubic}, {1e-5, 1e-3, 1e-5, 1e-3}, run);
}

INSTANTIATE_TEST_SUITE_P(Examples, ThreeJs, testing::ValuesIn(exampleScenes()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_F(Node, ThreeJsPlaysImpactsOutOfStepWithFrames) {
  const GltfOptions options{GltfKeys::linear, 29.97};
  playsInThree(handDocument(), handMotion(), options, {kFloats, kFloats, options.tolerance + kFloats, 1e-3}, run);
}

void isValid(const Document& document, const Motion& motion, Runner run) {
  GltfOptions all{GltfKeys::linear}, cubic{GltfKeys::cubic};
  all.camera = all.nails = true, all.light = 2000, all.ghosts = 0.3;
  exportMotion(temporaryPath("linear.glb"), document, motion);
  exportMotion(temporaryPath("cubic.glb"), document, motion, {cubic});
  exportMotion(temporaryPath("all.gltf"), document, motion, {all});
  const json answer = run("validate.mjs", quoted(temporaryPath("linear.glb")) + " " +
                                              quoted(temporaryPath("cubic.glb")) + " " +
                                              quoted(temporaryPath("all.gltf")));
  EXPECT_EQ(answer.size(), 3u);
  for (const auto& [file, report] : answer.items()) {
    EXPECT_EQ(report.at("errors"), 0) << file << " " << report;
    EXPECT_EQ(report.at("warnings"), 0) << file << " " << report;
  }
}

TEST_P(ThreeJs, IsValidGltf) {
  const Document document = readDocument(projectFile("examples/scenes/") + GetParam() + ".json");
  isValid(document, simulated(document), run);
}

TEST_F(Node, EveryShapeIsValidGltf) {
  isValid(handDocument(), handMotion(), run);
  const Document document = documentOfAllShapes(false);
  isValid(document, handMotion(document.scene, document.duration, {}), run);
}

}  // namespace
}  // namespace carom::export_tests
