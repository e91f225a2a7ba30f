// SPDX-License-Identifier: MIT
// Files, links, devices and pipes as targets of what is written; a NUL byte in what is read.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "adjoint/base/errors.h"
#include "formats/base/write_file.hpp"
#include "formats/documents/scene_json.h"

namespace carom {

using namespace formats_detail;

namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string contentOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  static mode_t modeOf(const std::string& path) {
    struct stat status {};
    EXPECT_EQ(stat(path.c_str(), &status), 0);
    return status.st_mode & 07777;
  }
  static void expectRefused(const std::string& path, const std::string& words) {
    for (const bool before : {true, false}) try {
        before ? requireWritable(path) : writeFile(path, "text");
        ADD_FAILURE() << path << " was not refused";
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      }
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static bool isRoot() { return geteuid() == 0; }

  fs::path folder_ = fs::path(testing::TempDir()) / ("carom-write-" + std::to_string(getpid()));
};

TEST_F(WriteFile, NewAndReplaced) {
  writeFile(path("a"), "one");
  EXPECT_EQ(contentOf(path("a")), "one");
  EXPECT_EQ(modeOf(path("a")) & 0600, 0600u);
  struct stat old {}, now {};
  ASSERT_EQ(stat(path("a").c_str(), &old), 0);
  writeFile(path("a"), "another");
  ASSERT_EQ(stat(path("a").c_str(), &now), 0);
  EXPECT_EQ(contentOf(path("a")), "another");
  EXPECT_NE(old.st_ino, now.st_ino) << "was not replaced as a whole";
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, KeepsTheMode) {
  for (const mode_t mode : {0600u, 0640u, 0755u, 0666u}) {
    writeFile(path("a"), "one");
    ASSERT_EQ(chmod(path("a").c_str(), mode), 0);
    writeFile(path("a"), "two");
    EXPECT_EQ(modeOf(path("a")), mode);
    EXPECT_EQ(contentOf(path("a")), "two");
  }
}

TEST_F(WriteFile, WhatMayNotBeWritten) {
  writeFile(path("a"), "one");
  ASSERT_EQ(chmod(path("a").c_str(), 0444), 0);
  if (isRoot()) {
    writeFile(path("a"), "two");  // who may write everything
    EXPECT_EQ(modeOf(path("a")), 0444u);
  } else {
    expectRefused(path("a"), "Permission denied");
    EXPECT_EQ(contentOf(path("a")), "one");
    ASSERT_EQ(chmod(folder_.c_str(), 0500), 0);
    expectRefused(path("b"), "Permission denied");
  }
}

TEST_F(WriteFile, FollowsLinks) {
  fs::create_directory(folder_ / "sub");
  writeFile(path("sub/target"), "one");
  ASSERT_EQ(chmod(path("sub/target").c_str(), 0640), 0);
  fs::create_symlink("sub/target", folder_ / "link");
  fs::create_symlink("link", folder_ / "link to link");
  writeFile(path("link to link"), "two");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link to link"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_FALSE(fs::is_symlink(folder_ / "sub/target"));
  EXPECT_EQ(contentOf(path("sub/target")), "two");
  EXPECT_EQ(modeOf(path("sub/target")), 0640u);

  fs::create_symlink("sub/new", folder_ / "dangling");
  writeFile(path("dangling"), "three");
  EXPECT_TRUE(fs::is_symlink(folder_ / "dangling"));
  EXPECT_EQ(contentOf(path("sub/new")), "three");

  fs::create_symlink("none/new", folder_ / "nowhere");
  expectRefused(path("nowhere"), "No such file");
  fs::create_symlink("round", folder_ / "round");
  expectRefused(path("round"), "levels of symbolic links");
  fs::create_symlink("/dev/null", folder_ / "null");
  writeFile(path("null"), "four");
  EXPECT_TRUE(fs::is_symlink(folder_ / "null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteFile, Devices) {
  writeFile("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  requireWritable("/dev/full");
  try {
    writeFile("/dev/full", "text");
    ADD_FAILURE() << "/dev/full took it";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/full: cannot write the file: No space left"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(WriteFile, APipeWithAReader) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const std::string text(300'000, 'x');  // more than a pipe holds
  std::string read;
  std::thread reader([&] { read = contentOf(path("pipe")); });
  writeFile(path("pipe"), text);
  reader.join();
  EXPECT_EQ(read, text);
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

TEST_F(WriteFile, WhatIsNoTarget) {
  expectRefused("", "found an empty name");
  expectRefused(folder_.string(), "found a folder");
  expectRefused(path("none/a"), "No such file");
  writeFile(path("file"), "text");
  expectRefused(path("file/a"), "Not a directory");
  EXPECT_EQ(files(), 1u);
}

TEST(NulByte, IsRefusedWithItsPlace) {
  const std::string text = R"({"carom": 1, "duration": 1, "bodies": [{"name": "a", "mass": 1, "shape": {"sphere": {"radius": 1}}}]})";
  EXPECT_NO_THROW(parseDocument(text, "s.json", "."));
  for (const std::string& tail : {std::string("\n\0", 2), std::string("\n\0 what follows", 15)}) try {
      parseDocument(text + tail, "s.json", ".");
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("line 2, column 1"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("NUL"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace carom
