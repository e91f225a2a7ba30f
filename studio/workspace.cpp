// SPDX-License-Identifier: MIT
#include "studio/workspace.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "formats/base/write_file.hpp"
#include "formats/documents/scene_json.h"

namespace carom::studio {
namespace {

constexpr const char* kScene = ".json";
constexpr std::array kMeshes = {".obj", ".gltf", ".glb"};

/// A file or folder, closed in any case.
class Handle {
 public:
  explicit Handle(int descriptor) : descriptor_(descriptor) {}
  Handle(Handle&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~Handle() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int get() const { return descriptor_; }
  void leave() { descriptor_ = -1; }  // to another owner
  bool isOpen() const { return descriptor_ >= 0; }

 private:
  int descriptor_;
};

std::string shown(const std::string& path) {
  std::string text = path.substr(0, 200);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; }, '?');
  return text;
}

std::string saying(const std::string& path, const std::string& sentence) {
  return "'" + shown(path) + "': " + sentence;
}

[[noreturn]] void failAt(const std::string& path, const std::string& sentence) {
  throw InputError(saying(path, sentence));
}

[[noreturn]] void failBy(const std::string& path, int error) {
  if (error == ELOOP || error == EMLINK) failAt(path, "found a link, expected a file or folder itself");
  if (error == ENOENT) failAt(path, "found no such file or folder");
  if (error == ENOTDIR) failAt(path, "found a file or a link, expected a folder");
  if (error == ENAMETOOLONG) failAt(path, "found a name that is too long");
  throw FileFailure("io", saying(path, std::strerror(error)));
}

/// The parts of a name. "a//b" and "a/./b" are refused, too: one file has one name.
std::vector<std::string> partsOf(const std::string& path) {
  if (path.find('\0') != std::string::npos) failAt(path, "found a name with a NUL, expected one without");
  if (path.starts_with('/')) failAt(path, "found an absolute name, expected one relative to the folder");
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    parts.push_back(path.substr(begin, end - begin));
    if (parts.back() == ".." || parts.back() == "." || parts.back().empty())
      failAt(path, "found \"" + parts.back() + "\" as a part of a name, expected names of files and folders");
    begin = end + 1;
  }
  return parts;
}

