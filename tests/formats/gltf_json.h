// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "tests/formats/mesh_texts.h"

namespace carom::formats_test {

/// tetrahedronGltf(true).
inline nlohmann::json tetrahedronDocument() { return nlohmann::json::parse(tetrahedronGltf(true)); }

/// Bytes in the place of its only buffer.
inline void setBuffer(nlohmann::json& document, const std::string& bytes) {
  document["buffers"][0] = {{"uri", "data:;base64," + base64(bytes)}, {"byteLength", bytes.size()}};
}

}  // namespace carom::formats_test
