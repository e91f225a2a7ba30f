// SPDX-License-Identifier: MIT
#include "formats/write_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>

#include "adjoint/errors.h"

namespace carom {
namespace {

// Two programs that write the same path must not share a temporary file.
std::string temporaryBeside(const std::string& path) {
  std::random_device random;
  return path + ".part-" + std::to_string(random());
}

[[noreturn]] void failToWrite(const std::string& path, const std::string& temporary, const std::string& why) {
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw InputError(path, "cannot write the file: " + why);
}

}  // namespace

void writeFile(const std::string& path, std::string_view content) {
  const std::string temporary = temporaryBeside(path);
  errno = 0;
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  if (!out) failToWrite(path, temporary, std::strerror(errno));
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) failToWrite(path, temporary, errno != 0 ? std::strerror(errno) : "the disk took only a part");
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) failToWrite(path, temporary, error.message());
}

}  // namespace carom
