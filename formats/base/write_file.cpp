// SPDX-License-Identifier: MIT
#include "formats/base/write_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>

#include "adjoint/base/errors.h"

namespace carom::formats_detail {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // of one name, as in the kernel

[[noreturn]] void failToWrite(const std::string& path, const std::string& why) {
  throw InputError(path, "cannot write the file: " + why);
}

std::string reasonOf(int error) { return error != 0 ? std::strerror(error) : "the disk took only a part"; }

// What a path means once its links are followed. It need not be there.
fs::path followed(const std::string& path) {
  fs::path at = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, error)); ++links) {
    if (links == kMostLinks) failToWrite(path, reasonOf(ELOOP));
    const fs::path target = fs::read_symlink(at, error);
    if (error) failToWrite(path, error.message());
    at = target.is_absolute() ? target : at.parent_path() / target;
  }
  return at;
}

fs::path folderAbove(const fs::path& file) {
  const fs::path folder = file.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

enum class Kept { while_the_machine_runs, through_power_loss };

// Closed in any case.
class OpenFile {
 public:
  OpenFile(const fs::path& path, int flags, mode_t mode = 0) : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool isOpen() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

  // Writes the whole of it, and closes the file. 0, or what went wrong.
  int finish(std::string_view content, Kept kept) {
    int error = write(content);
    if (error == 0 && kept == Kept::through_power_loss) error = sync();
    const int closed = close();
    return error != 0 ? error : closed;
  }

  // Until the disk has it. 0, or what went wrong; what cannot be asked for that has nothing to lose.
  int sync() const {
    int result = 0;
    do {
      result = ::fsync(descriptor_);
    } while (result != 0 && errno == EINTR);
    return result == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP ? 0 : errno;
  }

 private:
  int write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return written < 0 ? errno : ENOSPC;
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
  }
  int close() {
    const int result = ::close(descriptor_);
    descriptor_ = -1;
    return result == 0 || errno == EINTR ? 0 : errno;
  }

  int descriptor_;
};

// Whose it is and who may read it, as far as we may say so; what may not be given is not worth an error.
void keepOwnerAndMode(const OpenFile& file, const struct stat& old) {
  if (old.st_uid != ::geteuid() || old.st_gid != ::getegid())
    if (::fchown(file.descriptor(), old.st_uid, old.st_gid) != 0) errno = 0;
  if (::fchmod(file.descriptor(), old.st_mode & 0777) != 0) errno = 0;
}

// The name of a file is in its folder.
void keepName(const std::string& path, const fs::path& target) {
  const OpenFile folder(folderAbove(target), O_RDONLY | O_DIRECTORY);
  if (!folder.isOpen()) return;  // one that may be written but not read
  if (const int error = folder.sync(); error != 0)
    throw InputError(path, "the file is written, but may be lost if the power fails: " + reasonOf(error));
}

// A new file beside the old one takes its place. Two programs that write the same path must not share it.
void replaceFile(const std::string& path, const fs::path& target, const struct stat* old, std::string_view content,
                 Kept kept) {
  std::random_device random;
  fs::path temporary = target;
  temporary += ".part-" + std::to_string(random());
  OpenFile file(temporary, O_WRONLY | O_CREAT | O_EXCL, old ? 0600 : 0666);
  if (!file.isOpen()) failToWrite(path, reasonOf(errno));
  if (old) keepOwnerAndMode(file, *old);
  int error = file.finish(content, kept);
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    failToWrite(path, reasonOf(error));
  }
  if (kept == Kept::through_power_loss) keepName(path, target);
}

void writeInPlace(const std::string& path, const fs::path& target, std::string_view content, Kept kept) {
  OpenFile file(target, O_WRONLY);
  if (!file.isOpen()) failToWrite(path, reasonOf(errno));
  if (const int error = file.finish(content, kept); error != 0) failToWrite(path, reasonOf(error));
}

struct WriteTarget {
  fs::path path;
  bool exists = false;
  struct stat status {};
  bool isFile() const { return !exists || S_ISREG(status.st_mode); }
};

WriteTarget writableTarget(const std::string& path) {
  if (path.empty()) throw InputError("found an empty name, expected that of a file to write");
  WriteTarget target;
  target.path = followed(path);
  target.exists = ::stat(target.path.c_str(), &target.status) == 0;
  if (!target.exists && errno != ENOENT) failToWrite(path, reasonOf(errno));
  if (target.exists && S_ISDIR(target.status.st_mode)) failToWrite(path, "found a folder, expected a file");
  if (target.exists && ::access(target.path.c_str(), W_OK) != 0) failToWrite(path, reasonOf(errno));
  if (target.isFile() && ::access(folderAbove(target.path).c_str(), W_OK | X_OK) != 0) failToWrite(path, reasonOf(errno));
  return target;
}

void write(const std::string& path, std::string_view content, Kept kept) {
  const WriteTarget target = writableTarget(path);
  if (target.isFile())
    replaceFile(path, target.path, target.exists ? &target.status : nullptr, content, kept);
  else
    writeInPlace(path, target.path, content, kept);
}

}  // namespace

void requireWritable(const std::string& path) { writableTarget(path); }

void writeFile(const std::string& path, std::string_view content) {
  write(path, content, Kept::while_the_machine_runs);
}

void writeFileDurably(const std::string& path, std::string_view content) {
  write(path, content, Kept::through_power_loss);
}

}  // namespace carom::formats_detail
