// SPDX-License-Identifier: MIT
// A document with surfaces made in memory, and the mesh files beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "formats/documents/scene_json.h"
#include "tests/import/gltf_files.h"
#include "tests/import/same_scene.h"
#include "tests/import/scenes.h"

namespace carom::import_tests {
namespace {

namespace fs = std::filesystem;

TEST(SaveWithMeshes, ReadsBackBitByBit) {
  const Document document = documentOfEveryKind();
  const std::string path = temporaryPath("scene.json");
  const std::vector<std::string> meshes = saveWithMeshes(path, document);
  const Document read = readDocument(path);
  ASSERT_EQ(read.scene.bodies.size(), document.scene.bodies.size());
  Scene expected = document.scene;
  for (std::size_t i = 0; i < expected.bodies.size(); ++i)
    if (expected.bodies[i].inertia.source == Inertia::Source::matrix)
      expected.bodies[i].inertia = read.scene.bodies[i].inertia;  // a document rounds a matrix to 15 digits
  expectSameScene(read.scene, expected);
  expectSameEdit(read, document);
  for (const std::string& mesh : meshes) EXPECT_TRUE(fs::is_regular_file(temporaryPath(mesh))) << mesh;
}

TEST(SaveWithMeshes, WritesASurfaceOnceAndSmallHullsInTheDocument) {
  const std::string path = temporaryPath("scene.json");
  const std::vector<std::string> meshes = saveWithMeshes(path, documentOfEveryKind());
  EXPECT_EQ(meshes, (std::vector<std::string>{"scene-meshes/open_mesh.obj", "scene-meshes/shed.obj",
                                              "scene-meshes/stone.obj", "scene-meshes/terrain.obj"}));
  EXPECT_TRUE(saveWithMeshes(temporaryPath("small.json"), importGltf(samplePath("older.gltf")).document).empty());
  EXPECT_FALSE(fs::exists(temporaryPath("small-meshes")));
}

TEST(SaveWithMeshes, WritesOverWhatWasThere) {
  const std::string path = temporaryPath("scene.json");
  saveWithMeshes(path, documentOfEveryKind());
  const std::string text = contentOf(path), mesh = contentOf(temporaryPath("scene-meshes/terrain.obj"));
  writeTemporary("scene.json", "something else");
  writeTemporary("scene-meshes/terrain.obj", "v 1 2 3");
  saveWithMeshes(path, documentOfEveryKind());
  EXPECT_EQ(contentOf(path), text);
  EXPECT_EQ(contentOf(temporaryPath("scene-meshes/terrain.obj")), mesh);
}

TEST(SaveWithMeshes, FilesThatBodiesHaveStayWhereTheyAre) {
  const std::string first = temporaryPath("first.json");
  saveWithMeshes(first, documentOfEveryKind());
  const Document read = readDocument(first);
  fs::create_directories(temporaryPath("below"));
  EXPECT_TRUE(saveWithMeshes(temporaryPath("below/second.json"), read).empty());
  const Document again = readDocument(temporaryPath("below/second.json"));
  expectSameScene(again.scene, read.scene);
  const auto& mesh = std::get<Mesh>(again.scene.bodies.back().shape);
  EXPECT_EQ(mesh.file, "../first-meshes/open_mesh.obj");
}

TEST(SaveWithMeshes, NamesOfFilesAreFitForEveryFileSystem) {
  Document document = documentOfEveryKind();
  const Mesh mesh = std::get<Mesh>(document.scene.bodies.back().shape);
  document.scene.bodies.clear();
  document.controls.clear(), document.constraints.clear(), document.scene.tilts.clear();
  for (const char* name : {"A/B:..\\", "a_b_.._", "\xC3\xA9t\xC3\xA9", "..", "AUX a"}) {
    Body body;
    body.name = name, body.fixed = true;
    body.shape = Mesh{std::make_shared<const Surface>(*mesh.surface), 1, ""};
    document.scene.bodies.push_back(body);
  }
  const std::vector<std::string> meshes = saveWithMeshes(temporaryPath("names.json"), document);
  EXPECT_EQ(meshes.size(), 5u);
  for (const std::string& name : meshes)
    EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '-' || c == '_' || c == '/' || c == '.';
    })) << name;
  expectSameScene(readDocument(temporaryPath("names.json")).scene, document.scene);
}

TEST(SaveWithMeshes, ErrorsNameTheFile) {
  const std::string nowhere = temporaryPath("no-such-folder/scene.json");
  const std::string message = messageOf([&] { saveWithMeshes(nowhere, documentOfEveryKind()); });
  EXPECT_NE(message.find("no-such-folder"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(temporaryPath("no-such-folder")));
  writeTemporary("blocked-meshes", "a file where the folder should be");
  const std::string blocked = messageOf([&] { saveWithMeshes(temporaryPath("blocked.json"), documentOfEveryKind()); });
  EXPECT_NE(blocked.find("blocked-meshes"), std::string::npos) << blocked;
  EXPECT_FALSE(fs::exists(temporaryPath("blocked.json")));
}

}  // namespace
}  // namespace carom::import_tests
