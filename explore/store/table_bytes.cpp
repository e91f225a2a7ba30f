// SPDX-License-Identifier: MIT
#include "explore/store/table_bytes.h"

#include <bit>
#include <cstring>

#include "explore/numbers/fnv.hpp"

namespace carom {
namespace {

static_assert(std::endian::native == std::endian::little, "the bytes of a table are those in memory");

constexpr std::string_view kMagic = "CAROMWT1";
constexpr std::size_t kHeader = 8 + 4 * 4 + 8;

template <class T>
void put(std::string& bytes, const T& number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class T>
void put(std::string& bytes, const std::vector<T>& column) {
  bytes.append(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(T));
}

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  void take(T& number) {
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
  }
  template <class T>
  void take(std::vector<T>& column, std::size_t size) {
    column.resize(size);
    if (size > 0) std::memcpy(column.data(), rest_.data(), size * sizeof(T));
    rest_.remove_prefix(size * sizeof(T));
  }

 private:
  std::string_view rest_;
};

}  // namespace

std::string tableBytes(const WorldTable& table) {
  std::string bytes(kMagic);
  for (const std::size_t size : {table.numbers, table.rows, table.boxes, std::size_t{table.has_jacobian}})
    put(bytes, static_cast<std::uint32_t>(size));
  put(bytes, static_cast<std::uint64_t>(table.size()));
  put(bytes, table.world), put(bytes, table.drawn), put(bytes, table.values), put(bytes, table.signature);
  put(bytes, table.status), put(bytes, table.impacts), put(bytes, table.end), put(bytes, table.face),
      put(bytes, table.jacobian);
  put(bytes, explore_detail::fnv(bytes));
  return bytes;
}

std::optional<WorldTable> tableOfBytes(std::string_view bytes) {
  if (bytes.size() < kHeader + 8 || !bytes.starts_with(kMagic)) return {};
  const std::string_view content = bytes.substr(0, bytes.size() - 8);
  std::uint64_t hash = 0, worlds = 0;
  std::memcpy(&hash, content.data() + content.size(), sizeof hash);
  if (hash != explore_detail::fnv(content)) return {};
  Reader reader(content.substr(kMagic.size()));
  std::uint32_t numbers = 0, rows = 0, boxes = 0, has_jacobian = 0;
  reader.take(numbers), reader.take(rows), reader.take(boxes), reader.take(has_jacobian), reader.take(worlds);
  // In doubles, which do not overflow; the hash has shown that these are no arbitrary bytes.
  const double entries = has_jacobian ? 1.0 * rows * numbers : 0;
  const double expected =
      static_cast<double>(worlds) * (8 + 8.0 * numbers + 8.0 * rows + 8 + 1 + 4 + 8 + boxes + 8 * entries);
  if (expected != static_cast<double>(content.size() - kHeader)) return {};
  WorldTable table;
  table.numbers = numbers, table.rows = rows, table.boxes = boxes, table.has_jacobian = has_jacobian != 0;
  const auto n = static_cast<std::size_t>(worlds);
  reader.take(table.world, n), reader.take(table.drawn, n * numbers), reader.take(table.values, n * rows);
  reader.take(table.signature, n), reader.take(table.status, n), reader.take(table.impacts, n),
      reader.take(table.end, n);
  reader.take(table.face, n * boxes), reader.take(table.jacobian, has_jacobian ? n * rows * numbers : 0);
  return table;
}

}  // namespace carom
