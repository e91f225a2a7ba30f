// SPDX-License-Identifier: MIT
#include "explore/store/world_store.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "adjoint/base/errors.h"
#include "explore/numbers/fnv.hpp"
#include "explore/store/table_bytes.h"
#include "formats/base/write_file.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  return std::string{std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

WorldStore::WorldStore(const std::string& folder, const std::string& question) {
  char name[17];
  std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(explore_detail::fnv(question)));
  const fs::path path = fs::path(folder) / name;
  folder_ = path.string();
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw InputError(folder_, "cannot make the folder of a store: " + error.message());
  const fs::path file = path / "question";
  const std::optional<std::string> there = contentOf(file);
  if (!there)
    formats_detail::writeFile(file.string(), question);
  else if (*there != question)
    throw InputError(
        folder_, "found the worlds of another document, of other options or another version, expected another folder");
}

std::string WorldStore::fileOf(std::uint64_t first, std::uint64_t count) const {
  return folder_ + "/worlds-" + std::to_string(first) + "-" + std::to_string(count);
}

std::optional<WorldTable> WorldStore::read(std::uint64_t first, std::uint64_t count, const WorldTable& like) const {
  const std::optional<std::string> bytes = contentOf(fileOf(first, count));
  std::optional<WorldTable> table = bytes ? tableOfBytes(*bytes) : std::nullopt;
  if (!table || table->size() != count || table->numbers != like.numbers || table->rows != like.rows ||
      table->boxes != like.boxes || table->has_jacobian != like.has_jacobian)
    return {};
  for (std::uint64_t k = 0; k < count; ++k)
    if (table->world[k] != first + k) return {};
  return table;
}

void WorldStore::write(std::uint64_t first, const WorldTable& table) const {
  formats_detail::writeFile(fileOf(first, table.size()), tableBytes(table));
}

}  // namespace carom
