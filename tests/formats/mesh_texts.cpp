// SPDX-License-Identifier: MIT
#include "tests/formats/mesh_texts.h"

#include <cstring>

namespace carom::formats_test {
namespace {

template <class Number>
std::string rawBytes(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

}  // namespace

std::string openCubeObj() {
  return "v -.5 -.5 -.5\nv .5 -.5 -.5\nv .5 .5 -.5\nv -.5 .5 -.5\n"
         "v -.5 -.5 .5\nv .5 -.5 .5\nv .5 .5 .5\nv -.5 .5 .5\n"
         "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

std::string cubeObj() { return openCubeObj() + "f 5 6 7 8\n"; }

std::string bytesOf(const std::vector<float>& numbers) { return rawBytes(numbers); }
std::string bytesOf(const std::vector<std::uint8_t>& numbers) { return rawBytes(numbers); }
std::string bytesOf(const std::vector<std::uint16_t>& numbers) { return rawBytes(numbers); }
std::string bytesOf(const std::vector<std::uint32_t>& numbers) { return rawBytes(numbers); }

std::string base64(const std::string& bytes) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = (bits << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[(bits >> (18 - 6 * k)) & 63u];
  }
  return out;
}

std::string fromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = (bits << 6) | static_cast<unsigned>(digits.find(c));
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += static_cast<char>((bits >> count) & 0xffu);
  }
  return bytes;
}

std::string glb(std::string json, std::string binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  const auto word = [](std::size_t number) { return bytesOf(std::vector{static_cast<std::uint32_t>(number)}); };
  std::string chunks = word(json.size()) + "JSON" + json;
  if (!binary.empty()) chunks += word(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

std::string tetrahedronBytes() {
  return bytesOf(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         bytesOf(std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

std::string tetrahedronGltf(bool with_uri) {
  const std::string uri =
      with_uri ? R"("uri": "data:application/octet-stream;base64,)" + base64(tetrahedronBytes()) + "\", " : "";
  return R"({
  "asset": { "version": "2.0" },
  "scene": 0,
  "scenes": [{ "nodes": [0] }],
  "nodes": [{ "mesh": 0 }],
  "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
  "accessors": [
    { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
    { "bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR" }
  ],
  "bufferViews": [{ "buffer": 0, "byteLength": 48 }, { "buffer": 0, "byteOffset": 48, "byteLength": 24 }],
  "buffers": [{ )" +
         uri + R"("byteLength": 72 }]
})";
}

}  // namespace carom::formats_test
