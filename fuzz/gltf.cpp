// SPDX-License-Identifier: MIT
#include <optional>

#include "formats/gltf/read/import_gltf.h"
#include "formats/mesh/gltf_reader.hpp"
#include "fuzz/require.h"
#include "fuzz/surfaces.h"
#include "fuzz/targets.h"

namespace carom::fuzz {

using namespace formats_detail;

namespace {

constexpr const char* kFolder = "/nonexistent";  // of buffers in other files

template <class Read>
auto reading(Read read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const InputError& error) {
    requireMessage(error);
    return std::nullopt;
  }
}

}  // namespace

void readGltf(std::string_view bytes) {
  if (const auto soup = reading([&] { return parseGltfMesh(bytes, kFolder); })) requireSurfaces(*soup);
  if (const auto imported = reading([&] { return parseGltfScene(bytes, kFolder); })) {
    validate(imported->document.scene);
    for (const std::string& warning : imported->report.warnings)
      require(!warning.empty() && warning.find('\n') == std::string::npos, "warnings of one line");
  }
}

}  // namespace carom::fuzz