/// The folder that a name of so many parts is in. No part of it is a link.
Handle openFolder(int root, const std::string& path, const std::vector<std::string>& parts, std::size_t count) {
  Handle at(::fcntl(root, F_DUPFD_CLOEXEC, 0));
  if (!at.isOpen()) failBy(path, errno);
  for (std::size_t i = 0; i < count; ++i) {
    Handle next(::openat(at.get(), parts[i].c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!next.isOpen()) failBy(path, errno);
    at = std::move(next);
  }
  return at;
}

std::uint64_t hashOf(std::string_view text) {  // FNV-1a
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

std::string readWhole(const std::string& path, int descriptor, std::uint64_t size) {
  if (size > kLargestDocument)
    throw FileFailure("too_large", saying(path, "found " + std::to_string(size) + " bytes, expected at most " +
                                                    std::to_string(kLargestDocument)));
  std::string text(size + 1, '\0');
  std::size_t have = 0;
  while (have < text.size()) {
    const ssize_t got = ::read(descriptor, text.data() + have, text.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) failBy(path, errno);
    if (got == 0) break;
    have += static_cast<std::size_t>(got);
  }
  if (have > size) failAt(path, "found a file that grew while it was read, expected an unchanged one");
  text.resize(have);
  return text;
}

struct ReadFile {
  std::string text;
  FileStamp stamp;
};

/// None: no such file.
std::optional<ReadFile> readIn(int folder, const std::string& path, const std::string& name) {
  // a pipe would wait for its writer
  const Handle file(::openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file.isOpen() && errno == ENOENT) return std::nullopt;
  if (!file.isOpen()) failBy(path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) failBy(path, errno);
  if (!S_ISREG(status.st_mode)) failAt(path, "found something that is not a file, expected a file");
  ReadFile read{readWhole(path, file.get(), static_cast<std::uint64_t>(status.st_size)), {}};
  read.stamp = {status.st_mtim.tv_sec, status.st_mtim.tv_nsec, read.text.size(), hashOf(read.text)};
  return read;
}

bool isMesh(const std::string& name) {
  return std::ranges::any_of(kMeshes, [&](const char* ending) { return name.ends_with(ending); });
}

void requireScene(const std::string& path) {
  if (!path.ends_with(kScene) || path.ends_with(std::string("/") + kScene) || path == kScene)
    failAt(path, "found another ending, expected the name of a scene document, which ends in .json");
}

std::string underKernel(int folder, const std::string& name) {
  return "/proc/self/fd/" + std::to_string(folder) + "/" + name;
}

std::string joined(const std::string& folder, const std::string& path) {
  return path.empty() ? folder : folder + "/" + path;
}

}  // namespace

Workspace::Workspace(const std::string& folder) {
  std::error_code error;
  folder_ = std::filesystem::canonical(folder.empty() ? "." : folder, error).string();
  if (!error) root_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (root_ < 0) throw InputError("found '" + folder + "', expected a folder that can be opened");
}

Workspace::~Workspace() { ::close(root_); }

std::vector<ListedFile> Workspace::list(const std::string& path, bool meshes) const {
  const std::vector<std::string> parts = path.empty() ? std::vector<std::string>() : partsOf(path);
  const Handle folder = openFolder(root_, path, parts, parts.size());
  // fdopendir takes its descriptor, and one of its own has a place of its own in the folder
  Handle own(::openat(folder.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(own.isOpen() ? ::fdopendir(own.get()) : nullptr, ::closedir);
  if (!entries) failBy(path, errno);
  own.leave();
  std::vector<ListedFile> found;
  while (const dirent* entry = ::readdir(entries.get())) {
    const std::string name = entry->d_name;
    struct stat status {};
    if (name.starts_with('.') || ::fstatat(folder.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    const bool is_folder = S_ISDIR(status.st_mode);
    const bool wanted = meshes ? isMesh(name) : name.ends_with(kScene);
    if (!is_folder && !(S_ISREG(status.st_mode) && wanted)) continue;
    found.push_back({path.empty() ? name : path + "/" + name, name, is_folder,
                     is_folder ? 0 : static_cast<std::uint64_t>(status.st_size), status.st_mtim.tv_sec, !is_folder && meshes});
  }
  std::sort(found.begin(), found.end(), [](const ListedFile& a, const ListedFile& b) {
    return std::pair(!a.folder, a.name) < std::pair(!b.folder, b.name);
  });
  return found;
}

OpenedFile Workspace::open(const std::string& path) const {
  const std::vector<std::string> parts = partsOf(path);
  requireScene(path);
  const Handle folder = openFolder(root_, path, parts, parts.size() - 1);
  std::optional<ReadFile> read = readIn(folder.get(), path, parts.back());
  if (!read) failBy(path, ENOENT);
  return {std::move(read->text), read->stamp, folderOf(path)};
}

std::string Workspace::folderOf(const std::string& path) const {
  const std::size_t slash = path.rfind('/');
  return joined(folder_, slash == std::string::npos ? "" : path.substr(0, slash));
}

std::string Workspace::meshPath(const std::string& path) const {
  const std::vector<std::string> parts = partsOf(path);
  if (!isMesh(path)) failAt(path, "found another ending, expected the name of a mesh file: .obj, .gltf or .glb");
  const Handle folder = openFolder(root_, path, parts, parts.size() - 1);
  struct stat status {};
  if (::fstatat(folder.get(), parts.back().c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) failBy(path, errno);
  if (S_ISLNK(status.st_mode)) failBy(path, ELOOP);
  if (!S_ISREG(status.st_mode)) failAt(path, "found something that is not a file, expected a file");
  return joined(folder_, path);
}

FileStamp Workspace::save(const std::string& path, std::string_view text, const std::optional<FileStamp>& known,
                          bool replace) const {
  partsOf(path);
  requireScene(path);
  return write(path, text, known, replace);
}

void Workspace::saveMesh(const std::string& path, std::string_view bytes) const {
  if (!path.ends_with(".obj")) failAt(path, "found another ending, expected the name of a mesh file that ends in .obj");
  write(path, bytes, std::nullopt, false);
}

FileStamp Workspace::write(const std::string& path, std::string_view text, const std::optional<FileStamp>& known,
                           bool replace) const {
  const std::vector<std::string> parts = partsOf(path);
  const Handle folder = openFolder(root_, path, parts, parts.size() - 1);
  const std::optional<ReadFile> there = readIn(folder.get(), path, parts.back());  // refuses links in any case
  if (there && !replace) {
    if (!known) throw FileConflict("'" + shown(path) + "' is there already");
    if (!there->stamp.sameContent(*known))
      throw FileConflict("'" + shown(path) + "' has changed on disk since it was opened here");
  }
  if (!there && known && !replace) throw FileConflict("'" + shown(path) + "' is no longer there");
  try {
    formats_detail::writeFileDurably(underKernel(folder.get(), parts.back()), text);
  } catch (const InputError& error) {
    throw FileFailure("io", saying(path, error.message()));
  }
  const std::optional<ReadFile> written = readIn(folder.get(), path, parts.back());
  if (!written || written->text != text)
    throw FileFailure("io", saying(path, "found other content than was written, expected that"));
  return written->stamp;
}

}  // namespace carom::studio
