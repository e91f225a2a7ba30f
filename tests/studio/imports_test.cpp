// SPDX-License-Identifier: MIT
// Files of other programs: glTF becomes a scene, OBJ a mesh; what is refused is said by name, and then nothing changed.
#include "studio/imports.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "examples/support/project_file.h"
#include "formats/base/base64.hpp"
#include "formats/base/read_file.hpp"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Importing : testing::Test, WorkerTest {
  Json state;

  void SetUp() override {
    hello(1);
    worker->step({});
    state = lastOf(received.take(1), "state");
  }
  static std::string corpus(const std::string& name) {
    return formats_detail::readFile(projectFile("fuzz/corpus/gltf/") + name, "a file", 1u << 20);
  }
  /// Sends a file in parts of so many bytes.
  void upload(const std::string& name, const std::string& bytes, std::size_t part = 1000) {
    for (std::size_t at = 0; at == 0 || at < bytes.size(); at += part) {
      const Json answer = lastOf(ask(1, {{"type", "upload"}, {"name", name}, {"at", at}, {"data", formats_detail::base64(bytes.substr(at, part))}}), "uploaded");
      ASSERT_EQ(answer["bytes"], std::min(bytes.size(), at + part));
    }
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) names.push_back(fs::relative(entry.path(), folder.path()).string());
    std::ranges::sort(names);
    return names;
  }
  /// It is refused with these words, and files, steps and scene are as they were.
  void expectRefused(const Json& message, const std::string& code, const std::string& words) {
    const std::vector<std::string> before = files();
    const std::vector<Json> got = ask(1, message);
    const Json error = lastOf(got, "error");
    ASSERT_FALSE(error.is_null()) << message;
    EXPECT_EQ(error["code"], code) << error;
    EXPECT_NE(error["message"].get<std::string>().find(words), std::string::npos) << error;
    EXPECT_TRUE(lastOf(got, "imported").is_null());
    EXPECT_EQ(files(), before);
    const Json now = lastOf(ask(1, {{"type", "stop"}}), "state");
    for (const char* member : {"rev", "bodies", "undo", "path", "saved"}) EXPECT_EQ(now[member], state[member]) << member;
  }
};

TEST_F(Importing, AGltfFileOfTheFolderBecomesASceneBesideIt) {
  folder.write("bodies.gltf", corpus("bodies.gltf"));
  std::vector<Json> got = ask(1, {{"type", "import"}, {"path", "bodies.gltf"}});
  const Json imported = lastOf(got, "imported");
  ASSERT_FALSE(imported.is_null()) << lastOf(got, "error");
  EXPECT_EQ(imported["path"], "bodies.json");
  EXPECT_EQ(imported["mesh"], false);
  EXPECT_GE(imported["warnings"].size(), 1u);
  const Json opened = lastOf(got, "state");
  EXPECT_EQ(opened["path"], "bodies.json");
  EXPECT_EQ(opened["saved"], true);
  EXPECT_EQ(opened["bodies"].size(), 4u);
  EXPECT_EQ(lastOf(ask(1, {{"type", "import"}, {"path", "bodies.gltf"}}), "imported")["path"], "bodies-2.json") << "nothing is replaced";
}

TEST_F(Importing, AnUploadedFileBecomesAScene) {
  upload("tetrahedron.glb", corpus("tetrahedron.glb"), 64);
  const std::vector<Json> got = ask(1, {{"type", "import"}, {"as", "hull"}});
  ASSERT_FALSE(lastOf(got, "imported").is_null()) << lastOf(got, "error");
  EXPECT_EQ(lastOf(got, "imported")["path"], "tetrahedron.json");
  EXPECT_EQ(lastOf(got, "state")["bodies"].size(), 1u);
  state = lastOf(got, "state");
  expectRefused({{"type", "import"}}, "input", "uploaded");
}

