// SPDX-License-Identifier: MIT
// What is saved is on the disk when the call returns, and what cannot be saved leaves the old file. fsync stands here
// in place of the C library's: it notes what it is asked for, does it, and fails when it is told to.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "adjoint/base/errors.h"
#include "examples/support/project_file.h"
#include "formats/base/write_file.hpp"
#include "formats/documents/journal_json.h"
#include "formats/documents/save_with_meshes.h"
#include "formats/documents/scene_json.h"

namespace carom {

using namespace formats_detail;

namespace {

namespace fs = std::filesystem;

struct Synced {
  ino_t inode;
  bool folder;
  off_t size;
  bool target_old;  ///< the file that is saved had its old content, or none, at that time
};
struct Watch {
  bool on = false;
  std::string target, content;  ///< what is to be saved where
  int fail_files = 0, fail_folders = 0;  ///< with this error
  std::vector<Synced> synced;
};
Watch watch;

std::string contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct stat statusOf(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0) << path;
  return status;
}

}  // namespace
}  // namespace carom

extern "C" int fsync(int descriptor) {
  using carom::watch;
  if (watch.on) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) return -1;
    const bool folder = S_ISDIR(status.st_mode);
    const bool old = carom::contentOf(watch.target) != watch.content;
    watch.synced.push_back({status.st_ino, folder, status.st_size, old});
    if (const int error = folder ? watch.fail_folders : watch.fail_files; error != 0) {
      errno = error;
      return -1;
    }
  }
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

