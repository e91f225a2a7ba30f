// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "adjoint/base/errors.h"
#include "formats/export/export_motion.h"
#include "tests/export/hand_motion.h"

namespace carom::export_tests {
namespace {

TEST(ExportMotion, TheExtensionChoosesTheFormat) {
  const Motion motion = handMotion();
  const auto start = [&](const std::string& name) {
    const std::string path = temporaryPath(name);
    exportMotion(path, handDocument(), motion);
    return contentOf(path).substr(0, 5);
  };
  EXPECT_EQ(start("m.glb").substr(0, 4), "glTF");
  EXPECT_EQ(start("m.gltf").substr(0, 1), "{");
  EXPECT_EQ(start("m.py"), "# A m");
  EXPECT_EQ(start("m.csv"), "time ");
  EXPECT_EQ(start("m.svg"), "<?xml");
  EXPECT_EQ(start("M.SVG"), "<?xml");
  EXPECT_EQ(start("m.GLB").substr(0, 4), "glTF");
}

TEST(ExportMotion, TextsAreWhatFilesHold) {
  const Motion motion = handMotion();
  for (const std::string& extension : exportExtensions()) {
    const std::string path = temporaryPath("text" + extension);
    exportMotion(path, handDocument(), motion);
    const std::string title = std::filesystem::path(path).stem().string();
    EXPECT_TRUE(motionText(extension.substr(1), title, handDocument(), motion) == contentOf(path)) << extension;
  }
  EXPECT_NE(motionText("svg", "A title", handDocument(), motion).find(">A title<"), std::string::npos);
  for (const char* format : {"", "obj", ".glb", "GLB"})
    EXPECT_THROW(motionText(format, "text", handDocument(), motion), InputError) << format;
}

TEST(ExportMotion, ErrorsNameThePathAndLeaveNothingBehind) {
  const Motion motion = handMotion();
  const std::string folder = temporaryPath("folder");
  std::filesystem::create_directories(folder + "/taken.svg");
  for (const std::string name : {"/m.obj", "/m", "/none/m.glb", "/none/m.svg", "/none/m.csv", "/taken.svg"}) {
    try {
      exportMotion(folder + name, handDocument(), motion);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(folder + name), std::string::npos) << error.what();
    }
  }
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  EXPECT_EQ(files, 1);  // taken.svg itself
}

TEST(ExportMotion, AnOldFileIsReplaced) {
  const std::string path = temporaryPath("m.csv");
  const Motion motion = handMotion();
  exportMotion(path, handDocument(), motion);
  const std::string first = contentOf(path);
  exportMotion(path, handDocument(), motion);
  EXPECT_EQ(contentOf(path), first);
  EXPECT_EQ(exportExtensions().size(), 5u);
}

}  // namespace
}  // namespace carom::export_tests