TEST_F(Importing, AnObjFileIsPutIntoTheFolder) {
  upload("crate.obj", std::string(kCube) + "f 1 2 1\n");
  const Json imported = lastOf(ask(1, {{"type", "import"}}), "imported");
  ASSERT_FALSE(imported.is_null());
  EXPECT_EQ(imported["mesh"], true);
  EXPECT_EQ(imported["path"], "crate.obj");
  ASSERT_EQ(imported["warnings"].size(), 1u);
  EXPECT_TRUE(imported["warnings"][0].get<std::string>().starts_with("crate.obj was repaired: "));
  EXPECT_EQ(folder.read("crate.obj"), std::string(kCube) + "f 1 2 1\n");
  const Json again = lastOf(ask(1, {{"type", "import"}, {"path", "crate.obj"}}), "imported");
  EXPECT_EQ(again["path"], "crate.obj");
  const Json added = lastOf(ask(1, {{"type", "add_body"}, {"rev", state["rev"]}, {"body", {{"name", "crate"}, {"shape", {{"mesh", {{"file", "crate.obj"}}}}}, {"density", 600}}}, {"on", {{"point", {0, -3, 0}}, {"normal", {0, 0, 1}}}}}), "state");
  EXPECT_EQ(added["bodies"].size(), state["bodies"].size() + 1);
}

TEST_F(Importing, WhatIsRefusedIsSaidByNameAndNothingIsLost) {
  for (const char* name : {"strip.gltf", "no-accessor.gltf", "ring-of-nodes.gltf", "short.glb"}) {
    folder.write(name, corpus(name));
    expectRefused({{"type", "import"}, {"path", name}}, "input", name);
    upload(name, corpus(name));
    expectRefused({{"type", "import"}}, "input", name);
  }
  upload("none.obj", "v 0 0 0\n");
  expectRefused({{"type", "import"}}, "input", "none");
  upload("words.txt", "words");
  expectRefused({{"type", "import"}}, "input", "words.txt");
  expectRefused({{"type", "import"}, {"path", "missing.glb"}}, "input", "missing.glb");
  expectRefused({{"type", "import"}, {"path", "../up.glb"}}, "input", "..");
  expectRefused({{"type", "import"}, {"path", "bounce.json"}}, "input", "bounce.json");
  fs::create_symlink("/etc/passwd", folder.path() + "/link.glb");
  expectRefused({{"type", "import"}, {"path", "link.glb"}}, "input", "link");
}

TEST_F(Importing, UnsavedStepsAreAskedFor) {
  folder.write("bodies.gltf", corpus("bodies.gltf"));
  state = lastOf(ask(1, {{"type", "set"}, {"rev", state["rev"]}, {"edits", {{{"pointer", "/bodies/1/velocity/0"}, {"value", 1}}}}}), "state");
  expectRefused({{"type", "import"}, {"path", "bodies.gltf"}}, "conflict", "unsaved");
  EXPECT_FALSE(lastOf(ask(1, {{"type", "import"}, {"path", "bodies.gltf"}, {"replace", true}}), "imported").is_null());
}

TEST_F(Importing, PartsComeInOrderAndNamesStayInTheFolder) {
  ask(1, {{"type", "upload"}, {"name", "a.obj"}, {"at", 0}, {"data", "YWJj"}});
  EXPECT_EQ(lastOf(ask(1, {{"type", "upload"}, {"name", "a.obj"}, {"at", 4}, {"data", "YWJj"}}), "error")["code"], "input");
  EXPECT_EQ(lastOf(ask(1, {{"type", "import"}}), "error")["code"], "input") << "the file is gone";
  EXPECT_THROW(send(1, {{"type", "upload"}, {"name", "a/b.obj"}, {"at", 0}, {"data", ""}}), MessageError);
  for (const char* data : {"YWJ", "YW=j", "YW J", "YWJ=YWJj", "====", "YR=="})
    EXPECT_THROW(send(1, {{"type", "upload"}, {"name", "a.obj"}, {"at", 0}, {"data", data}}), MessageError) << data;
  for (const char* name : {"..", ".obj", "...obj", "\\..\\x.obj", "a\nb.obj"}) {
    upload(name, kCube);
    const std::vector<Json> got = ask(1, {{"type", "import"}});
    if (!lastOf(got, "imported").is_null()) EXPECT_TRUE(fs::exists(folder.path() + "/" + lastOf(got, "imported")["path"].get<std::string>())) << name;
  }
  UploadedFile file;
  addPart(file, {"big.obj", 0, std::string(kLargestUpload, 'a')});
  EXPECT_THROW(addPart(file, {"big.obj", kLargestUpload, "a"}), FileFailure);
}

TEST(Base64, IsReadAsItIsWritten) {
  std::string bytes;
  for (int k = 0; k < 260; ++k) {
    EXPECT_EQ(formats_detail::fromBase64(formats_detail::base64(bytes)), bytes);
    bytes += static_cast<char>(k * 37);
  }
}

}  // namespace
}  // namespace carom::studio
