// SPDX-License-Identifier: MIT
#include "formats/base/read_file.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "formats/base/format_error.h"

namespace carom::formats_detail {
namespace {

[[noreturn]] void failTooLarge(const std::string& path, const std::string& found, std::size_t limit) {
  throw FormatError(path, "", "found " + found + ", expected at most " + std::to_string(limit) + " bytes");
}

// A pipe has no size before it is read.
std::string readAll(std::istream& in, const std::string& name, std::size_t expected, std::size_t limit) {
  std::string text;
  text.reserve(expected);
  std::string block(std::size_t{1} << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    text.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() > limit) failTooLarge(name, "more", limit);
  }
  return text;
}

}  // namespace

std::string readFile(const std::string& path, const std::string& what, std::size_t limit) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw FormatError(path, "", "found no such file, expected " + what);
  if (std::filesystem::is_directory(status)) throw FormatError(path, "", "found a folder, expected a file");
  std::size_t size = 0;
  if (std::filesystem::is_regular_file(status)) {
    const auto bytes = std::filesystem::file_size(path, error);
    if (!error) size = static_cast<std::size_t>(bytes);
    if (size > limit) failTooLarge(path, "a file of " + std::to_string(size) + " bytes", limit);
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FormatError(path, "", "found a file that cannot be opened, expected one that may be read");
  return readAll(in, path, size, limit);
}

std::string readStream(std::istream& in, const std::string& name, std::size_t limit) {
  return readAll(in, name, 0, limit);
}

}  // namespace carom::formats_detail