namespace carom {
namespace {

class WriteFileDurably : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override {
    watch = {};
    fs::remove_all(folder_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static void watchFor(const std::string& target, const std::string& content) {
    watch = {};
    watch.target = target, watch.content = content, watch.on = true;
  }
  static std::string refusal(const std::string& path, const std::string& content) {
    try {
      writeFileDurably(path, content);
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << path << " was written";
    return "";
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("carom-durable-" + std::to_string(getpid()));
};

TEST_F(WriteFileDurably, TheContentIsOnTheDiskBeforeItsNameAndTheNameBeforeTheEnd) {
  writeFile(path("a"), "old");
  watchFor(path("a"), "what is new");
  writeFileDurably(path("a"), "what is new");
  ASSERT_EQ(watch.synced.size(), 2u);
  EXPECT_FALSE(watch.synced[0].folder);
  EXPECT_EQ(watch.synced[0].size, 11);
  EXPECT_TRUE(watch.synced[0].target_old);
  EXPECT_EQ(watch.synced[0].inode, statusOf(path("a")).st_ino);
  EXPECT_TRUE(watch.synced[1].folder);
  EXPECT_FALSE(watch.synced[1].target_old);
  EXPECT_EQ(watch.synced[1].inode, statusOf(folder_.string()).st_ino);
  EXPECT_EQ(contentOf(path("a")), "what is new");
  EXPECT_EQ(files(), 1u);

  watchFor(path("a"), "what can be made again");
  writeFile(path("a"), "what can be made again");
  EXPECT_TRUE(watch.synced.empty());
}

TEST_F(WriteFileDurably, ModesStayAndLinksAreFollowed) {
  fs::create_directory(folder_ / "sub");
  writeFile(path("sub/target"), "one");
  ASSERT_EQ(chmod(path("sub/target").c_str(), 0640), 0);
  fs::create_symlink("sub/target", folder_ / "link");
  watchFor(path("sub/target"), "two");
  writeFileDurably(path("link"), "two");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_FALSE(fs::is_symlink(folder_ / "sub/target"));
  EXPECT_EQ(contentOf(path("sub/target")), "two");
  EXPECT_EQ(statusOf(path("sub/target")).st_mode & 07777, 0640u);
  ASSERT_EQ(watch.synced.size(), 2u);  // the folder is that of the file, not that of the link
  EXPECT_EQ(watch.synced[1].inode, statusOf(path("sub")).st_ino);
  EXPECT_EQ(files(), 2u);
}

TEST_F(WriteFileDurably, WhatTheDiskDoesNotTakeLeavesTheOldFile) {
  writeFile(path("a"), "old");
  watchFor(path("a"), "new");
  watch.fail_files = EIO;
  const std::string message = refusal(path("a"), "new");
  EXPECT_NE(message.find(path("a") + ": cannot write the file: Input/output error"), std::string::npos) << message;
  EXPECT_EQ(contentOf(path("a")), "old");
  EXPECT_EQ(files(), 1u);
  refusal(path("b"), "new");
  EXPECT_EQ(files(), 1u);
}

// A limit that also holds for who may write everything.
TEST_F(WriteFileDurably, AFullDiskLeavesTheOldFile) {
  writeFile(path("a"), "old");
  struct rlimit before {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit small = before;
  small.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal(path("a"), std::string(5000, 'x'));
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(message.find(path("a") + ": cannot write the file: File too large"), std::string::npos) << message;
  EXPECT_EQ(contentOf(path("a")), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFileDurably, ErrorsNameTheFile) {
  writeFile(path("file"), "text");
  EXPECT_NE(refusal(path("file/a"), "x").find(path("file/a") + ": cannot write the file: Not a directory"),
            std::string::npos);
  EXPECT_NE(refusal(path("none/a"), "x").find(path("none/a")), std::string::npos);
  EXPECT_NE(refusal("/dev/full", "x").find("/dev/full: cannot write the file: No space left"), std::string::npos);
  writeFileDurably("/dev/null", "x");
  EXPECT_EQ(contentOf(path("file")), "text");
  EXPECT_EQ(files(), 1u);

  watchFor(path("file"), "newer");
  watch.fail_folders = EIO;
  const std::string message = refusal(path("file"), "newer");
  EXPECT_NE(message.find(path("file") + ": the file is written, but may be lost"), std::string::npos) << message;
  EXPECT_EQ(contentOf(path("file")), "newer");
}

TEST_F(WriteFileDurably, SomeFileSystemsCannotBeAsked) {
  for (const int error : {EINVAL, EROFS, ENOTSUP}) {
    watchFor(path("a"), "new");
    watch.fail_files = watch.fail_folders = error;
    writeFileDurably(path("a"), "new");
    EXPECT_EQ(watch.synced.size(), 2u);
    EXPECT_EQ(contentOf(path("a")), "new");
    fs::remove(folder_ / "a");
  }
}

// What people made: documents, their meshes and journals.
TEST_F(WriteFileDurably, IsHowDocumentsAndJournalsAreSaved) {
  Document document = readDocument(projectFile("examples/scenes/two-balls.json"));
  const auto filesSynced = [] {
    return std::count_if(watch.synced.begin(), watch.synced.end(), [](const Synced& s) { return !s.folder; });
  };
  const auto expectSynced = [&](const std::string& saved, long count) {
    EXPECT_EQ(filesSynced(), count) << saved;
    EXPECT_EQ(watch.synced.size(), static_cast<std::size_t>(2 * count)) << saved;
    EXPECT_TRUE(std::any_of(watch.synced.begin(), watch.synced.end(), [&](const Synced& s) {
      return s.inode == statusOf(saved).st_ino;
    })) << saved;
  };
  watchFor("", "");
  saveDocument(path("scene.json"), document);
  expectSynced(path("scene.json"), 1);

  watchFor("", "");
  saveJournal(path("journal.json"), {{document.scene, document.duration, {}, {}, {}, {}}, ""});
  expectSynced(path("journal.json"), 1);

  Document mug = readDocument(projectFile("examples/scenes/mug.json"));
  std::size_t named = 0;
  for (Body& body : mug.scene.bodies)
    if (Mesh* mesh = std::get_if<Mesh>(&body.shape)) mesh->file.clear(), ++named;
  ASSERT_GT(named, 0u);
  watchFor("", "");
  const std::vector<std::string> meshes = saveWithMeshes(path("mug.json"), mug);
  ASSERT_FALSE(meshes.empty());
  expectSynced(path("mug.json"), static_cast<long>(meshes.size()) + 1);
  for (const std::string& mesh : meshes) expectSynced(path(mesh), static_cast<long>(meshes.size()) + 1);
}

}  // namespace
}  // namespace carom
