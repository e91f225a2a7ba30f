// SPDX-License-Identifier: MIT
#include "studio/workspace.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "tests/studio/share_folder.h"

namespace carom::studio {
namespace {

namespace fs = std::filesystem;

struct WorkspaceTest : testing::Test {
  TestFolder outer;
  void SetUp() override {
    outer.write("outside.json", "outside");
    outer.write("root/a.json", "a");
    outer.write("root/sub/b.json", "b");
    outer.write("root/sub/deep/c.json", "c");
    outer.write("root/notes.txt", "notes");
    outer.write("root/.hidden.json", "hidden");
    fs::create_symlink(outer / "outside.json", outer / "root/link.json");
    fs::create_symlink(outer / "root/a.json", outer / "root/inner.json");
    fs::create_directory_symlink(outer.path(), outer / "root/up");
    fs::create_directory_symlink(outer / "root/sub", outer / "root/aside");
  }
};

TEST_F(WorkspaceTest, OpensWhatIsBelowItsFolder) {
  const Workspace all((outer / "root").string());
  EXPECT_EQ(all.open("a.json").text, "a");
  EXPECT_EQ(all.open("sub/b.json").text, "b");
  EXPECT_EQ(all.open("sub/deep/c.json").text, "c");
  EXPECT_EQ(all.open("sub/b.json").folder, (outer / "root/sub").string());
  EXPECT_EQ(all.open("a.json").folder, (outer / "root").string());
}

TEST_F(WorkspaceTest, NamesDoNotLeaveTheFolder) {
  const Workspace all((outer / "root").string());
  const std::string with_nul("a.json\0.json", 12), nul_inside("sub\0/b.json", 11);
  for (const std::string& name : {std::string("../outside.json"),
                                  std::string("sub/../../outside.json"),
                                  std::string("sub/../a.json"),
                                  outer.path() + "/outside.json",
                                  std::string("/etc/passwd.json"),
                                  std::string("./a.json"),
                                  std::string("sub//b.json"),
                                  std::string("up/outside.json"),
                                  std::string("link.json"),
                                  std::string("inner.json"),
                                  std::string("aside/b.json"),
                                  with_nul,
                                  nul_inside,
                                  std::string(""),
                                  std::string("sub"),
                                  std::string("sub/"),
                                  std::string("a.json/"),
                                  std::string("notes.txt"),
                                  std::string("a.json/x.json"),
                                  std::string("nowhere/x.json"),
                                  std::string(".json"),
                                  std::string("sub/.json"),
                                  std::string(5000, 'x') + ".json"}) {
    EXPECT_THROW(all.open(name), InputError) << name.substr(0, 60);
    EXPECT_THROW(all.save(name, "written", {}, true), InputError) << name.substr(0, 60);
  }
  EXPECT_THROW(all.open("nowhere.json"), InputError);
  EXPECT_EQ(outer.read("outside.json"), "outside");
  EXPECT_EQ(outer.read("root/a.json"), "a");
  EXPECT_TRUE(fs::is_symlink(outer / "root/link.json"));
}

TEST_F(WorkspaceTest, ErrorsNameTheFileInOneLine) {
  const Workspace all((outer / "root").string());
  try {
    all.open("li\nne.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("li?ne.json"), std::string::npos);
  }
}

TEST_F(WorkspaceTest, OpensFilesAlone) {
  ASSERT_EQ(::mkfifo((outer / "root/pipe.json").c_str(), 0600), 0);
  fs::create_directory(outer / "root/folder.json");
  const Workspace all((outer / "root").string());
  EXPECT_THROW(all.open("pipe.json"), InputError) << "and does not wait for a writer";
  EXPECT_THROW(all.open("folder.json"), InputError);
  EXPECT_THROW(Workspace((outer / "outside.json").string()), InputError);
  EXPECT_THROW(Workspace((outer / "nowhere").string()), InputError);
}

TEST_F(WorkspaceTest, ListsFoldersAndScenesByName) {
  const Workspace all((outer / "root").string());
  std::vector<std::string> names;
  for (const ListedFile& file : all.list("")) names.push_back(file.path + (file.folder ? "/" : ""));
  EXPECT_EQ(names, (std::vector<std::string>{"sub/", "a.json"}));
  const std::vector<ListedFile> sub = all.list("sub");
  ASSERT_EQ(sub.size(), 2u);
  EXPECT_EQ(sub[0].path, "sub/deep");
  EXPECT_EQ(sub[1].path, "sub/b.json");
  EXPECT_EQ(sub[1].name, "b.json");
  EXPECT_EQ(sub[1].bytes, 1u);
  EXPECT_GT(sub[1].modified, 0);
  EXPECT_EQ(all.list("sub").size(), 2u) << "a second time";
  for (const char* name : {"mug.obj", "b.gltf", "c.glb", "d.mtl", ".e.obj"}) std::ofstream(outer / "root/sub" / name) << "v 0 0 0";
  EXPECT_EQ(all.list("sub").size(), 2u) << "scenes alone";
  names.clear();
  for (const ListedFile& file : all.list("sub", true)) names.push_back(file.name + (file.mesh ? "" : "/"));
  EXPECT_EQ(names, (std::vector<std::string>{"deep/", "b.gltf", "c.glb", "mug.obj"}));
  for (const char* name : {"..", "up", "aside", "sub/..", "a.json", "nowhere", "/"})
    EXPECT_THROW(all.list(name), InputError) << name;
}

TEST_F(WorkspaceTest, SavesWholeFilesAndKeepsTheirMode) {
  const Workspace all((outer / "root").string());
  fs::permissions(outer / "root/a.json", fs::perms::owner_read | fs::perms::owner_write);
  const OpenedFile opened = all.open("a.json");
  const FileStamp stamp = all.save("a.json", "longer than before", opened.stamp, false);
  EXPECT_EQ(outer.read("root/a.json"), "longer than before");
  EXPECT_EQ(fs::status(outer / "root/a.json").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_TRUE(stamp.sameContent(all.open("a.json").stamp));
  all.save("a.json", "again", stamp, false);
  EXPECT_EQ(outer.read("root/a.json"), "again");
  all.save("sub/new.json", "new", {}, false);
  EXPECT_EQ(outer.read("root/sub/new.json"), "new");
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(outer / "root/sub"))
    left += entry.path().string().find(".part-") != std::string::npos;
  EXPECT_EQ(left, 0u);
}

TEST_F(WorkspaceTest, AFileThatChangedOnDiskIsAConflict) {
  const Workspace all((outer / "root").string());
  const OpenedFile opened = all.open("a.json");
  outer.write("root/a.json", "B");  // as long as before
  EXPECT_THROW(all.save("a.json", "mine", opened.stamp, false), FileConflict);
  EXPECT_EQ(outer.read("root/a.json"), "B");
  all.save("a.json", "mine", opened.stamp, true);
  EXPECT_EQ(outer.read("root/a.json"), "mine");

  const OpenedFile again = all.open("a.json");
  outer.write("root/a.json", "mine");  // the same content, later
  all.save("a.json", "more", again.stamp, false);
  outer.remove("root/a.json");
  EXPECT_THROW(all.save("a.json", "mine", again.stamp, false), FileConflict) << "somebody removed it";
  EXPECT_FALSE(fs::exists(outer / "root/a.json"));
  all.save("a.json", "back", again.stamp, true);
  EXPECT_EQ(outer.read("root/a.json"), "back");
}

TEST_F(WorkspaceTest, ANewNameThatIsTakenIsAConflict) {
  const Workspace all((outer / "root").string());
  EXPECT_THROW(all.save("sub/b.json", "mine", {}, false), FileConflict);
  EXPECT_EQ(outer.read("root/sub/b.json"), "b");
  all.save("sub/b.json", "mine", {}, true);
  EXPECT_EQ(outer.read("root/sub/b.json"), "mine");
}

TEST_F(WorkspaceTest, WhatCannotBeWrittenLeavesTheFile) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const Workspace all((outer / "root").string());
  fs::permissions(outer / "root/sub", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(all.save("sub/b.json", "mine", {}, true), InputError);
  fs::permissions(outer / "root/sub", fs::perms::owner_all);
  EXPECT_EQ(outer.read("root/sub/b.json"), "b");
}

}  // namespace
}  // namespace carom::studio
