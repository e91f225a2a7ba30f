// SPDX-License-Identifier: MIT
#include "studio/autosave.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "adjoint/base/errors.h"

namespace carom::studio {
namespace {

constexpr int kMostAside = 1000;

/// False: an error, in errno. Never a part.
bool writeWhole(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string readWhole(int file) {
  std::string text;
  char part[1 << 16];
  for (ssize_t got = 0; (got = ::pread(file, part, sizeof part, static_cast<off_t>(text.size()))) > 0;)
    text.append(part, static_cast<std::size_t>(got));
  return text;
}

/// A name is on the disk once its folder is.
void syncFolder(const std::string& path) {
  const int folder = ::open(std::filesystem::path(path).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

}  // namespace

Autosave::Autosave(const std::string& folder, const std::string& name)
    : path_((std::filesystem::path(folder) / ("." + name + ".steps")).string()), name_(name) {}

Autosave::~Autosave() {
  if (file_ >= 0) ::close(file_);
}

void Autosave::say(const std::string& what, int error) {
  if (failing_) return;  // once, until it goes well again
  failing_ = true;
  problem_ = what + (error != 0 ? " (" + std::string(std::strerror(error)) + ")" : "") + ". Save to keep them.";
}

bool Autosave::open(bool create) {
  if (file_ >= 0) return true;
  const int flags = O_RDWR | O_APPEND | O_NOFOLLOW | O_CLOEXEC | (create ? O_CREAT : 0);
  const int file = ::open(path_.c_str(), flags, 0600);
  if (file < 0) {
    if (create || errno != ENOENT)
      say("Steps are not kept on the disk: their file beside '" + name_ + "' cannot be opened", errno);
    return false;
  }
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    ::close(file);
    say("Steps are not kept on the disk: another carom studio keeps those of '" + name_ + "'", 0);
    return false;
  }
  file_ = file;
  return true;
}

std::optional<formats_detail::StepLines> Autosave::find() {
  if (!open(false)) return std::nullopt;
  const std::string text = readWhole(file_);
  try {
    return formats_detail::readStepLines(text, "", std::filesystem::path(path_).parent_path().string());
  } catch (const std::exception&) {
    if (text.find('\n') == std::string::npos) return std::nullopt;  // not even its first line came whole
    const std::string aside = setAside();
    say("The steps of '" + name_ + "' cannot be read; they are in '" + aside + "'", 0);
    return std::nullopt;
  }
}

void Autosave::goOn(const formats_detail::StepLines& found) {
  size_ = found.bytes;
  if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) say("Steps are not kept on the disk", errno);
}

void Autosave::begin(std::string first_line) {
  waiting_ = std::move(first_line);
  size_ = 0;
  if (file_ >= 0 && ::ftruncate(file_, 0) != 0) say("Steps are not kept on the disk", errno);
}

std::string Autosave::setAside() {
  std::string aside;
  for (int n = 1; n < kMostAside && (aside.empty() || std::filesystem::exists(aside)); ++n)
    aside = path_ + "." + std::to_string(n);
  if (::rename(path_.c_str(), aside.c_str()) != 0) say("The old steps could not be set aside", errno);
  if (file_ >= 0) ::close(file_);
  file_ = -1;
  syncFolder(path_);
  return std::filesystem::path(aside).filename().string();
}

void Autosave::append(const std::string& line) {
  waiting_ += line;
  const bool is_new = file_ < 0;
  if (!open(true)) return;
  if (!writeWhole(file_, waiting_) || ::fdatasync(file_) != 0) {
    const int error = errno;
    if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) ::close(file_), file_ = -1;
    return say("Steps are not kept on the disk", error);
  }
  if (is_new) syncFolder(path_);
  size_ += waiting_.size();
  waiting_.clear();
  failing_ = false;
}

void Autosave::rename(const std::string& name) {
  const std::string to = (std::filesystem::path(path_).parent_path() / ("." + name + ".steps")).string();
  if (to == path_) return;
  if (file_ >= 0 && ::rename(path_.c_str(), to.c_str()) != 0) return say("Steps stay with the name before", errno);
  path_ = to, name_ = name;
  syncFolder(path_);
}

void Autosave::forget() {
  if (file_ >= 0) ::unlink(path_.c_str()), ::close(file_);
  file_ = -1;
}

std::string Autosave::folder() const { return std::filesystem::path(path_).parent_path().string(); }

std::string Autosave::takeProblem() { return std::exchange(problem_, ""); }

}  // namespace carom::studio
